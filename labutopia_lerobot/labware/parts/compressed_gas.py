"""Compressed gas: a cylinder that empties through its valve, its regulator and a tap."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.supply import area_share
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading

MOLAR_GAS = 8.314462618
"""Molar gas constant [J/mol K] (CODATA 2018)."""
ATMOSPHERE = 101325.0
"""Pressure of the room [Pa]: the standard atmosphere."""
_BAR = 1e5
_OPEN = 0.02
"""Share of its way from which a cylinder's valve is open; ours."""
_DISCHARGE = 0.6
"""Of a sharp-edged hole (White, "Fluid Mechanics", on obstruction meters)."""


def through_hole(
    area: float, pressure: float, outside: float, molar: float, kappa: float, temperature: float
) -> float:
    """Return how much of an ideal gas flows out through a sharp-edged hole [kg/s].

    Saint-Venant and Wantzel's law: it chokes where the pressure outside is below the critical one,
    as at a nozzle's throat (White, "Fluid Mechanics", section 9.4; from memory).

    Args:
        area: Of the hole [m^2].
        pressure: Before it, absolute [Pa].
        outside: Behind it [Pa].
        molar: Molar mass [kg/mol].
        kappa: Ratio of its heat capacities.
        temperature: Before it [K].
    """
    if pressure <= outside:
        return 0.0
    critical = (2.0 / (kappa + 1.0)) ** (kappa / (kappa - 1.0))
    ratio = max(outside / pressure, critical)
    factor = 2.0 * kappa / (kappa - 1.0) * (ratio ** (2.0 / kappa) - ratio ** (1.0 + 1.0 / kappa))
    density = pressure * molar / (MOLAR_GAS * temperature)
    return _DISCHARGE * area * math.sqrt(density * pressure * factor)


@dataclass(frozen=True)
class CompressedGas(Process):
    """An ideal gas at the room's temperature in a cylinder, before and behind its regulator.

    The regulator lets gas through until the pressure behind it is what its knob sets; turned back,
    it does not let the gas off again. Its reading is its first gauge's: the pressure before the
    regulator, above that of the room [bar], which is the cylinder's while its valve is open.

    Attributes:
        name: What its reading is called.
        valve: Of the cylinder.
        setting: What the regulator is set to, above the pressure of the room [bar].
        outlet: Tap behind the regulator.
        hole: Area of the open tap [m^2].
        volumes: Of the cylinder, of what is before and of what is behind the regulator [m^3].
        filled: Pressure of the full cylinder, above that of the room [bar].
        molar: Molar mass of the gas [kg/mol].
        kappa: Ratio of its heat capacities.
    """

    name: str
    valve: MovingPart
    setting: Process
    outlet: MovingPart
    hole: float
    volumes: tuple[float, float, float]
    filled: float
    molar: float
    kappa: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """Amounts in the three volumes [mol]."""
        return ("cylinder", "before", "behind")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with a full cylinder, and a regulator full of gas at the room's pressure."""
        pressures = np.array([ATMOSPHERE + self.filled * _BAR, ATMOSPHERE, ATMOSPHERE])
        apparatus.memory(self)[:] = pressures * self.volumes / (MOLAR_GAS * apparatus.ambient)

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let out what flows in a period, then let what is connected come to one pressure."""
        amounts, volumes = apparatus.memory(self), self.volumes
        molar_room = MOLAR_GAS * apparatus.ambient
        amounts[2] -= self.flow(apparatus) * apparatus.period / self.molar
        amounts[2] = max(amounts[2], ATMOSPHERE * volumes[2] / molar_room)
        wanted = ATMOSPHERE + self._set(apparatus) * _BAR
        before, behind = self.pressures(apparatus)[1:]
        if behind < min(wanted, before):
            short = (wanted - behind) * volumes[2] / molar_room
            # No more than what brings both sides to one pressure.
            joined = volumes[1] * volumes[2] / (volumes[1] + volumes[2])
            passes = min(short, (before - behind) * joined / molar_room)
            amounts[1:] += -passes, passes
        if apparatus.joint(self.valve.joint) > _OPEN * self.valve.widest:
            amounts[:2] = amounts[:2].sum() * np.array(volumes[:2]) / sum(volumes[:2])

    def pressures(self, apparatus: Apparatus) -> tuple[float, float, float]:
        """Return the three pressures, absolute [Pa]: p V = n R T."""
        amounts = apparatus.memory(self)
        cylinder, before, behind = (
            float(amount) * MOLAR_GAS * apparatus.ambient / volume
            for amount, volume in zip(amounts, self.volumes, strict=True)
        )
        return cylinder, before, behind

    def flow(self, apparatus: Apparatus) -> float:
        """Return what leaves the outlet now [kg/s]."""
        opening = apparatus.joint(self.outlet.joint) / self.outlet.widest
        area, behind = self.hole * area_share(opening), self.pressures(apparatus)[2]
        return through_hole(area, behind, ATMOSPHERE, self.molar, self.kappa, apparatus.ambient)

    def _set(self, apparatus: Apparatus) -> float:
        reading = self.setting.reading(apparatus)
        return 0.0 if reading is None else reading.value

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading((self.pressures(apparatus)[1] - ATMOSPHERE) / _BAR, "bar", 1.0)


@dataclass(frozen=True)
class OutletPressure(Process):
    """The second gauge of a regulator: the pressure behind it, above that of the room [bar].

    Attributes:
        name: What its reading is called.
        of: The gas.
    """

    name: str
    of: CompressedGas

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading((self.of.pressures(apparatus)[2] - ATMOSPHERE) / _BAR, "bar", 0.1)


@dataclass(frozen=True)
class OutletFlow(Process):
    """What leaves a regulator's outlet, as a volume at the pressure of the room [l/min].

    Attributes:
        name: What its reading is called.
        of: The gas.
    """

    name: str
    of: CompressedGas

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        volume = MOLAR_GAS * apparatus.ambient / (ATMOSPHERE * self.of.molar)
        return Reading(60e3 * volume * self.of.flow(apparatus), "l/min", 0.1)
