"""A thermal cycler with a heated lid over 96 wells."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_TOP, leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.temperature_program import TemperatureProgram
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.labware.parts.warmth import thermometer
from labutopia_lerobot.processes import HeatZone, Process, ThermalMass, Thermostat
from labutopia_lerobot.processes.hot_surface import IN_BORE

_SLOPE = 66.0
_FIRST, _CYCLE = (95.0, 120.0), ((95.0, 30.0), (55.0, 30.0), (72.0, 60.0))
"""Temperatures [degrees C] and times [s] of a usual PCR with three steps; ours."""
_CAPACITY, _WATT, _LEAK = 230.0, 700.0, 0.5
"""Of the block [J/K]: 95 ml of aluminium, 2.4 J/cm3 K (Incropera, table A.1). What its Peltier
elements bring in or take out [W], which is the 3 K/s that makers state; loss of the block [W/K];
both ours."""


@dataclass(frozen=True)
class ThermalCycler(Instrument):
    """A thermal cycler: the knob on its lid presses it onto the tubes.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.450, 0.250, 0.239)
    mass = 9.5
    source = "250 x 450 x 220 mm, 96 wells at 9 mm (ANSI SLAS 4), as usual; from memory"
    left_out = "its lid is not heated"

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(70.0), reach=0.230, friction=0.3)

    @property
    def pressure(self) -> Knob:
        """Knob that presses the heated plate down."""
        return Knob(f"{self.name}_pressure", diameter=0.060, depth=0.026, look="anthracite")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.pressure, self.lid

    @property
    def keys(self) -> tuple[PushButton, ...]:
        """Start and stop."""
        return tuple(
            PushButton(f"{self.name}_{key}", FINISHES[look].rgba, 0.011, 0.003, proud=0.006)
            for key, look in (("start", "green"), ("stop", "red"))
        )

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.keys

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middle of the block, for a plate."""
        return (Seat(f"{self.name}_block", self.name, (0.030, 0.0, 0.150), width=0.066),)

    @property
    def program(self) -> Countdown:
        """Time left of its program, an hour and a half; it runs with its lid shut."""
        start, stop = (key.name for key in self.keys)
        return Countdown(f"{self.name}_time", 90.0, start, stop, (Shut(self.lid),))

    @property
    def cycling(self) -> tuple[Process, ...]:
        """The block, what it is to hold, and the Peltier elements below it, heating and cooling.

        Its lid has the temperature of the room. Nothing is amplified.
        """
        zone = HeatZone((-0.012, -0.060, 0.148), (0.072, 0.060, 0.160), IN_BORE)
        block = ThermalMass(f"{self.name}_surface", self.name, _CAPACITY, leak=_LEAK, zone=zone)
        wanted = TemperatureProgram(
            f"{self.name}_wanted", self.program.name, 60.0 * 90.0, _FIRST, _CYCLE
        )
        on, heater = self.program.name, thermometer(self.name)
        fast = 0.5  # s: its thermometer lies in the block
        return (
            wanted,
            block,
            Thermostat(heater, block.name, _WATT, wanted.name, on, lag=fast, resolution=0.1),
            Thermostat(f"{self.name}_cooling", block.name, -_WATT, wanted.name, on, lag=fast),
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """What feels its lid, its program, and what heats and cools."""
        return Shut(self.lid), self.program, *self.cycling

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.110, 0.036), self.program),
            Display(f"{self.name}_temperature", (0.066, 0.022), self.cycling[2], ink=(255, 90, 60)),
        )

    def _forms(self) -> list[Form]:
        side = ((-0.225, 0.012), (0.225, 0.012), (0.225, 0.130), (-0.080, 0.130), (-0.225, 0.066))
        wells: list[Form] = [
            Rod(
                (0.030 + 0.009 * (i - 3.5), 0.009 * (j - 5.5), 0.1500),
                (0.030 + 0.009 * (i - 3.5), 0.009 * (j - 5.5), 0.1503),
                0.0064,
                "black",
                touch=False,
                segments=8,
            )
            for i in range(8)
            for j in range(12)
        ]
        return [
            Prism(side, (-0.125, 0.125), "white", edge=0.008),
            Block((-0.220, 0.220), (-0.123, 0.123), (0.010, 0.024), "blue"),
            Block((-0.012, 0.072), (-0.060, 0.060), (0.128, 0.150), "steel"),
            Block((0.140, 0.200), (-0.110, 0.110), (0.126, 0.168), "white", edge=0.008),
            *wells,
            *feet(0.440, 0.250, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(_SLOPE)
        self.displays[0].add_to(spec, body, (-0.150, 0.040, 0.1000), lean)
        self.displays[1].add_to(spec, body, (-0.196, 0.040, 0.0797), lean)
        for key, y in zip(self.keys, (-0.050, -0.085), strict=True):
            key.add_to(spec, body, (-0.150, y, 0.0992), lean)
        lid = self.lid.add_to(spec, body, (0.150, 0.0, 0.170))
        cover: list[Form] = [
            Prism(
                (
                    (-0.230, -0.010),
                    (0.0, 0.0),
                    (0.0, 0.030),
                    (-0.040, 0.044),
                    (-0.200, 0.040),
                    (-0.230, 0.010),
                ),
                (-0.115, 0.115),
                "white",
                edge=0.008,
            ),
            Block((-0.240, -0.222), (-0.035, 0.035), (-0.006, 0.008), "anthracite"),
            Block((-0.170, -0.070), (-0.064, 0.064), (-0.014, 0.002), "dark_steel"),
        ]
        assemble(spec, lid, self.name, cover, mass=1.8)
        self.pressure.add_to(spec, self.name, lid, (-0.125, 0.0, 0.0420), ON_TOP)
