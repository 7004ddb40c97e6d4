"""A magnetic stirring bar: what a stirrer's magnet turns."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.glass.series import UtensilSeries, numbers_of
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.parts.magnetic_stirring import MAGNET
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP

_FRICTION = 0.08
"""Of PTFE on glass; tables give 0.04 to 0.1."""


@dataclass(frozen=True)
class StirringBar(Utensil):
    """A bar with a magnet in it, whose site says so."""

    @property
    @override
    def _hardness(self) -> tuple[tuple[float, ...], int]:
        return SOLIMP, 1  # it is the PTFE that slides, whatever the glass

    @override
    def _add_more(self, body: mujoco.MjsBody) -> None:
        body.add_site(
            name=f"{self.name}{MAGNET}", pos=(0, 0, self.shape.grip_height), group=COLLISION_GROUP
        )


@dataclass(frozen=True)
class StirringBarSeries(UtensilSeries):
    """Stirring bars in all their sizes."""

    @override
    def make(self, size: str, name: str) -> StirringBar:
        """Return a bar of a size; see `UtensilSeries.make`."""
        numbers = [1e-3 * number for number in numbers_of(self, size)]
        return StirringBar(name, self.shape(name, *numbers), self.material, self.stands, _FRICTION)
