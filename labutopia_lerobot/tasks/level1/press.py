"""Press: push the red one of three buttons in and hold it (paper, level 1, "Press").

Ported from: config/level1_press.yaml, tasks/press_task.py, controllers/press_controller.py.
"""

import math

from labutopia_lerobot.labware.instruments.button_panel import ButtonPanel
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import Predicate, aligned, fingered, pressed, touched
from labutopia_lerobot.scenes.views import PRESS_VIEW
from labutopia_lerobot.skills import Press
from labutopia_lerobot.task import Step, Substep, Task
from labutopia_lerobot.world import Button

# Ours: see `ButtonPanel`. Turned by less than 20 degrees, the button furthest right drives the
# default robot's joint 6 against its end.
YAW = (-math.radians(35), -math.radians(20))
HEIGHT = (0.225, 0.425)  # original: z 1.0 to 1.2


def press() -> Task:
    """Return the task."""
    panel = ButtonPanel("panel")
    red, *others = panel.buttons
    names = tuple(button.name for button in panel.buttons)
    return Task(
        instruction="Press the red button on the control panel and keep it pressed.",
        paraphrases=(
            "Push the red button in and hold it down.",
            "Find the red button of the panel, press it and do not let go.",
        ),
        # Original: buttons at x 0.40, y -0.40 to 0.04, no yaw; colours shuffled.
        start={panel: OnBench((0.36, 0.42), (-0.28, -0.08), YAW, HEIGHT, shuffled=names)},
        steps=(press_and_hold(red),),
        goal=held_in(red),
        never={"wrong_button": touched(*others)},
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=PRESS_VIEW,
    )


def press_and_hold(button: Button) -> Step:
    """Return what is done; level 3 shares it."""
    *in_by_finger, on_axis = held_in(button)
    substeps = Substep("aligned", (on_axis,)), Substep("pressed", tuple(in_by_finger))
    return Step("press", (Press(button, hold=2.5),), substeps, (button,))


def held_in(button: Button) -> tuple[Predicate, ...]:
    """Return what must hold in the end; level 3 shares it."""
    return (
        pressed(button),  # original: 5 mm
        fingered(button),  # paper: "stable contact"
        # Paper: "precisely aligned", "without misalignment"; ours: nearer to the middle of the
        # button than to its edge.
        aligned(button, within=0.009, within_deg=20),
    )
