"""A bench-top muffle furnace: a small refractory chamber behind a hinged door with a bar handle."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_feet, add_look, add_part
from labutopia_lerobot.labware.parts.warmth import AIR, thermometer
from labutopia_lerobot.processes import DoorGap, HeatZone, Process, ThermalMass, Thermostat
from labutopia_lerobot.world import ON

_DEPTH, _WIDTH, _HEIGHT = 0.555, 0.644, 0.842
"""Outer size [m] (original, MuffleFurnace)."""
_DOOR_WIDTH, _DOOR_HEIGHT, _DOOR_THICKNESS = 0.638, 0.500, 0.045
"""Size of the door [m] (original, MuffleFurnace; its thickness is ours)."""
_DOOR_BOTTOM = 0.040
"""Lower edge of the door [m]; ours: the controls are above it, so that the middle of the handle is
nearly as high as the drying oven's, within the robot's reach."""
_HANDLE_LENGTH = 0.332
"""Length of the bar [m] (original, MuffleFurnace)."""
_HANDLE_INSET = 0.050
"""Distance from the door's free edge to the bar [m]."""
_FOOT = 0.025
"""Height of the feet [m]."""
_PLUG, _PLAY = 0.020, 0.004
"""Reach of the door's brick into the chamber, and the gap around it, in which its corner
clears the chamber's wall as the door swings [m]."""
_HEARTH = 0.008
"""Thickness of the ceramic plate on the chamber's floor [m]."""

_DOOR_MASS = 6.5
"""Two skins of 0.8 mm steel (4.0 kg), light brick and wool of 300 kg/m^3 in part of it (2.5 kg)."""
_WIDEST = math.radians(100.0)
"""Angle at which the hinge stops (original, MuffleFurnace)."""
_SEAL = math.radians(0.3)
"""Angle at which the free edge stands 3 mm off, which the fibre rope still fills [rad]."""
_FRICTION = 0.6
"""Dry friction of hinge and rope [N m]; ours: about 1 N at the handle, as for the drying oven."""
_DAMPING = 1.0
"""Grease in the hinge [N m s/rad]; ours, as for the drying oven."""

_WATT, _LINING, _LEAK = 4500.0, 19_000.0, 1.5
"""Power [W], heat that warms brick and coils by 1 K [J/K], and what the insulation lets through
[W/K]. Makers state 24 l, 4.5 kW and 95 minutes to 1100 degrees C, from memory; the share that is
lost, a third at 1000, is ours."""
_BAND, _SHEATH_S = 10.0, 10.0
"""Band of its controller [K], and time constant of its sheathed thermocouple [s]; ours."""
_IN_HOT_AIR = 25.0
"""From the lining to air and to things in it [W/m^2 K]; ours: 10 of convection, and what radiates
at some 200 degrees C."""

_WALLS, _SIDES, _COILS = ("left", "right", "floor", "roof", "back"), ("left", "right"), 4
"""Walls of the lining, and the sides of the chamber with so many coils each."""

_ALONG_X = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)


@dataclass(frozen=True)
class _Hollow:
    """A box-shaped room that is open to the front: half width, bottom, top and depth [m]."""

    half_width: float
    bottom: float
    top: float
    depth: float


_OUTSIDE = _Hollow(_WIDTH / 2, _FOOT, _HEIGHT, _DEPTH)
_CASING = _Hollow(0.220, 0.110, 0.470, 0.440)
"""Room inside the casing, which the refractory lining fills up to the chamber; ours."""
_CHAMBER = _Hollow(0.150, 0.170, 0.410, 0.360)
"""26 litres, within the 3 to 40 of bench-top furnaces; ours. Its middle is that of the door."""


