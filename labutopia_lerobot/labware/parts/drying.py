"""Dry air: what a desiccant leaves of its moisture, and what an open door brings back."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading

_ROOM = 50.0
"""Relative humidity of the room [%], as the air over evaporating vessels has it (docs/heat.md)."""
_DRY = 20.0
"""That of a shut cabinet in the end [%]; ours: cabinets with silica gel come to 20 to 30."""
_DRIES, _MIXES = 1800.0, 10.0
"""Time constants of the gel, and of the air behind a wide open door [s]; ours: a cabinet is dry
after an hour or two, and has the room's air within seconds."""
_AJAR = math.radians(2.0)


@dataclass(frozen=True)
class Drying(Process):
    """The relative humidity in a desiccator [%]: it falls towards an end as a first-order lag does.

    Attributes:
        name: What its reading is called.
        door: Lets the room's air in; the wider it is open, the faster.
        gel: Drawer with the desiccant, which dries while it is in.
        begins: Humidity when the episode begins [%].
    """

    name: str
    door: MovingPart
    gel: MovingPart
    begins: float = 30.0

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("humidity",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = self.begins

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        opened = min(max(apparatus.joint(self.door.joint), 0.0), math.pi / 2)
        mixes = math.sin(opened) / _MIXES if opened > _AJAR else 0.0
        dries = (apparatus.joint(self.gel.joint) < 0.1 * self.gel.widest) / _DRIES
        rate = mixes + dries
        if rate:
            goal = (mixes * _ROOM + dries * _DRY) / rate
            memory[0] += -math.expm1(-rate * apparatus.period) * (goal - memory[0])

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[0]), "%RH", 1.0)

    @override
    def text(self, apparatus: Apparatus) -> str:
        if apparatus.joint(self.door.joint) > _AJAR:
            return "DOOR OPEN"
        return super().text(apparatus)
