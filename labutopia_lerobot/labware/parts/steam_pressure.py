"""The pressure in an autoclave: that of saturated steam, which a valve lets off."""

from dataclasses import dataclass
from typing import override

from labutopia_lerobot.labware.parts.compressed_gas import ATMOSPHERE, through_hole
from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.motor import Bolt
from labutopia_lerobot.labware.parts.supply import area_share
from labutopia_lerobot.processes import Apparatus, Process, ThermalMass
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.world import ON, Reading

_BAR = 1e5
_TORR = 133.322
"""[Pa]."""
_ANTOINE = 8.14019, 1810.94, 244.485
"""Of water from 99 to 374 degrees C, in Torr and degrees C (Dortmund Data Bank; from memory)."""
_EVAPORATION = 2.257e6
"""Heat of evaporation of water at 100 degrees C [J/kg] (CRC Handbook)."""
_STEAM = 0.018015, 1.33
"""Of steam: molar mass [kg/mol], ratio of its heat capacities (CRC Handbook; White, table A.4)."""
_BOILING = 100.0 + ZERO_C
_LOCKED = 1.1e5
"""Pressure above which the lid stays locked [Pa]; ours: EN 61010-2-040 wants no lid that opens
under pressure."""


def saturated(celsius: float) -> float:
    """Return the pressure of saturated steam by Antoine's equation [Pa]."""
    a, b, c = _ANTOINE
    return _TORR * float(10.0 ** (a - b / (c + celsius)))


@dataclass(frozen=True)
class SteamPressure(Process):
    """The pressure in a chamber with boiling water, absolute [bar].

    Its air has been driven out (ours), and below 100 degrees C as much comes back in as keeps it
    at the pressure of the room. What leaves through the valve takes its heat of evaporation along;
    with the lid open the water boils until it has 100 degrees C.

    Attributes:
        name: What its reading is called.
        steam: Water and steam.
        lid: What feels whether the lid is shut.
        valve: Lets steam off.
        hole: Area of the open valve [m^2].
    """

    name: str
    steam: ThermalMass
    lid: Shut
    valve: MovingPart
    hole: float

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self.steam)
        over = self.steam.temperature(apparatus) - _BOILING
        if over <= 0.0:
            return
        if self.lid.reading(apparatus).value:
            memory[1] -= _EVAPORATION * self.vented(apparatus) * apparatus.period
        else:
            memory[1] -= over * self.steam.capacity

    def vented(self, apparatus: Apparatus) -> float:
        """Return what the valve lets off now [kg/s]."""
        opening = apparatus.joint(self.valve.joint) / self.valve.widest
        own = self.steam.temperature(apparatus)
        pressure = self.pressure(apparatus)
        return through_hole(self.hole * area_share(opening), pressure, ATMOSPHERE, *_STEAM, own)

    def pressure(self, apparatus: Apparatus) -> float:
        """Return it [Pa]."""
        if not self.lid.reading(apparatus).value:
            return ATMOSPHERE
        return max(ATMOSPHERE, saturated(self.steam.temperature(apparatus) - ZERO_C))

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(self.pressure(apparatus) / _BAR, "bar", 0.01)


@dataclass(frozen=True)
class PressureLock(Process):
    """Keeps a shut lid shut while there is pressure under it; its reading is 1 where it does.

    Attributes:
        name: What its reading is called.
        bolt: What keeps the lid shut.
        pressure: That under it.
    """

    name: str
    bolt: Bolt
    pressure: SteamPressure

    @override
    def step(self, apparatus: Apparatus) -> None:
        self.bolt.command(apparatus, bolted=self._locked(apparatus))

    def _locked(self, apparatus: Apparatus) -> bool:
        return self.pressure.pressure(apparatus) > _LOCKED

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(self._locked(apparatus)), ON)
