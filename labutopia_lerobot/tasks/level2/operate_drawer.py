"""Operate drawer: open the top drawer of a cabinet and close it again (paper, level 2).

Ported from: config/level2_openclose.yaml, tasks/openclose_task.py,
controllers/openclose_controller.py.
"""

import math

from labutopia_lerobot.labware.cabinet import Cabinet
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, closed, collided, grasped, less_open, opened
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.skills.close import Close
from labutopia_lerobot.skills.open import Open
from labutopia_lerobot.task import Substep, Task

OPEN_TO = 0.13  # original: handle moved by more than 0.13 m
BEGUN = 0.005  # ours: further than a grip jolts a drawer
YAW = math.radians(10)  # ours: as far as the handle stays within easy reach


def operate_drawer() -> Task:
    """Return the task."""
    cabinet = Cabinet("cabinet")
    drawer = cabinet.top_drawer
    held = grasped(drawer.handle)
    clear = clear_of(drawer.handle, by=0.04)  # original: gripper to handle more than 0.04 m
    return Task(
        instruction="Open the top drawer of the cabinet, let go of it, then close it again.",
        paraphrases=(
            "Pull the uppermost drawer out by its handle, release it and push it back shut.",
            "Open the cabinet's top drawer and afterwards close it.",
        ),
        # Original: these x and y, no yaw.
        start={cabinet: OnBench(x=(0.69, 0.79), y=(-0.05, 0.05), yaw=(-YAW, YAW))},
        expert=(Open(drawer, to=0.15), Close(drawer)),
        substeps=(
            Substep("gripped", (held, less_open(drawer, than=BEGUN))),
            Substep(
                "opened",
                via=(opened(drawer, to=BEGUN),),
                keeping=(held,),  # paper: "securely grasped without being knocked"
                when=(opened(drawer, to=OPEN_TO),),
            ),
            Substep("released", (clear, opened(drawer, to=OPEN_TO))),
            Substep("gripped_again", (held, opened(drawer, to=OPEN_TO))),
            Substep(
                "closed",
                via=(less_open(drawer, than=OPEN_TO),),
                keeping=(held,),
                when=(closed(drawer),),
            ),
        ),
        goal=(closed(drawer), clear),  # paper: "retreat a specified distance"
        never={"collided": collided(cabinet, sparing=drawer.handle)},
        time_limit_s=2000 / 60,  # original: 2000 steps at 60 Hz
        view=DOOR_VIEW,
    )
