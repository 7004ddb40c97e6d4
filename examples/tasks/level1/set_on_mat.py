"""Set a beaker down on a cork mat, which is an instrument of one's own."""

import math
from dataclasses import dataclass

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks import actions, failures


@dataclass(frozen=True)
class CorkMat(Instrument):
    """A square mat with a raised middle, to set hot glass on.

    Attributes:
        name: Name of its body; prefix of all its elements.
    """

    name: str
    size = (0.15, 0.15, 0.03)
    mass = 0.2
    source = "made up"
    movable = True

    @property
    def top_height(self) -> float:
        """Height of its top above its base [m]; `OnTop` asks for it."""
        return self.size[2]

    def _forms(self) -> list[Form]:
        return [
            Block((-0.075, 0.075), (-0.075, 0.075), (0.0, 0.012), "wood"),
            Block((-0.06, 0.06), (-0.06, 0.06), (0.012, self.top_height), "wood"),
        ]


def set_on_mat() -> Task:
    """Return the task."""
    glass, mat = glassware("beaker", "250 ml", "beaker"), CorkMat("mat")
    place = OnTop(mat)
    return Task(
        instruction="Set the beaker down on the cork mat.",
        start={
            glass: OnBench(x=(0.19, 0.34), y=(0.10, 0.25)),
            mat: OnBench(x=(0.18, 0.33), y=(-0.30, -0.18), yaw=(-math.pi / 8, math.pi / 8)),
        },
        steps=(actions.pick(glass), actions.place(glass, place, within=0.03)),
        goal=actions.left_standing(glass, place, within=0.03),
        never=failures.handling(glass, spill=0.01),
        time_limit_s=30.0,
    )
