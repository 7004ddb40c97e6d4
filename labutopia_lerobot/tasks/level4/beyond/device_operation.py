"""Device operation: fill a drying oven and start it by its button (original, level 4).

In the original's code, where it stands for the paper's "Drying Beaker", with a press for the close.
Ported from: config/level4_DeviceOperation.yaml, tasks/device_operate_task.py,
controllers/device_operate_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import above, fingers_clear_of, switched_on
from labutopia_lerobot.scenes.views import OVEN_VIEW
from labutopia_lerobot.skills import Go
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.tasks import actions
from labutopia_lerobot.tasks.level4.drying_beakers import (
    CLEAR,
    HEADING,
    INSIDE,
    LARGE,
    LOADED,
    MIDDLE,
    MOUTH,
    NEVER,
    OUTSIDE,
    OVEN,
    RIGHT,
    SMALL,
    WITHIN,
    before,
    open_wide,
)

HIGH = replace(OUTSIDE, height=0.735)  # original: its expert goes 0.22 m above the handle
FRONT = OverBench("in front of the oven", ahead=0.45, left=-0.05, height=0.50)  # ours: out of it


def device_operation() -> Task:
    """Return the task."""
    oven = replace(OVEN, button_color="green")
    button = oven.button
    lift = Step(
        "raise",
        (Go((HIGH,), HEADING),),
        (Substep("raised", (above(oven.door.handle, by=0.15), CLEAR)),),  # original: 0.15 m
    )
    # Ours: round the free edge of the open door, and out of the oven before the hand turns aside.
    pick = actions.pick(LARGE, by=actions.OFF_THE_BENCH)
    press = actions.press(button, hold=0.3)
    pick = replace(pick, skills=(Go((HIGH, INSIDE), HEADING), *pick.skills))
    press = replace(
        press,
        skills=(Go((FRONT,), HEADING), *press.skills),
        touches=(button, oven.door, oven.door.handle),  # the door may be shut before
    )
    return Task(
        instruction=(
            "Open the drying oven wide, raise your hand 15 cm above its handle, put the large "
            "beaker and then the small one onto the shelf so that they touch nothing else, and "
            "start the oven with its green button."
        ),
        start=before(oven),
        steps=(
            open_wide(oven.door).named("1_open"),
            lift.named("2_raise"),
            pick.named("3_pick"),
            actions.place(LARGE, RIGHT, within=WITHIN, through=MOUTH).named("4_place"),
            actions.pick(SMALL, by=actions.OFF_THE_BENCH).named("5_pick"),
            actions.place(SMALL, MIDDLE, within=WITHIN, through=MOUTH).named("6_place"),
            press.named("7_press"),
        ),
        goal=(
            switched_on(oven.switch),
            fingers_clear_of(button, by=0.05),  # ours: as heat_beaker
            *LOADED,  # with the door open or shut: the original leaves it open
        ),
        never=NEVER,
        time_limit_s=4000 / 60,  # original: 4000 steps at 60 Hz
        view=OVEN_VIEW,
    )
