"""Stir with glass rod: pick a glass rod up and stir in a beaker with it (paper, level 2).

Ported from: config/level2_StirGlassrod.yaml, tasks/stir_task.py,
controllers/stirglassrod_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.instruments.test_tube_rack import TestTubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import steady, upright
from labutopia_lerobot.scenes.views import WIDEST_VESSEL_VIEW
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def stir_glassrod() -> Task:
    """Return the task."""
    rod, rack, vessel = (
        GlassRod("glass_rod"),
        TestTubeRack("rack"),
        glassware("beaker", "150 ml"),
    )
    filling = Filling(ml=60)  # ours: a good quarter of what it holds
    return Task(
        instruction=(
            "Lift the glass rod by 20 cm out of the rack, stir in the beaker with it, five times "
            "round, and lift it straight out."
        ),
        paraphrases=(
            "Pick the glass rod out of the rack, lift it 20 cm, stir five circles in the beaker "
            "and lift it out.",
            "Raise the rod by 20 cm, stir the contents of the beaker five turns, and lift it out.",
        ),
        # Original: the same range for the beaker, which is the paper's 15 cm x 15 cm; a fixed
        # rack at (0.284, 0.308).
        start={
            vessel: OnBench(x=(0.166, 0.316), y=(-0.389, -0.239)),
            rack: OnBench(x=(0.209, 0.359), y=(0.233, 0.383)),
            rod: Inside(rack, at=rack.middle),
        },
        steps=(actions.pick(rod, lift=0.23, support=rack.name), actions.stir(rod, vessel, filling)),
        goal=(
            *actions.held_over(rod, vessel),
            upright(rod, within_deg=10),
            steady(rod, below=0.05),  # ours: as in Pick; a long rod shows every tremble of a hand
        ),
        contents={vessel: filling},
        never=failures.stirring(rod, vessel, rack),
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=WIDEST_VESSEL_VIEW,
    )
