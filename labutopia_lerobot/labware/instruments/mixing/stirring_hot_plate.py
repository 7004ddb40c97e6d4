"""A magnetic stirrer with a ceramic hot plate, a knob for each and two displays."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.magnetic_stirring import MagneticStirring
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.warmth import Regulated, block
from labutopia_lerobot.processes import HeatZone, Process
from labutopia_lerobot.processes.hot_surface import ON_CERAMIC

_TOP = 0.095
"""Height of the plate [m]."""
_SLOPE = 58.1
"""Angle by which the console leans back [deg]."""

_WATT = 600.0
"""Power of its heater [W], usual for plates of 135 mm; from memory."""
_CAPACITY = 0.135**2 * 0.011 * 2570.0 * 800.0
"""Of its ceramic plate [J/K], as the heater's."""


@dataclass(frozen=True)
class StirringHotPlate(Instrument):
    """A magnetic stirrer with hot plate: its displays show how hot it is, and how fast it turns.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.280, 0.160, 0.095)
    mass = 2.9
    source = "160 x 280 x 95 mm, plate of 135 mm, usual for 10 l and 320 C; from memory"

    @property
    def heat(self) -> Knob:
        """Knob that sets the temperature of the plate."""
        return Knob(f"{self.name}_heat", look="anthracite", pointer="red")

    @property
    def speed(self) -> Knob:
        """Knob that sets the speed of the magnet."""
        return Knob(f"{self.name}_speed", look="anthracite")

    @property
    def mechanisms(self) -> tuple[Knob, ...]:
        return self.heat, self.speed

    @property
    def plate(self) -> Seat:
        """The middle of the plate."""
        return Seat(f"{self.name}_plate", self.name, (0.060, 0.0, _TOP), width=0.130)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.plate,)

    @property
    def warming(self) -> tuple[Process, ...]:
        """What its knob sets, the plate and its thermostat."""
        knob = Scale(self.heat, 20, 320, "\u00b0C")
        low, high = (0.010, -0.050, _TOP - 0.002), (0.110, 0.050, _TOP + 0.003)
        zone = HeatZone(low, high, ON_CERAMIC, base=True)
        by = Regulated(_WATT, knob.name)
        return knob, *block(self.name, _CAPACITY, 0.135**2, zone, (), by)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 1500, "rpm", resolution=10)

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=250.0,
            brake=500.0,
            on=(),
            motors=(),
            resolution=10,
        )

    @property
    def stirring(self) -> MagneticStirring:
        """The magnet below its plate."""
        return MagneticStirring(f"{self.name}_stirring", self.drive, self.plate.name)

    @property
    def works(self) -> tuple[Process, ...]:
        """Heat; then the knob of the speed, its drive and the magnet that it turns."""
        return *self.warming, self.scale, self.drive, self.stirring

    @property
    def displays(self) -> tuple[Display, ...]:
        size = (0.046, 0.016)
        return (
            Display(f"{self.name}_temperature", size, self.warming[-1], ink=(255, 130, 90)),
            Display(f"{self.name}_speed_display", size, self.drive),
        )

    def _forms(self) -> list[Form]:
        side = ((-0.140, 0.008), (0.140, 0.008), (0.140, 0.074), (-0.050, 0.074), (-0.140, 0.018))
        return [
            Prism(side, (-0.080, 0.080), "white", edge=0.003),
            Block((-0.004, 0.124), (-0.064, 0.064), (0.074, 0.084), "anthracite"),
            Block((-0.0075, 0.1275), (-0.0675, 0.0675), (0.084, _TOP), "ceramic"),
            *feet(0.280, 0.160, 0.010),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for knob, display, y in zip(self.mechanisms, self.displays, (0.040, -0.040), strict=True):
            knob.add_to(spec, self.name, body, (-0.111, y, 0.0361), leaning(_SLOPE))
            display.add_to(spec, body, (-0.0745, y, 0.0595), leaning(_SLOPE))
