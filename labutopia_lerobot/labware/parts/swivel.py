"""Seats: one that turns on a gas spring."""

from typing import ClassVar

from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.slide import Slide


class Swivel(Instrument):
    """A stool or a chair: it says how far its seat goes up, and what it is made of.

    Attributes:
        rise: How far the seat goes up [m].
    """

    rise: ClassVar[float]
    movable = True

    @property
    def column(self) -> Slide:
        """The gas spring, which carries the seat and goes up."""
        return Slide(f"{self.name}_column", self.rise, friction=15.0, effort=50.0)

    @property
    def seat(self) -> Rotor:
        return Rotor(f"{self.name}_seat", friction=0.2, effort=1.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.column, self.seat
