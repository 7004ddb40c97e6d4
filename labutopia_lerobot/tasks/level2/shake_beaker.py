"""Shake beaker: pick a beaker up and tilt it left and right, three times (paper, level 2).

Ported from: config/level2_ShakeBeaker.yaml, tasks/shake_task.py,
controllers/shakebeaker_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import gripped, steady
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def shake_beaker() -> Task:
    """Return the task."""
    vessel = glassware("beaker", "150 ml")
    # Original: (0.25, 0, 1.0) in the world. The paper's "initial position above the workspace".
    start = OverBench("middle of the workspace", ahead=0.65, height=0.25)
    return Task(
        instruction=(
            "Pick up the beaker and shake it from side to side three times, 20 cm or more above "
            "the middle of the bench."
        ),
        paraphrases=(
            "Lift the beaker by over 20 cm, tilt it left and right three times and hold it there.",
            "Take the beaker and, 20 cm above the bench, swing it to left and right three times.",
        ),
        # Original: y -0.05 to 0.05; ours the paper's 15 cm x 15 cm.
        start={vessel: OnBench(x=(0.19, 0.34), y=(-0.075, 0.075))},
        steps=(actions.pick(vessel), actions.shake(vessel, start)),
        goal=(
            *actions.held_at(vessel, start),
            gripped(vessel),
            steady(vessel, below=0.05),  # paper: "stabilized"; ours: as in Pick
        ),
        contents={vessel: Filling(ml=60)},  # ours: a good quarter of what it holds
        never=failures.handling(vessel, spill=0.01),
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
    )
