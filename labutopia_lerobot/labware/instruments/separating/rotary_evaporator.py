"""A rotary evaporator: a flask that turns in a heated bath, a lift and a condenser."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned, about
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT, leaning
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.labware.parts.warmth import Regulated, bath
from labutopia_lerobot.processes import Process

_LEAN = math.radians(30.0)
"""Angle by which the flask's axis points down [rad]."""
_AXIS = (-math.cos(_LEAN), 0.0, -math.sin(_LEAN))


@dataclass(frozen=True)
class RotaryEvaporator(Instrument):
    """A rotary evaporator whose head, with flask and condenser, goes up and down on a column.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.576, 0.375, 0.742)
    mass = 18.0
    source = (
        "640 x 470 x 840 mm with its head up, flask of 1 l, lift of 160 mm, as usual; from memory"
    )
    left_out = "nothing is distilled"

    @property
    def lift(self) -> Slide:
        return Slide(f"{self.name}_lift", 0.160, friction=10.0, effort=40.0)

    @property
    def flask(self) -> Rotor:
        """The evaporating flask on its vapour tube."""
        return Rotor(f"{self.name}_flask", friction=0.03, effort=0.3, stall=1.5)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.036)

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.036, pointer="red")

    @property
    def stopcock(self) -> Tap:
        """Stopcock that lets air in, on top of the condenser."""
        return Tap(f"{self.name}_stopcock", length=0.030, look="blue", standoff=0.012)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lift, self.flask, self.speed, self.heat, self.stopcock

    @property
    def warming(self) -> tuple[Process, ...]:
        """What its knob sets, the bath and its thermostat: 1.3 kW, usual; leak ours."""
        knob = Scale(self.heat, 20, 100, "\u00b0C")
        by = Regulated(1300.0, knob.name)
        low, high = (-0.178, -0.013, 0.080), (0.028, 0.193, 0.150)
        return knob, *bath(self.name, low, high, 0.8, by)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 280, "rpm", resolution=5)

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=56.0,
            brake=140.0,
            on=(),
            motors=(self.flask.motor,),
            resolution=5,
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Heat; then the knob of the speed and its drive."""
        return *self.warming, self.scale, self.drive

    @property
    def displays(self) -> tuple[Display, ...]:
        thermometer = self.warming[-1]
        bath = Display(f"{self.name}_temperature", (0.060, 0.022), thermometer, ink=(255, 130, 90))
        return bath, Display(f"{self.name}_speed_display", (0.060, 0.022), self.drive)

    def _forms(self) -> list[Form]:
        bath = (-0.075, 0.090)
        return [
            Block((-0.260, 0.260), (-0.160, 0.200), (0.012, 0.060), "white", edge=0.010),
            Block((0.150, 0.250), (-0.100, 0.010), (0.050, 0.480), "light_grey", edge=0.010),
            Ring(0.236, 0.250, (0.060, 0.190), "white", at=bath),
            Ring(0.228, 0.238, (0.064, 0.194), "steel", at=bath, touch=False),
            Rod((*bath, 0.060), (*bath, 0.080), 0.240, "steel"),
            Rod((*bath, 0.150), (*bath, 0.151), 0.232, "water", touch=False),
            Prism(
                ((-0.258, 0.058), (-0.190, 0.058), (-0.190, 0.120), (-0.238, 0.120)),
                (-0.150, -0.030),
                "anthracite",
                edge=0.004,
            ),
            *feet(0.500, 0.300, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(18.4)
        self.heat.add_to(spec, self.name, body, (-0.2485, -0.120, 0.088), lean)
        self.displays[0].add_to(spec, body, (-0.2485, -0.066, 0.089), lean)
        head = self.lift.add_to(spec, body, (0.140, -0.045, 0.260), (0.0, 0.0, 1.0), balanced=True)
        axis = (0.0, 0.135, 0.050)  # of the flask, in the frame of the head
        forms: list[Form] = [
            Block((-0.040, 0.008), (-0.050, 0.050), (0.000, 0.110), "anthracite", edge=0.006),
            Block(
                (-0.050, 0.050),
                (0.050, 0.200),
                (0.000, 0.100),
                "white",
                0.012,
                about((0, 1, 0), 30),
            ),
            Block((-0.062, -0.040), (-0.050, 0.010), (0.020, 0.090), "white", edge=0.006),
            *self._condenser(axis),
        ]
        assemble(spec, head, self.name, forms, mass=6.0)
        self.speed.add_to(spec, self.name, head, (-0.062, -0.020, 0.044), ON_FRONT)
        self.displays[1].add_to(spec, head, (-0.0625, -0.020, 0.076), ON_FRONT)
        x, y, z = axis
        top = (x + 0.105, y, z + 0.412)
        half = math.sqrt(0.5)
        self.stopcock.add_to(spec, self.name, head, top, (0.0, half, half, 0.0))
        out = 0.075
        start = (x + out * _AXIS[0], y, z + out * _AXIS[2])
        flask = self.flask.add_to(spec, head, start, _AXIS)
        bulb = [(0.012, 0.060), (0.016, 0.095), (0.034, 0.112)]
        bulb += [
            (0.062 * math.sin(a), 0.165 - 0.062 * math.cos(a))
            for a in (0.9, 1.3, 1.7, 2.1, 2.5, 2.9)
        ]
        glass: list[Form] = [
            Turned((*bulb, (0, 0.227)), "glass", axis=_AXIS, edge=0.0, touch=False),
            Turned(
                ((0.0, 0.0), (0.011, 0.0), (0.011, 0.060), (0.0, 0.060)), "glass_edge", axis=_AXIS
            ),
            Turned(((0, 0.062), (0.018, 0.062), (0.018, 0.080), (0, 0.080)), "red", axis=_AXIS),
            Turned(
                (
                    (0, 0.112),
                    (0.040, 0.112),
                    (0.060, 0.140),
                    (0.060, 0.190),
                    (0.040, 0.220),
                    (0, 0.220),
                ),
                "glass",
                axis=_AXIS,
            ),
        ]
        assemble(spec, flask, self.name, glass, mass=0.35)

    def _condenser(self, axis: tuple[float, float, float]) -> list[Form]:
        """Return the upright condenser with its coil, and the receiving flask below it."""
        x, y, z = axis
        x += 0.105
        coil: list[Form] = [
            Turned(
                ((0.017, 0), (0.023, 0.003), (0.017, 0.006)),
                "glass_edge",
                (x, y, z + 0.150 + 0.019 * n),
                edge=0.0,
                touch=False,
                segments=20,
            )
            for n in range(11)
        ]
        ball = [
            (0.050 * math.sin(a), 0.050 * (1 - math.cos(a)))
            for a in (0.0, 0.5, 0.9, 1.3, 1.7, 2.1, 2.5, 2.8)
        ]
        return [
            Rod((x - 0.06, y, z + 0.040), (x, y, z + 0.100), 0.026, "glass_edge"),
            Rod((x, y, z + 0.020), (x, y, z + 0.130), 0.030, "glass"),
            Turned(
                (
                    (0.014, 0.115),
                    (0.036, 0.140),
                    (0.036, 0.375),
                    (0.014, 0.400),
                    (0.014, 0.412),
                    (0, 0.412),
                ),
                "glass",
                (x, y, z),
                edge=0.004,
            ),
            *coil,
            Rod((x + 0.036, y, z + 0.355), (x + 0.060, y, z + 0.355), 0.010, "glass_edge"),
            Rod((x + 0.036, y, z + 0.160), (x + 0.060, y, z + 0.160), 0.010, "glass_edge"),
            Rod((x, y, z - 0.030), (x, y, z + 0.030), 0.024, "glass_edge"),
            Turned(ball, "glass", (x, y, z - 0.125), edge=0.0),
        ]
