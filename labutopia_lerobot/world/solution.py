"""The solution in a vessel, as chemistry has it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

_ROOM = 293.15
"""Temperature that `warmth` counts from [K]: that of a room."""


@dataclass(frozen=True)
class Solution:
    """The contents of a vessel, as they are once they have mixed.

    A species is called by formula and phase, such as `Cu^2+(aq)`.

    Attributes:
        volume: m^3.
        temperature: Mean, by heat [K]; not a number where there is nothing.
        ph: What a pH meter reads in it, stirred; not a number where there is nothing, and of other
            liquids than water.
        concentrations: Of every dissolved species; where nothing is dissolved in the scene, of the
            liquids that it is mixed of [mol/m^3].
        solids: Amounts of what has precipitated [mol].
        gas: Amounts of what has left it as gas since the start [mol].
        mixed: Part of what is not water that is where, and as, it is in the end.
        colour: sRGB of 1 cm of it as it is now, each channel in [0, 1].
    """

    volume: float
    temperature: float
    ph: float
    concentrations: Mapping[str, float]
    solids: Mapping[str, float]
    gas: Mapping[str, float]
    mixed: float
    colour: tuple[float, float, float]

    @property
    def numbers(self) -> dict[str, float | None]:
        """What `info` has of it: ml, pH, degrees C, solids and gas [mol], how mixed it is.

        Then each dissolved species [mol/l], and each solid and gas [mol], such as `mol_AgCl(s)`.
        An empty vessel has neither pH nor temperature: None, since NaN is not equal to itself.
        """
        return {
            "ml": round(1e6 * self.volume, 6),
            "ph": None if math.isnan(self.ph) else self.ph,
            "celsius": None if math.isnan(self.temperature) else self.temperature - 273.15,
            "mol_solid": sum(self.solids.values()),
            "mol_gas": sum(self.gas.values()),
            "mixed": self.mixed,
            **{f"molar_{key}": 1e-3 * value for key, value in self.concentrations.items()},
            **{f"mol_{key}": mol for key, mol in [*self.solids.items(), *self.gas.items()]},
        }

    @property
    def observed(self) -> dict[str, float]:
        """What a policy on privileged states sees of it.

        By how much its pH is below 7; the colour; by how many tens of degrees it is warmer than a
        room; all that is in solution [mol/l]; solids and gas [mol]; how mixed it is. An empty
        vessel is as water.
        """
        there = self.volume > 0.0
        red, green, blue = self.colour
        return {
            "acidity": 7.0 - self.ph if there else 0.0,
            "red": red,
            "green": green,
            "blue": blue,
            "warmth": (self.temperature - _ROOM) / 10.0 if there else 0.0,
            "dissolved": 1e-3 * sum(self.concentrations.values()),
            "solid": sum(self.solids.values()),
            "gas": sum(self.gas.values()),
            "mixed": self.mixed,
        }

    @classmethod
    def nothing(cls, gas: Mapping[str, float]) -> "Solution":
        """Return what is in an empty vessel, which gas may have left before."""
        return cls(0.0, math.nan, math.nan, {}, {}, gas, 1.0, (1.0, 1.0, 1.0))


SOLUTION_NAMES = tuple(Solution.nothing({}).observed)
"""Names of what is observed of a solution."""
