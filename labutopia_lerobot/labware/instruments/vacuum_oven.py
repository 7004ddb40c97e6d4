"""A bench-top vacuum oven: a thick door that is shut by a lever with a tongue.

It is heated and evacuated, or stands there cold.
"""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dial_gauge import DialGauge
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.evacuation import AirLoad, EvacuatedChamber, Pump
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.guard import Flipped, Shut
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.lever import Lever
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_feet, add_look, add_part
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process

_DEPTH, _WIDTH, _HEIGHT = 0.560, 0.620, 0.700
"""Outer size [m]; ours. The original's third oven is 1.13 m deep, which no bench of 0.8 m takes."""
_DOOR_WIDTH, _DOOR_HEIGHT, _DOOR_THICKNESS = 0.460, 0.440, 0.050
"""Size of the door [m]; ours."""
_DOOR_BOTTOM = 0.110
"""Lower edge of the door [m]; ours: the turned lever is as high as the drying oven's handle."""
_LEVER_INSET, _LEVER_HEIGHT = 0.050, 0.250
"""Axis of the lever from the door's free edge and above its lower edge [m]; ours."""
_FOOT = 0.020
"""Height of the feet [m]."""
_WALL = 0.040
"""Chamber wall with its jacket [m]; ours."""

_INSIDE: tuple[Vector, Vector] = (
    (-_DEPTH / 2, _WIDTH / 2 - _DOOR_WIDTH, _DOOR_BOTTOM),
    (_DEPTH / 2 - _WALL, _WIDTH / 2 - _WALL, _DOOR_BOTTOM + _DOOR_HEIGHT),
)
"""Least and greatest corner of the chamber [m]."""
_OPENING = (_DOOR_WIDTH - _WALL) * _DOOR_HEIGHT
"""What the door closes [m^2]."""
_PANEL: Vector = (-_DEPTH / 2, 0.0, (_DOOR_BOTTOM + _DOOR_HEIGHT + _HEIGHT) / 2)
"""Middle of the panel above the door [m]."""

_DOOR_MASS = 7.5
"""A frame of aluminium (5 kg) around a pane of 10 mm glass (2.5 kg); ours."""
_WIDEST = math.radians(110.0)
"""Angle at which the hinge stops [rad]; ours."""
_SEAL = math.radians(0.3)
"""Angle at which the free edge stands 2 mm off, which the silicone seal still fills [rad]."""
_FRICTION = 0.5
"""Dry friction of hinge and seal [N m]; ours, as of the drying oven."""
_DAMPING = 1.0
"""Grease in the hinge [N m s/rad]; ours, as of the drying oven."""

_WATT, _LEAK = 1200.0, 1.5
"""Power [W] and loss through its walls [W/K]; ours, as of the drying oven."""
_SPEED, _END = 0.5e-3, 10.0
"""Pumping speed [m^3/s] and end vacuum [mbar] of its pump: those of `vacuum_pump`."""
_BORE = 0.008
"""Of its taps [m]; ours: hoses of vacuum ovens have 8 to 10 mm."""
_TIGHT = 1000.0 / 3600.0
"""How fast the pressure rises in it [Pa/s]: 10 mbar/h is what a maker allows (from memory)."""
_HIGHEST = 1200.0
"""Last mark of its gauge [mbar]; ours: every mark is 200 mbar, absolute."""

_ALONG_X = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)


