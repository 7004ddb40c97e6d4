"""Open door: pull the door of a drying oven open by its handle (paper, level 1, "Open Door").

Ported from: config/level1_open_door.yaml, tasks/openclose_task.py,
controllers/open_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace
from labutopia_lerobot.labware.instruments.vacuum_oven import VacuumOven
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, faster, opened
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

OPEN_TO = math.radians(50)  # original: the arc that its expert pulls the door along
BEGUN = math.radians(2)  # ours: further than a grip jolts a door
HASTY = math.radians(60)  # ours: it takes a second or more
YAW = math.radians(10)  # ours: as far as the handle stays within easy reach


type Oven = DryingOven | MuffleFurnace | VacuumOven


def open_door() -> Task:
    """Return the task."""
    return open_oven(DryingOven("oven"))


def open_oven(oven: Oven) -> Task:
    """Return the task with an oven, which level 3 varies."""
    door = oven.door
    return Task(
        instruction=(
            "Open the door of the drying oven by its handle, by 50 degrees or more, and let go."
        ),
        paraphrases=(
            "Pull the drying oven's door half open by its handle and let go of that.",
            "Take the handle of the oven, swing its door open by 50 degrees or more, let go.",
        ),
        # Original: these x and y, no yaw.
        start={oven: OnBench(x=(0.70, 0.80), y=(0.05, 0.15), yaw=(-YAW, YAW))},
        steps=(actions.open_by_handle(door, to=OPEN_TO, begun=BEGUN, pull=math.radians(53)),),
        goal=(
            opened(door, to=OPEN_TO),  # paper: "remaining open at the target angle"
            ~faster(door, than=math.radians(2)),  # ours: at rest
            clear_of(door.handle, by=0.04),  # original: gripper to handle more than 0.04 m
        ),
        never=failures.slamming(door, faster_than=HASTY),
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=DOOR_VIEW,
    )
