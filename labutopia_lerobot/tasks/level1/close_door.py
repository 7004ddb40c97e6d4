"""Close door: push the open door of a drying oven shut by its handle (paper, level 1, "Close").

Ported from: config/level1_close_door.yaml, tasks/openclose_task.py,
controllers/close_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import clear_of, closed
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures

# The original's expert pushes the door along an arc of 50 degrees. Ours starts 10 cm from the
# handle; wider or turned further, the door would stand where the hand is.
AJAR = math.radians(40)
BEGUN = AJAR - math.radians(2)  # ours: further than a grip jolts a door
HASTY = math.radians(60)  # ours: a third of a second for the last 20 degrees
YAW = math.radians(5)


def close_door() -> Task:
    """Return the task."""
    oven = DryingOven("oven", ajar=AJAR)
    door = oven.door
    return Task(
        instruction="Close the door of the drying oven by its handle.",
        paraphrases=(
            "Push the drying oven's door shut at its handle.",
            "Close the open door completely by its handle.",
        ),
        # Original: these x and y, no yaw.
        start={oven: OnBench(x=(0.77, 0.85), y=(-0.05, 0.0), yaw=(-YAW, YAW))},
        steps=(actions.close_by_handle(door, begun=BEGUN),),
        goal=(
            closed(door),  # paper: "with no gaps"
            clear_of(door.handle, by=0.08),  # original: gripper to handle more than 0.08 m
        ),
        never=failures.slamming(door, faster_than=HASTY),
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=DOOR_VIEW,
    )
