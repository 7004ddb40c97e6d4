"""Operate drawer: open the top drawer of a cabinet and close it again (paper, level 2).

Ported from: config/level2_openclose.yaml, tasks/openclose_task.py,
controllers/openclose_controller.py.
"""

import math
from dataclasses import replace

from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, closed, faster, opened
from labutopia_lerobot.scenes.views import DRAWER_VIEW
from labutopia_lerobot.task import Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.level1.open_drawer import BEGUN, OPEN_TO

HASTY = 0.30  # ours: half a second or more [m/s]
YAW = math.radians(10)  # ours: as far as the handle stays within easy reach


def operate_drawer() -> Task:
    """Return the task."""
    cabinet = Cabinet("cabinet")
    drawer = cabinet.top_drawer
    clear = clear_of(drawer.handle, by=0.04)  # original: gripper to handle more than 0.04 m
    opening = actions.open_by_handle(drawer, to=OPEN_TO, begun=BEGUN, pull=0.15)
    let_go = Substep("released", (clear, opened(drawer, to=OPEN_TO), ~faster(drawer, than=0.01)))
    return Task(
        instruction=(
            "Open the top drawer of the cabinet by its handle, by 13 cm or more, let go, then "
            "close it by its handle."
        ),
        paraphrases=(
            "Pull the uppermost drawer 13 cm or more out by its handle, let go, push it back shut.",
            "Open the cabinet's top drawer by 13 cm or more, let go, and afterwards close it.",
        ),
        # Original: these x and y, no yaw.
        start={cabinet: OnBench(x=(0.69, 0.79), y=(-0.05, 0.05), yaw=(-YAW, YAW))},
        steps=(
            replace(opening, substeps=(*opening.substeps, let_go)),
            actions.close_by_handle(drawer, begun=OPEN_TO),
        ),
        goal=(closed(drawer), clear),  # paper: "retreat a specified distance"
        never=failures.slamming(drawer, faster_than=HASTY),
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=DRAWER_VIEW,
    )
