"""Open drawer: pull the top drawer of a cabinet open by its handle (paper, level 1, "Open").

Ported from: config/level1_open_drawer.yaml, tasks/openclose_task.py,
controllers/open_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, faster, opened
from labutopia_lerobot.scenes.views import DRAWER_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

OPEN_TO = 0.13  # original: handle moved by more than 0.13 m
BEGUN = 0.01  # ours: further than a grip jolts a drawer; those of learned policies by 6.6 mm
HASTY = 0.30  # ours: half a second or more [m/s]
YAW = math.radians(10)  # ours: as far as the handle stays within easy reach


def open_drawer() -> Task:
    """Return the task."""
    cabinet = Cabinet("cabinet")
    drawer = cabinet.top_drawer
    return Task(
        instruction=(
            "Open the top drawer of the cabinet by its handle, by 13 cm or more, and let go."
        ),
        paraphrases=(
            "Pull the uppermost drawer 13 cm or more out by its handle and let go of that.",
            "Take the handle of the top drawer, pull that open by 13 cm or more and leave it so.",
        ),
        # Original: these x and y, no yaw.
        start={cabinet: OnBench(x=(0.70, 0.77), y=(-0.05, 0.05), yaw=(-YAW, YAW))},
        steps=(actions.open_by_handle(drawer, to=OPEN_TO, begun=BEGUN, pull=0.15),),
        goal=(
            opened(drawer, to=OPEN_TO),
            ~faster(drawer, than=0.01),  # ours: at rest
            clear_of(drawer.handle, by=0.04),  # original: gripper to handle more than 0.04 m
        ),
        never=failures.slamming(drawer, faster_than=HASTY),
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=DRAWER_VIEW,
    )
