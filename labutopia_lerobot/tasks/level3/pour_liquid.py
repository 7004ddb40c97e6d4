"""Pour liquid, generalised: out of vessels of several kinds (paper, level 3, Table 3, "Pour").

Ported from: config/level3_PourLiquid.yaml, tasks/pickpour_task.py,
controllers/pickpour_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level2.pour_liquid import pour_from
from labutopia_lerobot.tasks.variety import VESSELS, draw_filling

# Original: graduated_cylinder_03, conical_bottle03 and beaker2, in training as in tests; the kinds
# for tests are ours.
TRAIN = ("graduated cylinder", "500 ml conical flask", "250 ml beaker")
TEST = ("300 ml conical flask", "150 ml beaker")
# Level 2's range, which the original's lies in, and beside it.
PLACES = {
    "on the right": OnBench(x=(0.17, 0.32), y=(-0.35, -0.20)),
    "in the middle": OnBench(x=(0.17, 0.32), y=(-0.19, -0.10)),
}


def pour_liquid(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    name = draw.choice("object", train=TRAIN, test=TEST)
    right, middle = PLACES
    where = PLACES[draw.choice("position", train=(right,), test=(middle,))]
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    vessel = VESSELS[name]("vessel")
    task = pour_from(vessel)
    _, target = task.start
    return replace(
        task,
        instruction=(
            f"Lift the {name} by 20 cm or more, pour it into the large beaker and put it back "
            "where it stood."
        ),
        paraphrases=(
            f"Raise the {name} by 20 cm, empty it into the big beaker, put it back in its place.",
            f"Lift the {name} high, empty it into the 800 ml beaker, put it back in its place.",
        ),
        start={**task.start, target: where},
        contents={vessel: draw_filling(draw, ml=100)},  # as in level 2
    )
