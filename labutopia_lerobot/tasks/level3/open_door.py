"""Open door, generalised: ovens with different doors (paper, level 3, Table 3, "Open Door").

Ported from: config/level3_open.yaml, tasks/openclose_task.py, controllers/open_controller.py.
"""

from dataclasses import replace

from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace
from labutopia_lerobot.labware.instruments.vacuum_oven import VacuumOven
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.open_door import YAW, Oven, open_oven

# Original: three ovens, in training as in tests, at x 0.65 to 0.77, y -0.05 to 0.15. Ours: ranges
# of level 1's width, such that every handle is where level 1's is; that of the vacuum oven is 2 cm
# nearer, or else the arm is stretched when the door is open.
OVENS: dict[str, tuple[Oven, OnBench]] = {
    "drying oven": (DryingOven("oven"), OnBench((0.70, 0.80), (0.05, 0.15), (-YAW, YAW))),
    "vacuum oven": (
        VacuumOven("oven", set_to=None),
        OnBench((0.68, 0.78), (0.05, 0.15), (-YAW, YAW)),
    ),
    "muffle furnace": (
        MuffleFurnace("oven", set_to=None),
        OnBench((0.70, 0.80), (0.19, 0.29), (-YAW, YAW)),
    ),
}


def open_door(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    drying, vacuum, muffle = OVENS
    name = draw.choice("object", train=(drying, vacuum), test=(muffle,))
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    oven, where = OVENS[name]
    return replace(
        open_oven(oven),
        instruction=(
            f"By its handle, open the door of the {name} by 50 degrees or more, and let go."
        ),
        paraphrases=(
            f"Pull the {name}'s door half open by its handle and let go of that.",
            f"Take the handle of the {name}, swing its door open by 50 degrees or more, let go.",
        ),
        start={oven: where},
    )
