"""Transport beaker, generalised: onto a plate of a named colour (paper, level 3, "Transport").

Ported from: config/level3_TransportBeaker.yaml, tasks/place_task.py,
controllers/pickplace_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.labware.instruments.target_plate import PORCELAIN, TargetPlate
from labutopia_lerobot.labware.parts.colors import COLORS
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level2.transport_beaker import transport_to
from labutopia_lerobot.tasks.variety import draw_filling

# Level 2's range, and beside it.
PLACES = {
    "on the right": OnBench(x=(0.18, 0.33), y=(-0.33, -0.18)),
    "in the middle": OnBench(x=(0.18, 0.33), y=(-0.17, -0.05)),
}


def transport_beaker(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    color = draw.choice("color", train=("red", "blue"), test=("green",))  # original: all in both
    right, middle = PLACES
    where = PLACES[draw.choice("position", train=(right,), test=(middle,))]
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    plate = TargetPlate("target_plate", color=PORCELAIN, glaze=COLORS[color])
    task = transport_to(plate)
    vessel, _ = task.start
    return replace(
        task,
        instruction=f"Lift the beaker by 20 cm or more and move it onto the {color} plate.",
        paraphrases=(
            f"Pick up the beaker, raise it by 20 cm and set it down on the plate that is {color}.",
            f"Carry the beaker, 20 cm above the bench, to the {color} plate and leave it there.",
        ),
        start={**task.start, plate: where},
        contents={vessel: draw_filling(draw, ml=100)},  # as in level 2
    )