@dataclass(frozen=True)
class VacuumOven(Equipment):
    """A vacuum oven whose door is hinged on the left and opens once its lever is turned down.

    Its front faces -x of its own frame. It weighs 60 kg and stays where it is. While its rocker is
    on it heats, and a pump evacuates it through its right tap; the left one lets air in.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        set_to: What its thermostat holds while its rocker is on [degrees C]; None for an oven that
            is cold and full of air, whose gauge and taps are painted on.
    """

    name: str
    set_to: float | None = 60.0
    size = (0.68, 0.620, 0.700)
    mass = 60.0
    source = "ours"
    left_out = "evacuated, it warms things as if there were air in it; nothing dries in it"

    @property
    def door(self) -> Door[Lever]:
        lever = Lever(f"{self.name}_handle")
        return Door(f"{self.name}_door", lever, widest=_WIDEST, closed_within=_SEAL)

    @property
    def vent(self) -> Tap:
        """Tap that lets air in, on the left."""
        return Tap(f"{self.name}_valve_in", look="blue")

    @property
    def outlet(self) -> Tap:
        """Tap to the pump, on the right."""
        return Tap(f"{self.name}_valve_out", look="chrome")

    @property
    def power(self) -> Rocker:
        """Switch of heater and pump."""
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        works = () if self.set_to is None else (self.vent, self.outlet, self.power)
        return (self.door.handle, self.door, *works)

    @property
    def heat(self) -> tuple[Process, ...]:
        """What keeps its inside warm while it is on."""
        if self.set_to is None:
            return ()
        by = Regulated(_WATT, self.set_to, self.power.name)
        gap = DoorGap(self.door.joint, _OPENING, _DOOR_HEIGHT)
        return chamber(self.name, *_INSIDE, _LEAK, gap, by)

    @property
    def air(self) -> EvacuatedChamber:
        """The air in it, and its pressure.

        Raises:
            ValueError: If it is a cold oven.
        """
        if self.set_to is None:
            raise ValueError(f"{self.name} is always full of air: give it a temperature, `set_to`")
        return EvacuatedChamber(
            f"{self.name}_pressure",
            (_DEPTH - _WALL) * _OPENING,
            f"{self.name}_air",
            Shut(self.door, within=_SEAL),
            Pump(self.power.name, _SPEED, _END),
            self.outlet,
            self.vent,
            math.pi / 4 * _BORE**2,
            _TIGHT,
        )

    @property
    def load(self) -> AirLoad:
        """What presses its door shut."""
        name, hinge = f"{self.name}_door_load", self.door.joint
        return AirLoad(name, self.air, hinge, _OPENING, (_DOOR_WIDTH + _WALL) / 2)

    @property
    def gauge(self) -> DialGauge:
        """Its vacuum gauge."""
        x, y, z = _PANEL
        return DialGauge(f"{self.name}_needle", self.air, _HIGHEST, 0.042, (x - 0.006, y, z))

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, what feels its door, its heat, the air in it, its door's load, its gauge."""
        if self.set_to is None:
            return ()
        return Flipped(self.power), self.air.door, *self.heat, self.air, self.load, self.gauge

    @property
    def displays(self) -> tuple[Display, ...]:
        return tuple(
            Display(f"{self.name}_reading", (0.056, 0.024), thermometer, ink=(255, 90, 60))
            for thermometer in self.heat[2:]
        )

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_DEPTH, _WIDTH) / 2

    @property
    def joints(self) -> tuple[str, ...]:
        """All but the lever's, which stays where it is left, and is where the handle is.

        The cold oven's is its door's only, as of other ovens: one task may have any of them.
        """
        return tuple(part.joint for part in self.mechanisms if part != self.door.handle)

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of the door's joint, of the lever and of its joint (see `Door`, `Lever`).

        Returns:
            The body; its origin is the centre of the base, z up.
        """
        add_materials(
            spec,
            self.name,
            ("shell", (0.80, 0.83, 0.86, 1.0), 0.3),
            ("leaf", (0.30, 0.36, 0.42, 1.0), 0.3),
            ("inside", (0.60, 0.62, 0.64, 1.0), 0.5),
            ("trim", (0.20, 0.22, 0.25, 1.0), 0.2),
            ("metal", (0.76, 0.77, 0.78, 1.0), 0.6),
            ("grip", (0.75, 0.12, 0.08, 1.0), 0.3),
            ("window", (0.16, 0.22, 0.24, 0.55), 0.8),
            ("dial", (0.95, 0.95, 0.92, 1.0), 0.1),
        )
        box = parent.add_body(name=self.name)
        self._add_box(box)
        self._add_controls(spec, box)
        hinge = (-_DEPTH / 2, _WIDTH / 2, _DOOR_BOTTOM)
        door = self.door.add_to(spec, box, hinge, ajar=0.0, friction=_FRICTION, damping=_DAMPING)
        self._add_door(door)
        if self.set_to is not None:
            self.load.add_to(spec)
        return box

    def _add_box(self, body: mujoco.MjsBody) -> None:
        """Add the hollow box behind the door, what is around that, and the lever's keeper."""
        x, y, bottom, top = _DEPTH / 2, _WIDTH / 2, _DOOR_BOTTOM, _DOOR_BOTTOM + _DOOR_HEIGHT
        middle, tall, edge = (bottom + top) / 2, (top - bottom) / 2, y - _DOOR_WIDTH
        column, chamber, half = (edge + y) / 2, (y + edge) / 2, _WALL / 2
        walls: dict[str, tuple[Vector, Vector]] = {
            "base": ((x, y, (bottom - _FOOT) / 2), (0, 0, (bottom + _FOOT) / 2)),
            "head": ((x, y, (_HEIGHT - top) / 2), (0, 0, (_HEIGHT + top) / 2)),
            "column": ((x, column, tall), (0, edge - column, middle)),
            "left": ((x, half, tall), (0, y - half, middle)),
            "back": ((half, _DOOR_WIDTH / 2, tall), (x - half, chamber, middle)),
        }
        for wall, (size, pos) in walls.items():
            add_part(body, f"{self.name}_{wall}", size, pos, f"{self.name}_shell")
        shelf = (x - _WALL, _DOOR_WIDTH / 2 - half, 0.003)
        add_part(body, f"{self.name}_shelf", shelf, (0, chamber, middle), f"{self.name}_inside")
        add_feet(body, self.name, (x, y), _FOOT, f"{self.name}_trim")
        behind = (-x, edge + _LEVER_INSET, bottom + _LEVER_HEIGHT)
        lever = self.door.handle
        lever.add_keeper(body, behind, _DOOR_THICKNESS, _LEVER_INSET, f"{self.name}_metal")

    def _add_controls(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the panel above the door: a vacuum gauge and two taps, or what looks like them."""
        front, middle, z = _PANEL
        panel = (0.002, 0.27, 0.055)
        add_look(body, f"{self.name}_panel", panel, _PANEL, f"{self.name}_trim")
        painted = [("gauge", "metal", 0.048, 0.0, 0.006)]
        if self.set_to is None:
            painted += [
                ("dial", "dial", 0.042, 0.0, 0.008),
                ("valve_in", "metal", 0.020, 0.16, 0.022),
                ("valve_out", "metal", 0.020, -0.16, 0.022),
            ]
        for part, material, radius, y, deep in painted:
            look, size = f"{self.name}_{material}", (radius, deep, 0.0)
            pos, name = (front, y, z), f"{self.name}_{part}"
            add_look(body, name, size, pos, look, shape=CYLINDER, quat=_ALONG_X)
        if self.set_to is None:
            needle, at = (0.010, 0.001, 0.018), (front, middle, z + 0.016)
            add_look(body, f"{self.name}_needle", needle, at, f"{self.name}_grip")
            return
        assemble(spec, body, self.name, self.gauge.forms())
        self.gauge.add_to(body, finish(spec, self.name, "red"))
        for tap, y in ((self.vent, 0.18), (self.outlet, -0.18)):
            tap.add_to(spec, self.name, body, (front - 0.002, y, z), ON_FRONT)
        self.displays[0].add_to(spec, body, (front - 0.0025, 0.10, z), ON_FRONT)
        self.power.add_to(spec, self.name, body, (front - 0.002, -0.10, z), ON_FRONT)

    def _add_door(self, body: mujoco.MjsBody) -> None:
        """Add the door: a frame around a pane, and the lever on its right."""
        x, wide, tall, edge = -_DOOR_THICKNESS / 2, _DOOR_WIDTH / 2, _DOOR_HEIGHT / 2, 0.10
        parts: dict[str, tuple[str, float, Vector, Vector]] = {
            "near": ("leaf", 1.25, (-x, edge / 2, tall), (x, edge / 2 - 2 * wide, tall)),
            "far": ("leaf", 1.25, (-x, edge / 2, tall), (x, -edge / 2, tall)),
            "lower": ("leaf", 1.25, (-x, wide - edge, edge / 2), (x, -wide, edge / 2)),
            "upper": ("leaf", 1.25, (-x, wide - edge, edge / 2), (x, -wide, 2 * tall - edge / 2)),
            "pane": ("window", 2.5, (-0.6 * x, wide - edge, tall - edge), (x, -wide, tall)),
        }
        for part, (material, mass, size, pos) in parts.items():
            look = f"{self.name}_{material}"
            add_part(body, f"{self.name}_door_{part}", size, pos, look, mass=mass)
        axis = (-_DOOR_THICKNESS, _LEVER_INSET - _DOOR_WIDTH, _LEVER_HEIGHT)
        self.door.handle.add_to(body, axis, f"{self.name}_grip")
