"""Furniture that is fitted with cupboards and drawers."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple

import mujoco

from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.joinery import Chest, Cupboard
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.place import Place
from labutopia_lerobot.labware.parts.solid import UNTURNED, Quaternion, Vector


class Unit(NamedTuple):
    """A cupboard or a chest, and where it stands.

    Attributes:
        made: What it is.
        at: Centre of its base in the frame of the furniture [m].
        quat: Its orientation there, scalar-first.
    """

    made: Cupboard | Chest
    at: Vector = (0.0, 0.0, 0.0)
    quat: Quaternion = UNTURNED


class Fitted(Instrument, ABC):
    """Furniture with units, and with tops that carry things."""

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return tuple(part for unit in self._units() for part in unit.made.mechanisms)

    @property
    def places(self) -> tuple[Place, ...]:
        """What its tops carry, then what stands in its units."""
        return (*self._tops(), *(place for unit in self._units() for place in unit.made.places))

    @abstractmethod
    def _units(self) -> Sequence[Unit]:
        """Return its cupboards and chests."""

    def _tops(self) -> Sequence[Place]:
        """Return where things stand on it."""
        return ()

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for unit in self._units():
            unit.made.add_to(spec, body, self.name, unit.at, unit.quat)


def along(
    piece: str, top: str, ys: Sequence[float], x: float, height: float, width: float
) -> list[Place]:
    """Return places in a row on a top.

    Args:
        piece: Name of the furniture; what stands there stands on its root body.
        top: Name of the top, without the piece's; they are numbered.
        ys: Where they are across the furniture [m].
        x: Where they are in its depth [m].
        height: Of the top [m].
        width: Diameter of the largest thing that fits [m].
    """
    return [Place(f"{piece}_{top}_{n}", piece, (x, y, height), width) for n, y in enumerate(ys)]
