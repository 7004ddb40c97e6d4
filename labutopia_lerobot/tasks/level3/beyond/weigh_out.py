"""Weigh out: pour the mass that the instruction says, out of vessels of several kinds.

Beyond the paper.
"""

from dataclasses import replace

from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level2.beyond.pour_to_mass import weigh_from
from labutopia_lerobot.tasks.variety import VESSELS

# Ours: those of `pour_liquid` that a hand tilts over the beaker on the balance. A conical flask
# slips in the hand when it is carried back, in two of six plays.
TRAIN, TEST = ("150 ml beaker", "250 ml beaker"), ("graduated cylinder",)
MASSES = ("30 g", "40 g", "50 g", "35 g", "45 g")


def weigh_out(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    name = draw.choice("object", train=TRAIN, test=TEST, shifted=True)
    mass = draw.choice("mass", train=MASSES[:3], test=MASSES[3:], shifted=True)
    source = VESSELS[name]("vessel")
    return replace(
        weigh_from(source, mass=float(mass.removesuffix(" g"))),
        instruction=f"Tare the balance, pour {mass} out of the {name} and put the rest back.",
        paraphrases=(
            f"Weigh out {mass} of water from the {name} into the beaker on the balance.",
            f"Set the balance to zero, pour {mass} from the {name}, then return it to its place.",
        ),
        contents={source: Filling(ml=100)},
    )
