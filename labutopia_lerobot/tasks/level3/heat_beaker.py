"""Heat beaker, generalised: a button of a named colour (paper, level 3, "Heater Beaker").

Ported from: config/level3_HeatLiquid.yaml, tasks/placepress_task.py,
controllers/placepress_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level2.heat_beaker import YAW, heat_on
from labutopia_lerobot.tasks.variety import draw_filling

# Level 2's range, and beside it.
PLACES = {
    "on the right": OnBench((0.13, 0.28), (-0.30, -0.15), YAW),
    "in the middle": OnBench((0.13, 0.28), (-0.14, -0.05), YAW),
}


def heat_beaker(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    # Original: red, blue and green, in training as in tests.
    color = draw.choice("color", train=("green", "red", "blue"), test=("yellow",))
    right, middle = PLACES
    where = PLACES[draw.choice("position", train=(right,), test=(middle,))]
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    heater = Heater("heater", color)
    task = heat_on(heater)
    vessel, _ = task.start
    return replace(
        task,
        instruction=(
            f"Lift the beaker by 20 cm or more, put it on the hot plate and press the {color} "
            "button."
        ),
        paraphrases=(
            f"Raise the beaker by 20 cm, place it on the heater, press that one's {color} button.",
            f"Carry the beaker high, set it on the hot plate and push the button that is {color}.",
        ),
        start={**task.start, heater: where},
        contents={vessel: draw_filling(draw, ml=60)},  # as in level 2
    )
