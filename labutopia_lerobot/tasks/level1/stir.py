"""Stir: with a glass rod that is in the hand, in a beaker (paper, level 1, "Stir").

Ported from: config/level1_stir.yaml, tasks/stir_task.py, controllers/stir_controller.py.
"""

from labutopia_lerobot.labware.glass_rod import GlassRod
from labutopia_lerobot.labware.glassware import beaker
from labutopia_lerobot.labware.test_tube_rack import TestTubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import (
    dipped,
    falling,
    gripped,
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


def stir() -> Task:
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
            "Stir in the beaker with the glass rod in the gripper, five times round "
            "counterclockwise, and take the rod out."
        ),
        paraphrases=(
            "Put the glass rod you are holding into the beaker, stir five circles "
            "counterclockwise, and lift it out again.",
            "Use the glass rod to stir the liquid: five turns counterclockwise, then withdraw it.",
        ),
        # Original: the same range for the beaker, which is the paper's 15 cm x 15 cm; a fixed
        # rack at (0.284, 0.308).
        start={
            vessel: OnBench(x=(0.166, 0.316), y=(-0.389, -0.239)),
            rack: OnBench(x=(0.209, 0.359), y=(0.233, 0.383)),
            rod: Inside(rack, at=rack.middle),
        },
        prelude=(Pick(rod, lift=0.23, support=rack.name),),
        expert=(Stir(rod, vessel),),
        substeps=(
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
            "dropped": falling(rod, faster_than=0.5),  # free fall over 13 mm
            "spilled": spilled(vessel, share=0.01),  # paper: "without causing spillage"
            "collided": struck(vessel),
            "rack_struck": struck(rack, but_for=frozenset({rod.name})),
        },
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDEST_VESSEL_VIEW,
    )
