"""A heating mantle for round-bottomed flasks."""

import math
from dataclasses import dataclass
from itertools import pairwise

import mujoco

from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import EnergyRegulator, HeatZone, Process, ThermalMass
from labutopia_lerobot.processes.heat import UPWARDS
from labutopia_lerobot.world import ON

_BOWL, _DEEP = 0.054, 0.046
"""Radius of the bowl, for a 500 ml flask, and how deep it is [m]."""
_TOP = 0.128
_WATT, _LEAK = 200.0, 0.25
"""Power of a mantle for 500 ml, usual, from memory [W], and what its wool lets through [W/K]; ours:
350 degrees C above the room with nothing in it and the knob half way, as cloth of glass bears."""
_CAPACITY = 0.20 * 800.0
"""Of 0.2 kg of glass cloth and heating wire [J/K]; ours, 800 J/kg K as glass."""
_IN_CLOTH = 30.0
"""From the cloth to the whole outside of the flask in it [W/m^2 K]; ours: 0.5 mm of air, 60, over
the lower half of it."""


@dataclass(frozen=True)
class HeatingMantle(Instrument):
    """A mantle of glass cloth in a round case, with an energy regulator.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.247, 0.220, 0.140)
    mass = 2.2
    source = "220 mm across, 140 mm high, for 500 ml, as usual; from memory"

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.038, look="black", steps=6)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="red")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.heat, self.power

    @property
    def bowl(self) -> Seat:
        """The middle of the bowl's floor."""
        at = (0.0, 0.0, _TOP - _DEEP)
        return Seat(f"{self.name}_bowl", self.name, at, width=0.046, depth=_DEEP)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.bowl,)

    @property
    def warming(self) -> tuple[Process, ...]:
        """What knob and switch say, the cloth, and the regulator, which measures nothing."""
        knob, power = Scale(self.heat, 0, 1, "1", resolution=0.01), Scale(self.power, 0, 1, ON)
        floor = _TOP - _DEEP
        low, high = (-0.030, -0.030, floor - 0.006), (0.030, 0.030, floor + 0.020)
        cloth = ThermalMass(
            f"{self.name}_cloth",
            self.name,
            _CAPACITY,
            area=math.pi * _BOWL**2,
            length=_BOWL / 2,  # area over circumference
            convection=UPWARDS,
            leak=_LEAK,
            zone=HeatZone(low, high, _IN_CLOTH),
        )
        regulator = EnergyRegulator(
            f"{self.name}_power_now", cloth.name, _WATT, power.name, knob.name
        )
        return knob, power, cloth, regulator

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    def _forms(self) -> list[Form]:
        case = ((0, 0.010), (0.104, 0.010), (0.110, 0.030), (0.110, 0.100), (0.096, _TOP))
        collar = ((0.096, _TOP), (0.090, 0.140), (0.066, 0.140), (0.058, _TOP))
        depths = [math.radians(a) for a in (0, 18, 36, 54, 62)]
        cloth = [(_BOWL * math.cos(a), _TOP - _BOWL * math.sin(a)) for a in depths]
        floor = _TOP - _DEEP
        rings: list[Form] = [
            Ring(2 * outer, 0.180, (low, high), "white", touch=True)
            for (outer, high), (_, low) in pairwise(cloth)
        ]
        return [
            Turned((*case, *collar[1:]), "light_blue", edge=0.004, touch=False),
            Turned(((0.066, 0.140), (0.058, _TOP), *cloth, (0.0, floor)), "white", touch=False),
            Turned(
                ((0, 0.010), (0.104, 0.010), (0.110, 0.030), (0.110, floor), (0, floor)),
                "light_blue",
            ),
            *rings,
            Ring(0.124, 0.186, (_TOP, 0.139), "light_blue"),
            Block((-0.118, -0.090), (-0.060, 0.060), (0.026, 0.078), "anthracite", edge=0.005),
            *feet(0.180, 0.180, 0.010),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.heat.add_to(spec, self.name, body, (-0.118, -0.018, 0.052), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.118, 0.038, 0.052), ON_FRONT)