@dataclass(frozen=True)
class MuffleFurnace(Equipment):
    """A muffle furnace whose door is hinged on the left of who stands before it.

    Its front faces -x of its own frame. It weighs 60 kg and stays where it is.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        ajar: How far the door stands open at the start [rad].
        set_to: What its controller holds while its rocker is on [degrees C]; None for a furnace
            that is cold, with its switch and its display painted on.
    """

    name: str
    ajar: float = 0.0
    set_to: float | None = 600.0
    size = (0.655, 0.644, 0.842)
    mass = 60.0
    source = "original (MuffleFurnace); mass ours"

    @property
    def door(self) -> Door[Handle]:
        handle = Handle(f"{self.name}_handle", _HANDLE_LENGTH)
        return Door(f"{self.name}_door", handle, widest=_WIDEST, closed_within=_SEAL)

    @property
    def hearth(self) -> Vector:
        """Place for things: the middle of the chamber's floor in its own frame [m]."""
        return ((_CHAMBER.depth - _DEPTH) / 2, 0.0, _CHAMBER.bottom + _HEARTH)

    @property
    def power(self) -> Rocker:
        """Its main switch."""
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.door,) if self.set_to is None else (self.door, self.power)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, the air of its chamber, its lining with the coils, and its controller."""
        if self.set_to is None:
            return ()
        front = -_DEPTH / 2
        wide, tall, deep = 2 * _CHAMBER.half_width, _CHAMBER.top - _CHAMBER.bottom, _CHAMBER.depth
        inside = 2 * (wide * tall + tall * deep + deep * wide)
        low = (front, -_CHAMBER.half_width, _CHAMBER.bottom)
        high = (front + deep, _CHAMBER.half_width, _CHAMBER.top)
        lining = ThermalMass(
            f"{self.name}_lining",
            self.name,
            _LINING,
            leak=_LEAK,
            gap=DoorGap(self.door.joint, wide * tall, tall, share=0.0, emissivity=0.9),
            surfaces=tuple(f"{self.name}_lining_{wall}" for wall in _WALLS),
            glows=tuple(f"{self.name}_coil_{side}_{n}" for side in _SIDES for n in range(_COILS)),
        )
        air = ThermalMass(
            f"{self.name}_air",
            self.name,
            wide * tall * deep * AIR,
            links=((lining.name, _IN_HOT_AIR * inside),),
            zone=HeatZone(low, high, _IN_HOT_AIR),
            gap=DoorGap(self.door.joint, wide * tall, tall),
        )
        switch = Scale(self.power, 0, 1, ON)
        controller = Thermostat(
            thermometer(self.name),
            lining.name,
            _WATT,
            self.set_to,
            switch.name,
            band=10.0,
            lag=10.0,
        )
        return switch, air, lining, controller

    @property
    def displays(self) -> tuple[Display, ...]:
        if self.set_to is None:
            return ()
        return (Display(f"{self.name}_reading", (0.130, 0.050), self.works[-1], ink=(255, 90, 60)),)

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_DEPTH, _WIDTH) / 2

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of the door's joint and handle (see `Door`, `Handle`).

        Returns:
            The body; its origin is the centre of the base, z up.
        """
        self._add_materials(spec)
        box = parent.add_body(name=self.name)
        self._add_walls(box, "casing", "shell", _OUTSIDE, _CASING)
        self._add_walls(box, "lining", "brick", _CASING, _CHAMBER)
        self._add_inside(box)
        self._add_controls(spec, box)
        add_feet(box, self.name, (_DEPTH / 2, _WIDTH / 2), _FOOT, f"{self.name}_trim")
        hinge = (-_DEPTH / 2, _DOOR_WIDTH / 2, _DOOR_BOTTOM)
        door = self.door.add_to(
            spec, box, hinge, ajar=self.ajar, friction=_FRICTION, damping=_DAMPING
        )
        self._add_door(door)
        return box

    def _add_materials(self, spec: mujoco.MjSpec) -> None:
        add_materials(
            spec,
            self.name,
            ("shell", (0.91, 0.92, 0.91, 1.0), 0.2),
            ("leaf", (0.46, 0.54, 0.60, 1.0), 0.3),
            ("brick", (0.97, 0.94, 0.87, 1.0), 0.0),
            ("hearth", (0.72, 0.64, 0.54, 1.0), 0.0),
            ("coil", (0.42, 0.27, 0.20, 1.0), 0.1),
            ("trim", (0.17, 0.19, 0.22, 1.0), 0.2),
            ("metal", (0.78, 0.79, 0.80, 1.0), 0.6),
            ("display", (0.04, 0.05, 0.06, 1.0), 0.3),
            ("digits", (0.95, 0.25, 0.15, 1.0), 0.0),
            ("target", (0.30, 0.85, 0.40, 1.0), 0.0),
        )

    def _add_walls(
        self, body: mujoco.MjsBody, layer: str, material: str, outer: _Hollow, inner: _Hollow
    ) -> None:
        """Fill the room between two hollows with five solid walls."""
        front = -_DEPTH / 2
        deep, middle = outer.depth / 2, (outer.bottom + outer.top) / 2
        tall, thick = (outer.top - outer.bottom) / 2, (outer.half_width - inner.half_width) / 2
        aside, wide = (outer.half_width + inner.half_width) / 2, inner.half_width
        below, above = (inner.bottom - outer.bottom) / 2, (outer.top - inner.top) / 2
        walls: dict[str, tuple[Vector, Vector]] = {
            "left": ((deep, thick, tall), (front + deep, aside, middle)),
            "right": ((deep, thick, tall), (front + deep, -aside, middle)),
            "floor": ((deep, wide, below), (front + deep, 0.0, outer.bottom + below)),
            "roof": ((deep, wide, above), (front + deep, 0.0, outer.top - above)),
            "back": (
                ((outer.depth - inner.depth) / 2, wide, (inner.top - inner.bottom) / 2),
                (front + (outer.depth + inner.depth) / 2, 0.0, (inner.top + inner.bottom) / 2),
            ),
        }
        for wall, (size, pos) in walls.items():
            add_part(body, f"{self.name}_{layer}_{wall}", size, pos, f"{self.name}_{material}")

    def _add_inside(self, body: mujoco.MjsBody) -> None:
        """Add the hearth, and the heating wires half sunk into both walls of the chamber."""
        x, y, z = self.hearth
        reach = _CHAMBER.depth / 2 - 0.03  # clear of the door's plug
        size = (reach, _CHAMBER.half_width - 0.01, _HEARTH / 2)
        add_part(body, f"{self.name}_hearth", size, (x, y, z - _HEARTH / 2), f"{self.name}_hearth")
        for level in range(_COILS):
            for side, sign in zip(_SIDES, (1, -1), strict=True):
                add_look(
                    body,
                    f"{self.name}_coil_{side}_{level}",
                    (0.006, reach, 0.0),
                    (x, sign * _CHAMBER.half_width, _CHAMBER.bottom + 0.04 + 0.053 * level),
                    f"{self.name}_coil",
                    shape=CYLINDER,
                    quat=_ALONG_X,
                )

    def _add_controls(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the panel above the door: actual and set temperature, keys and a main switch."""
        front, middle = -_DEPTH / 2, (_DOOR_BOTTOM + _DOOR_HEIGHT + _HEIGHT) / 2
        parts: list[tuple[str, str, Vector, float, float]] = [
            ("panel", "trim", (0.002, 0.270, 0.105), 0.0, 0.0),
            ("display", "display", (0.003, 0.085, 0.065), 0.13, 0.015),
        ]
        if self.set_to is None:
            parts.append(("power", "display", (0.005, 0.020, 0.030), -0.20, 0.0))
        parts += [
            (f"key_{key}", "metal", (0.004, 0.014, 0.010), 0.193 - 0.042 * key, -0.075)
            for key in range(4)
        ]
        for digit in range(4 if self.set_to is None else 0):
            actual, target = 0.172 - 0.028 * digit, 0.157 - 0.018 * digit
            parts += [
                (f"actual_{digit}", "digits", (0.004, 0.010, 0.018), actual, 0.045),
                (f"target_{digit}", "target", (0.004, 0.006, 0.011), target, -0.012),
            ]
        for part, material, size, y, z in parts:
            pos = (front, y, middle + z)
            add_look(body, f"{self.name}_{part}", size, pos, f"{self.name}_{material}")
        for display in self.displays:
            display.add_to(spec, body, (front - 0.0035, 0.13, middle + 0.020), ON_FRONT)
        if self.set_to is not None:
            self.power.add_to(spec, self.name, body, (front - 0.002, -0.20, middle), ON_FRONT)

    def _add_door(self, body: mujoco.MjsBody) -> None:
        """Add the door in front of the box, the brick that plugs the chamber, and the bar."""
        x, wide, tall = _DOOR_THICKNESS / 2, _DOOR_WIDTH / 2, _DOOR_HEIGHT / 2
        plug = (
            _PLUG / 2,
            _CHAMBER.half_width - _PLAY,
            (_CHAMBER.top - _CHAMBER.bottom) / 2 - _PLAY,
        )
        parts: dict[str, tuple[str, float, Vector, Vector]] = {
            "leaf": ("leaf", 0.9, (x, wide, tall), (-x, -wide, tall)),
            "plug": ("brick", 0.1, plug, (_PLUG / 2, -wide, tall)),
        }
        for part, (material, share, size, pos) in parts.items():
            look, mass = f"{self.name}_{material}", share * _DOOR_MASS
            add_part(body, f"{self.name}_door_{part}", size, pos, look, mass=mass)
        spot = (-_DOOR_THICKNESS, -_DOOR_WIDTH + _HANDLE_INSET, tall)
        self.door.handle.add_to(body, spot, f"{self.name}_metal", lying=False)
