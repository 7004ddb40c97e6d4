"""Substances: what a liquid is made of.

Values at 25 C and atmospheric pressure from the CRC Handbook of Chemistry and Physics (95th
edition): densities from section 3, "Physical Constants of Organic Compounds", viscosities and
surface tensions from section 6, "Viscosity of Liquids" and "Surface Tension of Common Liquids",
specific heats from section 5, "Heat Capacity of Liquids", boiling points from section 3.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

from labutopia_lerobot.errors import UserError

ZERO_C = 273.15
"""0 degrees Celsius [K]."""

type Color = tuple[float, float, float, float]


class UnknownSubstanceError(UserError, ValueError):
    """There is no substance of that name; the message lists those that there are."""


@dataclass(frozen=True)
class Substance:
    """A liquid.

    Attributes:
        name: What it is called.
        density: kg/m^3.
        viscosity: Dynamic viscosity [Pa s].
        surface_tension: Against air [N/m].
        rgba: How it is drawn.
        specific_heat: Heat that warms 1 kg by 1 K [J/kg K].
        boiling_point: At atmospheric pressure [K].

    Raises:
        ValueError: A quantity is not a positive number.
    """

    name: str
    density: float
    viscosity: float
    surface_tension: float
    rgba: Color
    specific_heat: float = 4182.0
    boiling_point: float = 373.15

    def __post_init__(self) -> None:
        for field in fields(self)[1:4]:
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{field.name} of {self.name} must be positive, not {value}")

    @property
    def kinematic_viscosity(self) -> float:
        """Viscosity divided by density [m^2/s]."""
        return self.viscosity / self.density


# Clear liquids are tinted, as in laboratory practice with a dye, so that a camera sees them.
WATER = Substance("water", 997.0, 0.890e-3, 0.0720, (0.20, 0.48, 0.85, 0.55))
ETHANOL = Substance("ethanol", 785.0, 1.074e-3, 0.0220, (0.55, 0.82, 0.62, 0.45), 2438.0, 351.4)
ETHYLENE_GLYCOL = Substance(
    "ethylene glycol", 1110.0, 16.1e-3, 0.0480, (0.86, 0.35, 0.62, 0.55), 2394.0, 470.5
)
GLYCEROL = Substance("glycerol", 1258.0, 0.934, 0.0625, (0.93, 0.72, 0.30, 0.65), 2377.0, 563.0)

SUBSTANCES: Mapping[str, Substance] = {
    s.name: s for s in (WATER, ETHANOL, ETHYLENE_GLYCOL, GLYCEROL)
}
"""Every substance by name."""


def substance(name: str) -> Substance:
    """Return the substance of a name.

    Raises:
        UnknownSubstanceError: There is none.
    """
    if name not in SUBSTANCES:
        raise UnknownSubstanceError(
            f"substance {name!r} is unknown. Choose from: {', '.join(SUBSTANCES)}"
        )
    return SUBSTANCES[name]
