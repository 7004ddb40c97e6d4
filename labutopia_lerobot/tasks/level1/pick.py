"""Pick: grasp a conical flask from the bench and lift it (paper, level 1, "Pick").

Ported from: config/level1_pick.yaml, tasks/pick_task.py, controllers/pick_controller.py.
"""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import gripped, lifted, steady, upright
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


def pick() -> Task:
    """Return the task."""
    return pick_up(glassware("conical_flask", "300 ml", "flask"))


def pick_up(flask: Vessel) -> Task:
    """Return the task with a vessel, which level 3 varies."""
    return Task(
        instruction="Pick up the conical flask and hold it still, 20 cm or more above the bench.",
        paraphrases=(
            "Take the Erlenmeyer flask, lift it by more than 20 cm and hold it there.",
            "Grasp the conical flask by its neck and raise it higher than 20 cm.",
        ),
        # Original: x 0.21 to 0.36, y -0.08 to 0.08; the paper's 15 cm x 15 cm.
        start={flask: OnBench(x=(0.21, 0.36), y=(-0.075, 0.075))},
        steps=(actions.pick(flask),),
        goal=(
            lifted(flask, by=0.20),
            gripped(flask),  # paper: "securely grasped"
            upright(flask, within_deg=20),  # ours: a quarter-full flask does not spill
            steady(flask, below=0.05),  # paper: "maintained steadily"; the number is ours
        ),
        never=failures.handling(flask, spill=None),
        time_limit_s=800 / 60,  # original: 800 steps at 60 Hz
    )
