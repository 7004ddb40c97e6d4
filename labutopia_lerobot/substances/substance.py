"""Substances: what a liquid is made of.

They are the liquids of the table of compounds (`chemistry/data/substances.json`, which has the
sources) of which all that a pour needs is known. Values at 25 C and atmospheric pressure.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

from labutopia_lerobot.chemistry.compound import Compound, substances
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.refusals import ChemistryError
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
        melting_point: The same [K]; 0 where it is not known.

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
    melting_point: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self)[1:4]:
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{field.name} of {self.name} must be positive, not {value}")

    @property
    def kinematic_viscosity(self) -> float:
        """Viscosity divided by density [m^2/s]."""
        return self.viscosity / self.density


# Clear liquids are tinted, as in laboratory practice with a dye, so that a camera sees them. These
# four are the liquids of the tasks: recorded pictures have these colours.
DYES: Mapping[str, Color] = {
    "water": (0.20, 0.48, 0.85, 0.55),
    "ethanol": (0.55, 0.82, 0.62, 0.45),
    "ethylene glycol": (0.86, 0.35, 0.62, 0.55),
    "glycerol": (0.93, 0.72, 0.30, 0.65),
}
"""Colour of the dye in a liquid, by its name."""

_CLEAR: Color = (0.80, 0.87, 0.92, 0.40)
"""Of other clear liquids: so pale that none of the dyes is mistaken for it; a choice of ours."""

_COLOURED = 0.8
"""Opacity of liquids that have a colour of their own; a choice of ours."""


def _poured(compound: Compound) -> Substance | None:
    """Return a compound as a liquid, or None if it is none or too little of it is known."""
    density, viscosity, tension = compound.density, compound.viscosity, compound.surface_tension
    capacity, boiling_point = compound.heat_capacity, compound.boiling_point
    if compound.phase != "liquid" or density is None or viscosity is None or tension is None:
        return None
    if capacity is None or boiling_point is None:
        return None
    name = compound.name.lower()
    specific_heat = float(round(capacity / compound.molar_mass))  # whole J/(kg K), as printed
    return Substance(
        name,
        density,
        viscosity,
        tension,
        _rgba(compound, name),
        specific_heat,
        boiling_point,
        compound.melting_point or 0.0,
    )


def _rgba(compound: Compound, name: str) -> Color:
    if name in DYES or compound.colour is None:
        return DYES.get(name, _CLEAR)
    red, green, blue = (int(compound.colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return (red, green, blue, _COLOURED)


_BY_ID = {one.id: liquid for one in substances().values() if (liquid := _poured(one))}

SUBSTANCES: Mapping[str, Substance] = {liquid.name: liquid for liquid in _BY_ID.values()}
"""Every substance by name."""

WATER = SUBSTANCES["water"]
ETHANOL = SUBSTANCES["ethanol"]
ETHYLENE_GLYCOL = SUBSTANCES["ethylene glycol"]
GLYCEROL = SUBSTANCES["glycerol"]


def substance(name: str) -> Substance:
    """Return the substance of a name, id, formula or CAS number.

    Raises:
        UnknownSubstanceError: There is none, or it is no liquid that can be poured.
    """
    if name in SUBSTANCES:
        return SUBSTANCES[name]
    try:
        compound = resolve(name)
    except ChemistryError as error:
        raise UnknownSubstanceError(
            f"substance {name!r} is unknown: {error}. Choose from: {', '.join(SUBSTANCES)}"
        ) from error
    if compound.id not in _BY_ID:
        raise UnknownSubstanceError(
            f"substance {name!r} cannot be poured: {compound.name} is no liquid at 25 C, or too "
            f"little is known of how it flows. Choose from: {', '.join(SUBSTANCES)}"
        )
    return _BY_ID[compound.id]
