"""Furniture that is fitted with cupboards and drawers."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple

import mujoco

from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.joinery import Chest, Cupboard
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.solid import UNTURNED, Quaternion, Vector
from labutopia_lerobot.labware.parts.top import Top


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
    def places(self) -> tuple[Seat, ...]:
        """Things on its tops, then those in its units."""
        inside = (place for unit in self._units() for place in unit.made.places)
        return (*self._places_on_top(), *inside)

    @abstractmethod
    def _units(self) -> Sequence[Unit]:
        """Return its cupboards and chests."""

    def _places_on_top(self) -> Sequence[Seat]:
        """Return where things stand on it."""
        return along(self.name, "top", self.tops[0], count=3) if self.tops else ()

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for unit in self._units():
            unit.made.add_to(spec, body, self.name, unit.at, unit.quat)


def along(piece: str, label: str, top: Top, count: int) -> tuple[Seat, ...]:
    """Return places in a row on a top, numbered from right to left.

    Args:
        piece: Name of the furniture; what stands there stands on its root body.
        label: Of the top, in the names of its places.
        top: The top.
        count: How many places.
    """
    (near, far), (right, left) = top.x, top.y
    step = (left - right) / count
    return tuple(
        Seat(
            f"{piece}_{label}_{n}",
            piece,
            ((near + far) / 2, right + (n + 0.5) * step, top.height),
            width=0.8 * min(step, far - near),
        )
        for n in range(count)
    )
