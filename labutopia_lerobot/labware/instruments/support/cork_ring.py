"""A cork ring for round-bottomed flasks."""

from dataclasses import dataclass

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.parts.form import Form, Ring
from labutopia_lerobot.labware.parts.instrument import Instrument


@dataclass(frozen=True)
class CorkRing(Instrument):
    """A ring of pressed cork: a round flask that is wider than its hole sits in it.

    Attributes:
        name: Name of its body; prefix of all its elements.
        diameter: Outer diameter [m]; the hole is a little over half as wide, and thrice as wide as
            the ring is high.
    """

    name: str
    diameter: float = 0.110
    size = (0.110, 0.110, 0.030)
    mass = 0.06
    source = "110 x 60 x 30 mm for flasks of 250 to 500 ml, as usual; from memory"
    movable = True
    passive = True

    @property
    def hole(self) -> float:
        """Diameter of its hole [m]."""
        return 0.55 * self.diameter

    @property
    def top(self) -> float:
        """Height of its top [m]."""
        return 0.27 * self.diameter

    def seat(self, profile: Profile) -> float:
        """Return the height above its base at which the base of a round flask is in it [m]."""
        return self.top - profile.outer_height(self.hole / 2)

    def _forms(self) -> list[Form]:
        return [Ring(self.hole, self.diameter, (0.0, self.top), "wood", facets=16)]
