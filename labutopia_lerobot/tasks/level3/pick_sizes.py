"""Pick, size test: vessels of sizes and of a shape never trained on (paper, Table 4, "Pick").

The original has no configuration of it.
"""

from dataclasses import replace

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.pick import pick_up

# Ours: "significantly different sizes" (paper) are at least twice as large each; 90 to 280 mm high,
# necks of 22 to 50 mm. The shape that is held out is a ball on a flat bottom.
VESSELS = {
    f"{size} {name}": (kind, size)
    for kind, name, sizes in (
        ("erlenmeyer_narrow", "conical flask", ("250 ml", "100 ml", "1000 ml", "50 ml", "2000 ml")),
        ("flat_bottom_flask", "flat-bottomed flask", ("500 ml",)),
    )
    for size in sizes
}


def pick_sizes(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    names = list(VESSELS)
    size = draw.choice("size", train=names[:3], test=names[3:], shifted=True)
    return replace(
        pick_up(glassware(*VESSELS[size], name="flask")),
        instruction="Pick up the flask, whatever its size, and hold it still, 20 cm or more up.",
        paraphrases=(
            "Take the flask, be it small or large, lift it by more than 20 cm and hold it there.",
            "Grasp the flask of whatever size by its neck and raise it higher than 20 cm.",
        ),
        time_limit_s=1000 / 60,  # original, level 3: 1000 steps at 60 Hz
    )
