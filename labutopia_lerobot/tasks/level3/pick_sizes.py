"""Pick, size test: conical flasks of sizes that were never trained on (paper, Table 4, "Pick").

The original has no configuration of it.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.glassware import enlarged, erlenmeyer_flask
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.pick import pick_up


def pick_sizes(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    # Ours: in all directions, relative to level 1's flask; a neck of 32 to 60 mm.
    size = draw.choice("size", train=(1.0, 0.85, 1.15), test=(0.7, 1.35), shifted=True)
    return replace(
        pick_up(enlarged(erlenmeyer_flask("flask"), size)),
        instruction="Pick up the conical flask, whatever its size.",
        paraphrases=(
            "Take the conical flask, be it small or large, and lift it off the bench.",
            "Grasp the conical flask of whatever size by its neck and raise it.",
        ),
        time_limit_s=1000 / 60,  # original, level 3: 1000 steps at 60 Hz
    )
