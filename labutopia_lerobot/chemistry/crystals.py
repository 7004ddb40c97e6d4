"""Crystals that are filled in, and how fast they dissolve."""

import math
from dataclasses import dataclass
from functools import cached_property

from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.network import WATER, network
from labutopia_lerobot.chemistry.refusals import ChemistryError

_DIFFUSION = 1.5e-9
"""Of a salt in water [m^2/s]: 1.2 to 2.0e-9 (CRC Handbook, "Diffusion coefficients in liquids")."""

_VISCOSITY = 0.89e-6
"""Kinematic, of water [m^2/s] (CRC Handbook)."""


_PACKED = 0.6
"""Part of a heap that its grains fill: spheres that are poured come to 0.6 (Scott and Kilgour,
"The density of random close packing of spheres", 1969)."""

_BACK = 0.2
"""Part of the light that meets a grain that turns around, as `chemistry.palette` has it."""


class NoCrystalsError(ChemistryError):
    """Crystals that cannot be filled in; the message says what is not known of them."""


@dataclass(frozen=True)
class Crystals:
    """Some grams of a solid, in grains of one size.

    Attributes:
        of: Name, formula, id or CAS number of the compound.
        grams: How much of it.
        grain_mm: Diameter of a grain [mm]; ours: that of table salt.
    """

    of: str
    grams: float
    grain_mm: float = 0.5

    @cached_property
    def compound(self) -> Compound:
        """The compound.

        Raises:
            UnknownCompoundError: It is not in the table.
            AmbiguousCompoundError: The name fits several.
        """
        return resolve(self.of)

    @property
    def species(self) -> str:
        """Key of the solid, such as `NaCl(s)`."""
        formula = self.compound.formula
        return network().same(formula, "s") or f"{formula}(s)"

    @property
    def mol(self) -> float:
        """Amount of it [mol]."""
        return 1e-3 * self.grams / self.compound.molar_mass

    @property
    def dissolves_into(self) -> dict[str, float]:
        """What one of its formula units becomes in water, by keys of species."""
        return dict(network().species[self.species].components)

    @property
    def heaped_volume(self) -> float:
        """Volume of a mole of it in a heap [m^3/mol]."""
        assert self.compound.density is not None
        return self.compound.molar_mass / (self.compound.density * _PACKED)

    @property
    def scattering(self) -> float:
        """What its grains scatter out of the way when they are stirred up [m^2/kg].

        3 / (2 r rho) is the cross-section of spheres of radius r.
        """
        assert self.compound.density is not None
        return _BACK * 1.5 / (5e-4 * self.grain_mm * self.compound.density)

    def require_known(self) -> None:
        """Make sure that they can lie in water and dissolve there at a known rate.

        Raises:
            NoCrystalsError: If not; the message says what is missing.
        """
        if not (0.0 < self.grams < math.inf and 0.01 <= self.grain_mm <= 5.0):
            raise NoCrystalsError(
                f"{self.grams:g} g of {self.of} in grains of {self.grain_mm:g} mm cannot be: "
                "choose some number of grams above 0, and grains of 0.01 to 5 mm"
            )
        one, known = self.compound, network().species
        if self.species not in known or not all(
            key == WATER or key.endswith("(aq)") for key in self.dissolves_into
        ):
            raise NoCrystalsError(
                f"the table does not say what crystals of {self.of} become in water. Choose a salt "
                "of which it has the ions, such as sodium chloride"
            )
        if one.density is None:
            raise NoCrystalsError(
                f"nothing says how fast crystals of {self.of} dissolve: the table has no density "
                "of it. Choose another salt"
            )

    def rate(self, left: float, speed: float, room: float) -> float:
        """Return which part of what is left dissolves in a second [1/s].

        Diffusion through the film around a sphere, driven by how far the solution is from
        saturation (Noyes and Whitney; Sherwood number by Froessling and Ranz and Marshall: Bird,
        Stewart and Lightfoot, Transport Phenomena, section 22.3). All grains shrink alike.

        Args:
            left: Part of them that is left.
            speed: Of the water past them [m/s].
            room: How much the solution still takes [mol/m^3].
        """
        assert self.compound.density is not None
        diameter = 1e-3 * self.grain_mm * min(left, 1.0) ** (1 / 3)
        sherwood = 2.0 + 0.6 * math.sqrt(speed * diameter / _VISCOSITY) * (
            _VISCOSITY / _DIFFUSION
        ) ** (1 / 3)
        lacking = room * self.compound.molar_mass / self.compound.density
        return float(6.0 * sherwood * _DIFFUSION * lacking / diameter**2)
