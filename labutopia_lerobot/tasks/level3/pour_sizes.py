"""Pour, size test: vessels of sizes and of a shape never trained on (paper, Table 4, "Pour").

The original has no configuration of it.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.pour import pour_from

# Ours: "significantly different sizes" (paper) are at least half as large again each; 70 to 130 mm
# high, 38 to 70 mm wide, which is what the hand gets around. The shape held out is a conical flask.
VESSELS = {
    f"{size} {name}": (kind, size)
    for kind, name, sizes in (
        ("beaker_tall", "beaker", ("100 ml", "250 ml", "50 ml", "400 ml")),
        ("erlenmeyer_wide", "conical flask", ("250 ml",)),
    )
    for size in sizes
}


def pour_sizes(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names = list(VESSELS)
    size = draw.choice("size", train=names[:2], test=names[2:], shifted=True)
    vessel = glassware(*VESSELS[size], name="vessel")
    return replace(
        pour_from(vessel),
        instruction="Pour the vessel in the gripper, whatever its size, into the large beaker.",
        paraphrases=(
            "Empty the vessel you are holding, be it small or large, into the big beaker.",
            "Tip the contents of the vessel of whatever size into the 800 ml beaker.",
        ),
        contents={vessel: Filling(ml=round(0.35 * vessel.capacity))},  # as in level 1: a good third
    )
