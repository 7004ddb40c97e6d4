"""Weigh out: pour the mass that the instruction says, out of vessels of several kinds.

Beyond the paper. Level 2 weighs out 50 g of one beaker.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level2.beyond.pour_to_mass import weigh_from

# Ours: what the hand gets around and 100 ml fill by a third to two thirds. A 250 ml beaker of the
# usual shape is not among them: it gives so little at a time that it slips meanwhile (2 of 7). The
# shape held out is a conical flask, whose neck gives less at first and more later than any beaker.
VESSELS = {
    "150 ml beaker": ("beaker", "150 ml"),
    "tall 250 ml beaker": ("beaker_tall", "250 ml"),
    "tall 150 ml beaker": ("beaker_tall", "150 ml"),
    "300 ml conical flask": ("conical_flask", "300 ml"),
}
GRAMS = (50, 30, 40, 60)
"""Masses for training [g]; ours."""
GRAMS_FOR_TESTS = (35, 45, 55)
"""Masses for tests [g]: between those, so that no number of the instruction was ever seen."""


def weigh_out(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names = list(VESSELS)
    name = draw.choice("object", train=names[:2], test=names[2:], shifted=True)
    grams = draw.choice("mass", train=GRAMS, test=GRAMS_FOR_TESTS, shifted=True)
    return replace(
        weigh_from(glassware(*VESSELS[name], name="vessel"), mass=grams),
        instruction=f"Tare the balance, pour {grams} g of water from the {name} into the beaker on "
        f"its pan and put the {name} back.",
        paraphrases=(
            f"Set the balance to zero, weigh out {grams} g of water from the {name}, return it.",
            f"Pour from the {name} until the tared balance shows {grams} g, then put it back.",
        ),
        time_limit_s=120.0,  # ours: a flask trickles for long
    )
