"""Liquid nitrogen in a vessel with a stopper: it boils off by all the heat that gets in."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.puffs import Puffs
from labutopia_lerobot.processes import Apparatus, Process, ThermalMass
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.world import Reading

BOILS = -195.8
"""Boiling point at the pressure of the room [degrees C] (CRC Handbook; from memory)."""
DENSITY, EVAPORATION, CAPACITY = 806.6, 1.992e5, 2042.0
"""Of the boiling liquid: density [kg/m^3], heat of evaporation [J/kg], heat capacity [J/kg K] (NIST
Chemistry WebBook; from memory)."""
_STEFAN_BOLTZMANN = 5.670e-8
"""W/m^2 K^4 (CODATA)."""
_LEAST, _DENSE = 1.0, 12.0
"""Power that boils it from which on mist is seen, and where that is densest [W]; ours: nothing of a
shut vessel, some of an open one, a cloud where something warm is put in."""
_BOILING = BOILS + ZERO_C


@dataclass(frozen=True)
class LiquidNitrogen(Process):
    """The nitrogen that is left; its reading is how high it stands over its vessel's floor [mm].

    It is boiling. The heat of its `ThermalMass` is what comes through the insulation and from
    things that are put in; through an open neck the room radiates onto it besides, as onto a black
    body (cold vapour lies still in the neck: no convection). All of it evaporates nitrogen.

    Attributes:
        name: What its reading is called.
        cold: Heat, temperature and leak; what is dry warms up as if it were full.
        stopper: What shuts the neck: its slide, 0 where it is shut.
        neck: Diameter of the neck [m].
        vessel: Inner diameter of the vessel [m].
        filled: Volume at the start [m^3].
    """

    name: str
    cold: ThermalMass
    stopper: MovingPart
    neck: float
    vessel: float
    filled: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("mass", "power")  # of what is left [kg], that boiled it in the last period [W]

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        static = self.cold.leak * (apparatus.ambient - _BOILING)
        apparatus.memory(self)[:] = DENSITY * self.filled, static

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let what is warmer than boiling boil until it is not."""
        memory, heat = apparatus.memory(self), apparatus.memory(self.cold)
        gained = self.cold.capacity * (float(heat[0]) - _BOILING)
        gained += self.radiated(apparatus) * apparatus.period
        boiled = min(float(memory[0]) * EVAPORATION, max(0.0, gained))
        memory[:] = memory[0] - boiled / EVAPORATION, boiled / apparatus.period
        heat[0] = _BOILING + (gained - boiled) / self.cold.capacity

    def radiated(self, apparatus: Apparatus) -> float:
        """Return what comes in through the neck now [W].

        Drawn up by a quarter of the neck's diameter, the stopper leaves an opening around it that
        is as large as the neck.
        """
        share = min(1.0, max(0.0, 4.0 * apparatus.joint(self.stopper.joint) / self.neck))
        hotter = apparatus.ambient**4 - self.cold.temperature(apparatus) ** 4
        return share * math.pi / 4 * self.neck**2 * _STEFAN_BOLTZMANN * hotter

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        volume = float(apparatus.memory(self)[0]) / DENSITY
        return Reading(1e3 * volume / (math.pi / 4 * self.vessel**2), "mm", 1.0)


@dataclass(frozen=True)
class BoilOff(Process):
    """How fast liquid nitrogen boils off, as liquid [l/day], and the mist that is seen of it.

    The mist is the moisture of the room's air; it goes over the rim and down. Nothing feels it.

    Attributes:
        name: What its reading is called; beginning of the names of the puffs.
        of: The nitrogen.
        mouth: Name of the frame in the middle of the neck's mouth.
    """

    name: str
    of: LiquidNitrogen
    mouth: str

    @property
    def puffs(self) -> Puffs:
        """How the mist is drawn: it sinks by 0.2 m at 0.15 m/s; ours."""
        radius = self.of.neck / 2
        return Puffs(self.name, radius, 0.20, 0.15, (0.6, 2.4), sinks=True)

    def power(self, apparatus: Apparatus) -> float:
        """Return the heat that boils it now [W]."""
        return float(apparatus.memory(self.of)[1])

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        litres = 1e3 * self.power(apparatus) / (EVAPORATION * DENSITY)
        return Reading(86400.0 * litres, "l/day", 0.01)

    @override
    def show(self, apparatus: Apparatus) -> None:
        over = max(0.0, self.power(apparatus) - _LEAST)
        dense = min(1.0, math.sqrt(over / (_DENSE - _LEAST)))
        self.puffs.show(apparatus, apparatus.site(self.mouth).position_w, dense)
