"""Stir with glass rod: pick a glass rod up and stir in a beaker with it (paper, level 2).

Ported from: config/level2_StirGlassrod.yaml, tasks/stir_task.py,
controllers/stirglassrod_controller.py.
"""

from labutopia_lerobot.labware.glass_rod import GlassRod
from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.labware.test_tube_rack import TestTubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    dipped,
    falling,
    gripped,
    knocked_over,
    lifted,
    moving,
    off_axis,
    on_side,
    over_mouth,
    spilled,
    steady,
    struck,
    upright,
)
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.stir import Stir
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.views import WIDEST_VESSEL_VIEW


def stir_glassrod() -> Task:
    """Return the task."""
    rod, rack, vessel = GlassRod("glass_rod"), TestTubeRack("rack"), beaker("beaker", "150 ml")
    # Ours: the lower half of the beaker, where the liquid of a half-full one is.
    inside = (gripped(rod), dipped(rod, vessel, by=0.045))
    turn = (
        on_side(rod, vessel, "ahead", beyond=0.005),  # ours: half of the original's 9 mm
        on_side(rod, vessel, "left", beyond=0.005),
        on_side(rod, vessel, "behind", beyond=0.005),
        on_side(rod, vessel, "right", beyond=0.005),
    )
    circling = (
        off_axis(rod, vessel, beyond=0.003),  # so that the sides are passed by going round
        moving(rod, above=0.003),  # paper: "without interruption or hesitation"; ours: a tenth
    )
    return Task(
        instruction=(
            "Take the glass rod from the rack, stir in the beaker with it, five times round "
            "counterclockwise, and take it out."
        ),
        paraphrases=(
            "Pick the glass rod out of the rack, stir five circles counterclockwise in the beaker "
            "and lift it out again.",
            "Fetch the stirring rod and stir the beaker's contents: five turns counterclockwise, "
            "then withdraw it.",
        ),
        # Original: the same range for the beaker, which is the paper's 15 cm x 15 cm; a fixed
        # rack at (0.284, 0.308).
        start={
            vessel: OnBench(x=(0.166, 0.316), y=(-0.389, -0.239)),
            rack: OnBench(x=(0.209, 0.359), y=(0.233, 0.383)),
            rod: Inside(rack, at=rack.middle),
        },
        expert=(Pick(rod, lift=0.23, support=rack.name), Stir(rod, vessel)),
        substeps=(
            Substep("gripped", (gripped(rod),)),
            Substep("lifted", (gripped(rod), lifted(rod, by=0.20))),  # paper: "exceeding 20 cm"
            Substep("inserted", inside),
            Substep("stirred", inside, via=turn * 5, keeping=(*inside, *circling)),
            Substep("withdrawn", (gripped(rod), over_mouth(rod, vessel, within=0.04, by=0.05))),
        ),
        goal=(
            gripped(rod),
            over_mouth(rod, vessel, within=0.04, by=0.05),  # original: 0.04; ours: clear of it
            upright(rod, within_deg=10),
            steady(rod, below=0.02),
        ),
        contents={vessel: Filling(ml=60)},  # ours: half of what it holds
        never={
            "knocked_over": knocked_over(rod, beyond_deg=30),
            "dropped": falling(rod, faster_than=0.5),  # free fall over 13 mm
            "spilled": spilled(vessel, share=0.01),  # paper: "without causing spillage"
            "collided": struck(vessel),
            "rack_struck": struck(rack, but_for=frozenset({rod.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDEST_VESSEL_VIEW,
    )
