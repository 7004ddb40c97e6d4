"""A bench centrifuge with a latched lid and a rotor of twelve bores."""

import math
from dataclasses import dataclass, replace

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.guard import Balanced, Lock, Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.motor import Bolt
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.processes import Process

_BORES, _CIRCLE = 12, 0.070
"""Number of them, and the radius of their circle [m]."""
_BORE, _DEEP = 0.0175, 0.060
"""Diameter of a bore, for tubes of 17 mm, and its depth [m]."""

_HIGHEST = 4000.0
"""Its highest speed [rpm]."""
_LONGEST = 30.0
"""The longest time that it can be set to [min]."""
_UNEVEN = 0.005
"""The most that it bears on one side only, in the circle of its bores [kg]; ours: makers of bench
centrifuges allow 2 to 10 g between opposite tubes."""


@dataclass(frozen=True)
class Centrifuge(Instrument):
    """A centrifuge whose upright bores take twelve 15 ml tubes.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        set_to: What its speed is set to when an episode begins [rpm].
        minutes: What its time is set to then [min].
        lid_open: How far its lid is open then [rad].
    """

    name: str
    set_to: float = 0.0
    minutes: float = 0.0
    lid_open: float = 0.0
    size = (0.520, 0.400, 0.300)
    mass = 32.0
    source = "400 x 520 x 300 mm, rotor of 200 mm, usual for 4 x 100 ml; from memory"

    @property
    def lid(self) -> Lid:
        return Lid(
            f"{self.name}_lid",
            widest=math.radians(75.0),
            reach=0.350,
            friction=0.5,
            begins=self.lid_open,
        )

    @property
    def lid_thickness(self) -> float:
        """Height of the lid's upper side above its frame [m]."""
        return 0.028

    @property
    def rotor(self) -> Rotor:
        return Rotor(f"{self.name}_rotor", friction=0.02, effort=0.3, stall=1.5)

    @property
    def speed(self) -> Knob:
        return self._knob("speed", self.set_to / _HIGHEST)

    @property
    def time(self) -> Knob:
        return self._knob("time", self.minutes / _LONGEST)

    def _knob(self, knob: str, share: float) -> Knob:
        dial = Knob(f"{self.name}_{knob}", diameter=0.036)
        return replace(dial, begins=share * dial.widest)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.rotor, self.speed, self.time

    @property
    def latch(self) -> PushButton:
        """What releases the lid."""
        return self._key("latch", "yellow")

    @property
    def start(self) -> PushButton:
        return self._key("start", "green")

    @property
    def stop(self) -> PushButton:
        return self._key("stop", "red")

    def _key(self, key: str, look: str) -> PushButton:
        color = FINISHES[look].rgba
        return PushButton(f"{self.name}_{key}", color, radius=0.011, travel=0.004, proud=0.014)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.latch, self.start, self.stop

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bores, counterclockwise from the back."""
        return tuple(
            Seat(f"{self.name}_bore_{n}", self.rotor.name, (x, y, 0.010), 0.016, _DEEP)
            for n, (x, y) in enumerate(_circle())
        )

    @property
    def closed(self) -> Shut:
        """What feels its lid."""
        return Shut(self.lid)

    @property
    def timer(self) -> Countdown:
        """Time left of its run; it does not start with its lid open."""
        setting, buttons = Scale(self.time, 0, _LONGEST, "min"), (self.start.name, self.stop.name)
        return Countdown(f"{self.name}_left", setting, *buttons, (self.closed, self.balanced))

    @property
    def drive(self) -> Drive:
        """What turns the rotor while the timer runs; it is seen to turn slowly."""
        return Drive(
            f"{self.name}_rpm",
            Scale(self.speed, 0, _HIGHEST, "rpm", resolution=50),
            ramp=200.0,
            brake=200.0,
            on=(f"{self.name}_left",),
            motors=(self.rotor.motor,),
            resolution=50.0,
            seen=60.0,
        )

    @property
    def balanced(self) -> Balanced:
        """What trips where its load is uneven."""
        name, rotor = f"{self.name}_balanced", self.rotor.name
        return Balanced(name, rotor, self.drive, _HIGHEST, _CIRCLE, 0.20, self.closed, _UNEVEN)

    @property
    def lock(self) -> Lock:
        """What keeps its lid shut until its latch is pressed at a standstill."""
        return Lock(f"{self.name}_locked", self._bolt, self.closed, self.latch.name, self.drive)

    @property
    def _bolt(self) -> Bolt:
        return Bolt(self.lid.name, self.lid.joint)

    @property
    def works(self) -> tuple[Process, ...]:
        """What feels its lid and its balance, its knobs, its timer, its drive and its lock."""
        return (
            self.closed,
            self.balanced,
            Scale(self.speed, 0, _HIGHEST, "rpm", resolution=50),
            Scale(self.time, 0, _LONGEST, "min"),
            self.timer,
            self.drive,
            self.lock,
        )

    @property
    def displays(self) -> tuple[Display, ...]:
        size = (0.078, 0.026)
        return (
            Display(f"{self.name}_speed_display", size, self.drive),
            Display(f"{self.name}_time_display", size, self.timer),
        )

    def _forms(self) -> list[Form]:
        console = (
            (-0.260, 0.014),
            (-0.120, 0.014),
            (-0.120, 0.268),
            (-0.160, 0.268),
            (-0.260, 0.090),
        )
        return [
            Prism(console, (-0.200, 0.200), "white", edge=0.008),
            Block((-0.130, 0.240), (-0.200, 0.200), (0.014, 0.100), "white", edge=0.006),
            Block((-0.130, 0.260), (0.160, 0.200), (0.090, 0.268), "white", edge=0.006),
            Block((-0.130, 0.260), (-0.200, -0.160), (0.090, 0.268), "white", edge=0.006),
            Block((0.200, 0.260), (-0.190, 0.190), (0.014, 0.268), "white", edge=0.006),
            Ring(0.280, 0.320, (0.098, 0.262), "steel", at=(0.040, 0.0)),
            Ring(0.280, 0.400, (0.255, 0.263), "anthracite", at=(0.040, 0.0), touch=False),
            Rod((0.040, 0, 0.098), (0.040, 0, 0.103), 0.270, "dark_steel"),
            Rod((0.040, 0, 0.100), (0.040, 0, 0.120), 0.040, "steel"),
            *feet(0.520, 0.400, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(29.3)
        for knob, display, y in zip(
            (self.speed, self.time), self.displays, (0.10, -0.04), strict=True
        ):
            knob.add_to(spec, self.name, body, (-0.2348, y, 0.135), lean)
            display.add_to(spec, body, (-0.2054, y, 0.1884), lean)
        self.latch.add_to(spec, body, (-0.2348, -0.140, 0.135), lean)
        self.start.add_to(spec, body, (-0.2348, 0.045, 0.135), lean)
        self.stop.add_to(spec, body, (-0.2348, 0.012, 0.135), lean)
        self._add_rotor(spec, self.rotor.add_to(spec, body, (0.040, 0.0, 0.121)))
        lid = self.lid.add_to(spec, body, (0.215, 0.0, 0.270))
        self._bolt.add_to(spec)
        forms: list[Form] = [
            Block(
                (-0.350, 0.0), (-0.190, 0.190), (0.000, self.lid_thickness), "petrol", edge=0.010
            ),
            Rod((-0.175, 0, 0.0282), (-0.175, 0, 0.0295), 0.080, "smoked", touch=False),
            Block((-0.356, -0.340), (-0.040, 0.040), (0.004, 0.018), "anthracite"),
        ]
        assemble(spec, lid, self.name, forms, mass=3.0)

    def _add_rotor(self, spec: mujoco.MjSpec, rotor: mujoco.MjsBody) -> None:
        top = 0.010 + _DEEP
        hub = ((0, 0), (0.054, 0), (0.054, top), (0.020, top + 0.006), (0, top + 0.006))
        skin = ((0.085, 0.002), (0.092, 0.010), (0.088, top), (0.054, top))
        forms: list[Form] = [
            Turned(hub, "steel"),
            Turned(((0, 0), (0.090, 0), (0.090, 0.010), (0, 0.010)), "steel"),
            Turned(skin, "steel", touch=False),
            Rod((0, 0, top + 0.006), (0, 0, top + 0.016), 0.024, "anthracite"),
        ]
        for x, y in _circle():
            forms.append(
                Ring(
                    _BORE, 0.021, (0.010, top + 0.002), "anthracite", (x, y), segments=12, facets=6
                )
            )
            forms.append(
                Rod((x, y, top), (x, y, top + 0.0005), _BORE, "black", touch=False, segments=12)
            )
        assemble(spec, rotor, self.name, forms, mass=2.5)
        for place in self.places:
            place.add_to(rotor)


def _circle() -> list[tuple[float, float]]:
    """Return where the bores are, x and y in the rotor's frame [m]."""
    angles = [2 * math.pi * n / _BORES for n in range(_BORES)]
    return [(_CIRCLE * math.cos(a), _CIRCLE * math.sin(a)) for a in angles]
