"""Press: push the red one of three buttons in and hold it (paper, level 1, "Press").

Ported from: config/level1_press.yaml, tasks/press_task.py, controllers/press_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.button_panel import ButtonPanel
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import aligned, fingered, pressed, touched
from labutopia_lerobot.scenes.views import PRESS_VIEW
from labutopia_lerobot.skills import Press
from labutopia_lerobot.task import Milestone, Step, Task


def press() -> Task:
    """Return the task."""
    panel = ButtonPanel("panel")
    red, *others = panel.buttons
    # Paper: "precisely aligned"; ours: nearer to the middle of the button than to its edge.
    on_axis = aligned(red, within=0.009, within_deg=10)
    in_by_finger = (pressed(red), fingered(red))  # original: 5 mm; paper: "stable contact"
    return Task(
        instruction="Press the red button on the control panel and keep it pressed.",
        paraphrases=(
            "Push the red button in and hold it down.",
            "Find the red button of the panel, press it and do not let go.",
        ),
        start={
            # Original: buttons at x 0.40, y -0.40 to 0.04, z 1.0 to 1.2, no yaw; colours shuffled.
            # Turned by less than 20 degrees, the button furthest right drives the default robot's
            # joint 6 against its end.
            panel: OnBench(
                x=(0.36, 0.42),
                y=(-0.28, -0.08),
                yaw=(-math.radians(35), -math.radians(20)),
                height=(0.225, 0.425),
                shuffled=tuple(button.name for button in panel.buttons),
            )
        },
        steps=(
            Step(
                "press",
                (Press(red, hold=2.5),),
                (Milestone("aligned", (on_axis,)), Milestone("pressed", in_by_finger)),
                (red,),
            ),
        ),
        goal=(*in_by_finger, on_axis),  # paper: "without misalignment"
        never={"wrong_button": touched(*others)},
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=PRESS_VIEW,
    )
