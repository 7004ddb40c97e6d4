"""Pour, size test: beakers of sizes that were never trained on (paper, Table 4, "Pour").

The original has no configuration of it.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.glassware import beaker, enlarged
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.pour import pour_from


def pour_sizes(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    # Ours: in all directions, relative to a beaker of 150 ml; 45 to 70 mm wide.
    size = draw.choice("size", train=(1.0, 0.9, 1.08), test=(0.75, 1.16), shifted=True)
    vessel = enlarged(beaker("beaker", "150 ml"), size)
    return replace(
        pour_from(vessel),
        instruction="Pour the beaker in the gripper, whatever its size, into the large beaker.",
        paraphrases=(
            "Empty the beaker you are holding, be it small or large, into the big beaker.",
            "Tip the contents of the beaker of whatever size into the 800 ml beaker.",
        ),
        contents={vessel: Filling(ml=round(0.35 * vessel.capacity))},  # as in level 1: a good third
    )
