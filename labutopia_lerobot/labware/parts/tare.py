"""The tare button of a balance: what is on the pan when it clicks counts as nothing then."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from labutopia_lerobot.labware.parts.reading import Mass


@dataclass(frozen=True)
class Tare:
    """A push-button that sets a display to zero.

    Attributes:
        button: Name of the button.
        reading: What the display shows.
    """

    button: str
    reading: Mass

    @property
    def name(self) -> str:
        """Name of the tared mass in the simulation and in the model [kg]."""
        return self.reading.tare


@runtime_checkable
class Balance(Protocol):
    """A piece that weighs."""

    @property
    def tares(self) -> tuple[Tare, ...]:
        """Its tare buttons."""
        ...
