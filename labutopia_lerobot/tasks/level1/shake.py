"""Shake: tilt a beaker that is in the hand left and right, three times (paper, level 1, "Shake").

Ported from: config/level1_shake.yaml, tasks/shake_task.py, controllers/shake_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import gripped, steady
from labutopia_lerobot.skills import Pick
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def shake() -> Task:
    """Return the task."""
    vessel = glassware("beaker", "150 ml")
    # Original: (0.25, 0, 1.0) in the world. The paper's "initial position above the workspace".
    start = OverBench("middle of the workspace", ahead=0.65, height=0.25)
    return Task(
        instruction=(
            "Shake the beaker in the gripper from side to side three times, 20 cm or more above "
            "the middle of the bench."
        ),
        paraphrases=(
            "High above the bench, tip the beaker you are holding left and right three times.",
            "Tilt the beaker to the left and to the right, three times, 20 cm above the bench.",
        ),
        # Original: the same range, which is the paper's 15 cm x 15 cm.
        start={vessel: OnBench(x=(0.19, 0.34), y=(-0.075, 0.075))},
        setup=(Pick(vessel, lift=0.25),),
        steps=(actions.shake(vessel, start),),
        goal=(
            *actions.held_at(vessel, start),
            gripped(vessel),
            steady(vessel, below=0.05),  # paper: "maintaining stability"; ours: as in Pick
        ),
        contents={vessel: Filling(ml=60)},  # ours: a good quarter of what it holds
        never=failures.handling(vessel, spill=0.01),
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
    )
