"""Close drawer: push the open top drawer of a cabinet shut by its handle (paper, level 1, "Close").

Ported from: config/level1_close_drawer.yaml, tasks/openclose_task.py,
controllers/close_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, closed
from labutopia_lerobot.scenes.views import DRAWER_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

AJAR = 0.15  # original: the handle travels by more than 0.13 m; pushed until 0.15 m
BEGUN = AJAR - 0.005  # ours: further than a grip jolts a drawer
HASTY = 0.30  # ours: half a second or more [m/s]
YAW = math.radians(10)  # ours: as far as the handle stays within easy reach


def close_drawer() -> Task:
    """Return the task."""
    cabinet = Cabinet("cabinet", ajar=AJAR)
    drawer = cabinet.top_drawer
    return Task(
        instruction="Close the top drawer of the cabinet by its handle.",
        paraphrases=(
            "Push the open drawer shut at its handle.",
            "Push the uppermost drawer back into the cabinet.",
        ),
        # Original: these x and y, no yaw.
        start={cabinet: OnBench(x=(0.68, 0.78), y=(-0.05, 0.05), yaw=(-YAW, YAW))},
        steps=(actions.close_by_handle(drawer, begun=BEGUN),),
        goal=(
            closed(drawer),  # paper: "with no gaps"
            clear_of(drawer.handle, by=0.04),  # original: gripper to handle more than 0.04 m
        ),
        never=failures.slamming(drawer, faster_than=HASTY),
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=DRAWER_VIEW,
    )
