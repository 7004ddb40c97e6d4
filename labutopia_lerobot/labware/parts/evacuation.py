"""Chambers that are evacuated: the air in them, and what the room's air does to their door."""

from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.compressed_gas import ATMOSPHERE, MOLAR_GAS, through_hole
from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.drive import all_on
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.supply import area_share
from labutopia_lerobot.processes import Apparatus, Process, ThermalMass
from labutopia_lerobot.world import Reading

_MBAR = 100.0
_AIR = 0.028965, 1.40
"""Of air: molar mass [kg/mol], ratio of its heat capacities (White, "Fluid Mechanics", table A.4;
from memory)."""
_HELD = 120.0
"""Torque up to which a door is pressed shut [N m]; ours, that of a lid's `Bolt`: the true one is
twenty times that, which no stop of a hinge bears at 300 steps a second. No hand opens either."""


@dataclass(frozen=True)
class Pump:
    """A vacuum pump: its pumping speed falls to none where the pressure is its end vacuum.

    Attributes:
        on: Name of the reading that is above 0 while it runs.
        speed: Pumping speed at the room's pressure [m^3/s].
        end: End vacuum [mbar].
    """

    on: str
    speed: float
    end: float

    def takes(self, apparatus: Apparatus, pressure: float) -> float:
        """Return what it takes in at a pressure [Pa], at the room's temperature [kg/s]."""
        if not all_on(apparatus, (self.on,)):
            return 0.0
        over = max(0.0, pressure - self.end * _MBAR)
        return _AIR[0] * self.speed * over / (MOLAR_GAS * apparatus.ambient)


@dataclass(frozen=True)
class EvacuatedChamber(Process):
    """The air in a chamber, an ideal gas; its reading is its pressure, absolute [mbar].

    One tap leads to a pump, one to the room. What leaves is the less of what the pump takes and of
    what the hole of its tap lets through. Above the room's pressure, as where shut air is warmed,
    air gets out below the seal of the door, and an open door lets in all that is missing.

    Attributes:
        name: What its reading is called.
        volume: Of the chamber [m^3].
        air: Name of the thermal mass whose temperature it has.
        door: What feels whether the door is shut.
        pump: What evacuates it.
        outlet: Tap to the pump.
        vent: Tap to the room.
        hole: Area of an open tap [m^2].
        leak: By how much the pressure rises in it, evacuated and at the room's temperature [Pa/s].
    """

    name: str
    volume: float
    air: str
    door: Shut
    pump: Pump
    outlet: MovingPart
    vent: MovingPart
    hole: float
    leak: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("air",)  # amount [mol]

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = self._full(apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, full = apparatus.memory(self), self._full(apparatus)
        if not self.door.reading(apparatus).value:
            memory[0] = full
            return
        gain = self.let_in(apparatus) - self.let_out(apparatus)
        memory[0] = min(memory[0] + gain * apparatus.period / _AIR[0], full)

    def temperature(self, apparatus: Apparatus) -> float:
        """Return that of its air [K]."""
        air = apparatus.processes[self.air]
        assert isinstance(air, ThermalMass)
        return air.temperature(apparatus)

    def pressure(self, apparatus: Apparatus) -> float:
        """Return it, absolute [Pa]: p V = n R T."""
        amount = float(apparatus.memory(self)[0])
        return amount * MOLAR_GAS * self.temperature(apparatus) / self.volume

    def let_in(self, apparatus: Apparatus) -> float:
        """Return what comes in through the vent and the leak now [kg/s].

        The leak is a hole too, as wide as its rate needs into a vacuum.
        """
        room, pressure = apparatus.ambient, self.pressure(apparatus)
        leaks = self.leak * self.volume * _AIR[0] / (MOLAR_GAS * room)
        leaks /= through_hole(1.0, ATMOSPHERE, 0.0, *_AIR, room)
        area = self.hole * area_share(_opening(apparatus, self.vent)) + leaks
        return through_hole(area, ATMOSPHERE, pressure, *_AIR, room)

    def let_out(self, apparatus: Apparatus) -> float:
        """Return what goes to the pump now [kg/s]."""
        pressure, own = self.pressure(apparatus), self.temperature(apparatus)
        area = self.hole * area_share(_opening(apparatus, self.outlet))
        return min(
            self.pump.takes(apparatus, pressure), through_hole(area, pressure, 0.0, *_AIR, own)
        )

    def _full(self, apparatus: Apparatus) -> float:
        """Return the amount that has the pressure of the room [mol]."""
        return ATMOSPHERE * self.volume / (MOLAR_GAS * self.temperature(apparatus))

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(self.pressure(apparatus) / _MBAR, "mbar", 1.0)


@dataclass(frozen=True)
class AirLoad(Process):
    """The force with which the air of the room presses a shut door onto its chamber [N].

    Attributes:
        name: What its reading is called.
        of: The chamber.
        hinge: Joint of the door [rad]; 0 is shut.
        area: On which the pressures differ [m^2].
        arm: From the hinge to the middle of that area [m].
    """

    name: str
    of: EvacuatedChamber
    hinge: str
    area: float
    arm: float

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build its actuator, of its name, into a spec that has the hinge."""
        spec.add_actuator(
            name=self.name, target=self.hinge, trntype=mujoco.mjtTrn.mjTRN_JOINT
        ).gainprm[0] = 1.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        torque = min(self.force(apparatus) * self.arm, _HELD)
        apparatus.data.ctrl[apparatus.model.actuator(self.name).id] = -torque

    def force(self, apparatus: Apparatus) -> float:
        """Return it [N]."""
        return max(0.0, ATMOSPHERE - self.of.pressure(apparatus)) * self.area

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(self.force(apparatus), "N", 1.0)


def _opening(apparatus: Apparatus, tap: MovingPart) -> float:
    return apparatus.joint(tap.joint) / tap.widest
