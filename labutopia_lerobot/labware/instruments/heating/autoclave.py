"""An upright autoclave whose lid a hand-wheel locks."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dial_gauge import DialGauge
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.motor import Bolt
from labutopia_lerobot.labware.parts.panel import ON_FRONT, ON_TOP
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.steam_pressure import PressureLock, SteamPressure
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.labware.parts.valve import HandWheel, Tap
from labutopia_lerobot.labware.parts.warmth import thermometer
from labutopia_lerobot.processes import DoorGap, HeatZone, Process, ThermalMass, Thermostat

_R, _BORE, _TOP = 0.225, 0.150, 0.860
"""Radius outside and of the chamber, height of its rim [m]."""
_CAPACITY = 3.0 * 0.997 * 4182.0 + 12.0 * 480.0
"""Of 3 l of water (CRC Handbook) and of a boiler of 12 kg of steel [J/K]; ours, usual for 40 l."""
_IN_STEAM = 100.0
"""From the chamber to what stands in it [W/m^2 K]; ours: air has 10, steam that condenses on it
thousands, and there is something of both."""

_VALVE = math.pi * 0.0025**2
"""Area of the open valve [m^2]; ours: 5 mm wide."""


@dataclass(frozen=True)
class Autoclave(Instrument):
    """An autoclave of 40 litres on castors, with a gauge, a valve and a timer.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.501, 0.450, 1.001)
    mass = 55.0
    source = "450 mm across, 950 mm high without its wheel, as usual; from memory"
    left_out = "liquids in it boil at 100 degrees; its water does not get less"

    @property
    def wheel(self) -> HandWheel:
        """Hand wheel that locks the lid."""
        wheel = f"{self.name}_wheel"
        return HandWheel(wheel, diameter=0.220, turns=2.0, look="black", standoff=0.060, effort=4.0)

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(85.0), reach=0.420, friction=1.5)

    @property
    def time(self) -> Knob:
        return Knob(f"{self.name}_time", diameter=0.040)

    @property
    def valve(self) -> Tap:
        """Valve that lets steam out, on the right."""
        return Tap(f"{self.name}_valve", length=0.050, look="red")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.wheel, self.lid, self.time, self.valve

    @property
    def chamber(self) -> Seat:
        """The grid at the bottom of the chamber."""
        return Seat(f"{self.name}_chamber", self.name, (0.0, 0.0, 0.290), 0.260, depth=0.400)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.chamber,)

    @property
    def cycle(self) -> Countdown:
        """Time left of its cycle; it starts when its knob is turned, with its lid shut."""
        setting = Scale(self.time, 0, 60, "min")
        return Countdown(f"{self.name}_left", setting, guards=(Shut(self.lid),))

    @property
    def warming(self) -> tuple[Process, ...]:
        """Water on its floor, whose steam fills the chamber, and its thermostat.

        It holds 121 degrees C, at which steam sterilises in 15 min (European Pharmacopoeia, 5.1.1).
        2 kW and the leak are ours, usual for 40 l.
        """
        zone = HeatZone((-0.13, -0.13, 0.285), (0.13, 0.13, 0.750), _IN_STEAM)
        gap = DoorGap(self.lid.joint, math.pi * _BORE**2, 2 * _BORE, share=0.3)
        name = f"{self.name}_steam"
        steam = ThermalMass(name, self.name, _CAPACITY, leak=2.0, zone=zone, gap=gap)
        pressure = SteamPressure(f"{self.name}_pressure", steam, Shut(self.lid), self.valve, _VALVE)
        return (
            steam,
            Thermostat(thermometer(self.name), name, 2000.0, 121.0, self.cycle.name),
            pressure,
            PressureLock(f"{self.name}_lock", self.bolt, pressure),
        )

    @property
    def bolt(self) -> Bolt:
        """What keeps the lid shut under pressure."""
        return Bolt(self.lid.name, self.lid.joint)

    @property
    def gauge(self) -> DialGauge:
        """Its pressure gauge, from 0 to 4 bar, absolute."""
        pressure = self.warming[2]
        return DialGauge(f"{self.name}_gauge", pressure, 4.0, 0.030, (-0.262, 0.070, 0.690))

    @property
    def works(self) -> tuple[Process, ...]:
        """What feels its lid, its knob and its cycle, what heats meanwhile, pressure and gauge."""
        setting = Scale(self.time, 0, 60, "min")
        return Shut(self.lid), setting, self.cycle, *self.warming, self.gauge

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.110, 0.040), self.cycle, ink=(255, 90, 60)),)

    def _forms(self) -> list[Form]:
        castors: list[Form] = []
        for n in range(4):
            a = math.pi / 4 + n * math.pi / 2
            x, y = 0.16 * math.cos(a), 0.16 * math.sin(a)
            castors += [
                Rod((x, y - 0.012, 0.030), (x, y + 0.012, 0.030), 0.060, "rubber"),
                Rod((x, y, 0.030), (x, y, 0.082), 0.020, "steel"),
            ]
        return [
            Ring(2 * _BORE, 2 * _R, (0.080, 0.820), "white", facets=16),
            Ring(2 * _BORE, 0.420, (0.815, _TOP), "steel", facets=16),
            Rod((0, 0, 0.080), (0, 0, 0.280), 0.320, "steel"),
            Rod((0, 0, 0.280), (0, 0, 0.290), 0.290, "dark_steel"),
            Block((-0.245, -0.180), (-0.130, 0.130), (0.480, 0.740), "petrol", edge=0.010),
            Rod((-0.262, 0.070, 0.690), (-0.240, 0.070, 0.690), 0.070, "chrome"),
            *self.gauge.forms(),
            Block((0.190, 0.232), (-0.070, 0.070), (0.760, 0.848), "dark_steel"),
            *castors,
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.time.add_to(spec, self.name, body, (-0.245, -0.070, 0.560), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.2455, 0.040, 0.560), ON_FRONT)
        self.valve.add_to(spec, self.name, body, (-0.245, -0.070, 0.690), ON_FRONT)
        lid = self.lid.add_to(spec, body, (0.215, 0.0, 0.868))
        plate: list[Form] = [
            Turned(
                ((0, -0.006), (0.208, -0.006), (0.210, 0.014), (0.180, 0.030), (0, 0.040)),
                "steel",
                (-0.215, 0, 0),
                edge=0.004,
            ),
            Block((-0.060, 0.000), (-0.045, 0.045), (0.000, 0.030), "dark_steel"),
            Block((-0.400, -0.030), (-0.030, 0.030), (0.038, 0.058), "dark_steel", edge=0.006),
        ]
        assemble(spec, lid, self.name, plate, mass=9.0)
        self.bolt.add_to(spec)
        self.gauge.add_to(body, finish(spec, self.name, "red"))
        self.wheel.add_to(spec, self.name, lid, (-0.215, 0.0, 0.058), ON_TOP)
