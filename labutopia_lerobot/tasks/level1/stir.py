"""Stir: with a glass rod that is in the hand, in a beaker (paper, level 1, "Stir").

Ported from: config/level1_stir.yaml, tasks/stir_task.py, controllers/stir_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.instruments.test_tube_rack import TestTubeRack
from labutopia_lerobot.layout import Inside, OnBench
from labutopia_lerobot.predicates import steady, upright
from labutopia_lerobot.scenes.views import WIDEST_VESSEL_VIEW
from labutopia_lerobot.skills import Pick
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def stir() -> Task:
    """Return the task."""
    rod, rack, vessel = (
        GlassRod("glass_rod"),
        TestTubeRack("rack"),
        glassware("beaker", "150 ml"),
    )
    filling = Filling(ml=60)  # ours: a good quarter of what it holds
    return Task(
        instruction=(
            "Stir in the beaker with the glass rod in the gripper, five times round, and lift the "
            "rod straight out."
        ),
        paraphrases=(
            "Put the glass rod you are holding into the beaker, stir five circles, and lift it "
            "straight out.",
            "Use the glass rod to stir the liquid: five turns, then hold it over the beaker.",
        ),
        # Original: the same range for the beaker, which is the paper's 15 cm x 15 cm; a fixed
        # rack at (0.284, 0.308).
        start={
            vessel: OnBench(x=(0.166, 0.316), y=(-0.389, -0.239)),
            rack: OnBench(x=(0.209, 0.359), y=(0.233, 0.383)),
            rod: Inside(rack, at=rack.middle),
        },
        setup=(Pick(rod, lift=0.23, support=rack.name),),
        steps=(actions.stir(rod, vessel, filling),),
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
