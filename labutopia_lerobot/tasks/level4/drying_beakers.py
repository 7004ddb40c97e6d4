"""Drying beakers: put two beakers into a drying oven (paper, level 4, "Drying Beaker").

Ported from: config/level4_DeviceOperation.yaml, tasks/deviceoperation_task.py,
controllers/deviceoperation_controller.py. `device_operation` shares its oven, its
places and its first step.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import OnBench, Start
from labutopia_lerobot.places import OnShelf, OverBench
from labutopia_lerobot.predicates import clear_of, faster, latched, less_open, opened, touching
from labutopia_lerobot.scenes.views import OVEN_VIEW
from labutopia_lerobot.skills import Close, Go, Open
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions, failures
from labutopia_lerobot.tasks.level1.open_door import BEGUN, HASTY, OPEN_TO

OVEN = DryingOven("oven", latching=True, stand=0.20, shelf_height=0.14)  # original: 0.2 m up
LARGE, SMALL = (
    glassware("beaker", "250 ml", "large_beaker"),
    glassware("beaker", "150 ml", "small_beaker"),
)

WIDE = math.radians(90)  # ours: "fully"; the original's expert goes for 100 degrees
PULL = math.radians(95)
HEADING = math.radians(-35)  # ours: what every joint has room left with, from shut to open
YAW = math.radians(3)  # ours: further the handle of the open door is out of reach

# Ours: in the right half of the chamber; the forearm comes in by the left one.
RIGHT = OnShelf("right of the shelf", OVEN.shelf, inward=-0.19, left=-0.165)
MIDDLE = OnShelf("middle of the shelf", OVEN.shelf, inward=-0.19, left=-0.04)
MOUTH = OnShelf("mouth of the oven", OVEN.shelf, inward=-0.38, left=-0.05)
WITHIN = 0.04  # ours: half a beaker
# Ours: between the robot's base and the free edge of the open door a hand gets round that.
INSIDE = OverBench("before the oven", ahead=0.16, left=0.14, height=0.515)
OUTSIDE = OverBench("beside the open door", ahead=-0.02, left=0.36, height=0.515)

CLEARANCE = 0.04  # as open_door
CLEAR = clear_of(OVEN.door.handle, by=CLEARANCE)
LOADED = (
    *actions.left_standing(LARGE, RIGHT, within=WITHIN),
    *actions.left_standing(SMALL, MIDDLE, within=WITHIN),
    CLEAR,
)
NEVER = {
    **failures.slamming(OVEN.door, faster_than=HASTY),
    **failures.of_any(failures.handling(LARGE, spill=None), failures.handling(SMALL, spill=None)),
    # Paper: no "contact between the beakers or with the cabinet structure"
    "struck": touching(LARGE, SMALL, OVEN, OVEN.door, OVEN.door.handle)
    | touching(SMALL, OVEN, OVEN.door, OVEN.door.handle),
}


def drying_beakers() -> Task:
    """Return the task."""
    door = OVEN.door
    pick = actions.pick(LARGE, by=actions.OFF_THE_BENCH)
    pick = replace(pick, skills=(Go((OUTSIDE, INSIDE), HEADING), *pick.skills))
    shut = Step(
        "close",
        (Go((INSIDE, OUTSIDE), HEADING), Close(door, HEADING, beyond=1.6)),
        (
            Substep("moved", (less_open(door, than=WIDE - BEGUN),)),
            Substep("latched", (latched(door),)),
        ),
        (door, door.handle),  # ours: by the handle or not
    )
    return Task(
        instruction=(
            "Open the drying oven wide, put the large beaker and then the small one onto its "
            "shelf so that they touch nothing else, and close the door until it latches."
        ),
        start=before(OVEN),
        steps=(
            open_wide(door).named("1_open"),
            pick.named("2_pick"),
            actions.place(LARGE, RIGHT, within=WITHIN, through=MOUTH).named("3_place"),
            actions.pick(SMALL, by=actions.OFF_THE_BENCH).named("4_pick"),
            actions.place(SMALL, MIDDLE, within=WITHIN, through=MOUTH).named("5_place"),
            shut.named("6_close"),
        ),
        goal=(latched(door), *LOADED),  # paper: "properly shut and latched"
        never=NEVER,
        time_limit_s=4000 / 60,  # original: 4000 steps at 60 Hz
        view=OVEN_VIEW,
    )


def open_wide(door: Door[Handle]) -> Step:
    """Open a door, of this oven or before the robot as it is, and let go; it is then at rest."""
    free = clear_of(door.handle, by=CLEARANCE)
    wide = (free, opened(door, to=WIDE), ~faster(door, than=math.radians(2)))
    swing = actions.open_by_handle(door, to=OPEN_TO, begun=BEGUN, pull=PULL)
    return replace(
        swing,
        skills=(Open(door, PULL, heading=HEADING),),
        substeps=(*swing.substeps, Substep("wide", wide)),  # pulled, or pushed from inside
        touches=(door, door.handle),
    )


def before(oven: DryingOven) -> Mapping[Piece, Start]:
    """Return where the oven and the beakers stand at the start."""
    # Original: oven at x 0.55 to 0.60, y 0.13 to 0.18, beakers at x 0.15 to 0.20, y 0.23 to
    # 0.28 and 0.35 to 0.40, where the door, which it leaves open, would be shut over the hand.
    # Ours: an oven further left has its open door's handle out of reach, further right the
    # forearm meets that door, further back the arm is stretched out over the shelf.
    return {
        oven: OnBench(x=(0.57, 0.60), y=(-0.045, -0.005), yaw=(-YAW, YAW)),
        LARGE: OnBench(x=(0.00, 0.06), y=(-0.14, -0.06)),
        SMALL: OnBench(x=(0.00, 0.06), y=(-0.34, -0.26)),
    }
