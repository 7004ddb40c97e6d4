"""Pick, generalised: containers of several kinds on several bench tops (paper, level 3, "Pick").

Ported from: config/level3_pick.yaml, tasks/pick_task.py, controllers/pick_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.pick import pick_up
from labutopia_lerobot.tasks.variety import VESSELS

# Original: conical_bottle02, 03 and 04, in training as in tests; the kinds for tests are ours.
FLASKS = ("300 ml conical flask", "500 ml conical flask", "1000 ml conical flask")
OTHERS = ("graduated cylinder", "volumetric flask", "250 ml beaker")


def pick(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    name = draw.choice("object", train=FLASKS, test=OTHERS)
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    return replace(
        pick_up(VESSELS[name]("container")),
        instruction=f"Pick up the {name} and hold it still, 20 cm or more above the bench.",
        paraphrases=(
            f"Take the {name}, lift it by more than 20 cm and hold it there.",
            f"Grasp the {name} and raise it higher than 20 cm.",
        ),
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
    )
