"""Lift a graduated cylinder a little, and keep it upright."""

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import falling, gripped, lifted, upright
from labutopia_lerobot.skills import Pick
from labutopia_lerobot.task import Step, Substep, Task


def raise_cylinder() -> Task:
    """Return the task: its file's path is its id, and nothing is registered."""
    cylinder = glassware("graduated_cylinder", "250 ml", "cylinder")
    held = Substep("gripped", (gripped(cylinder),))
    return Task(
        instruction="Raise the cylinder by ten centimetres without tilting it.",
        start={cylinder: OnBench(x=(0.22, 0.35), y=(-0.07, 0.07))},
        steps=(Step("raise", (Pick(cylinder, lift=0.15),), (held,), touches=(cylinder,)),),
        goal=(lifted(cylinder, by=0.10), gripped(cylinder), upright(cylinder, within_deg=10)),
        never={"dropped": falling(cylinder, faster_than=0.4)},
        time_limit_s=15.0,
    )
