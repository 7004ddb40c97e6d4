"""A bench-top vacuum oven: a thick door that is shut by a lever with a tongue."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.lever import Lever
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_feet, add_look, add_part

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

_ALONG_X = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)


@dataclass(frozen=True)
class VacuumOven(Equipment):
    """A vacuum oven whose door is hinged on the left and opens once its lever is turned down.

    Its front faces -x of its own frame. It weighs 60 kg, stays where it is and is not evacuated.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.68, 0.620, 0.700)
    mass = 60.0
    source = "ours"
    left_out = "it neither heats nor is evacuated"

    @property
    def door(self) -> Door[Lever]:
        lever = Lever(f"{self.name}_handle")
        return Door(f"{self.name}_door", lever, widest=_WIDEST, closed_within=_SEAL)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.door.handle, self.door)

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_DEPTH, _WIDTH) / 2

    @property
    def joints(self) -> tuple[str, ...]:
        """Its door's hinge only, as of other ovens: one task may have any of them.

        The lever stays where it is left, and is where the handle is.
        """
        return (self.door.joint,)

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
        self._add_controls(box)
        hinge = (-_DEPTH / 2, _WIDTH / 2, _DOOR_BOTTOM)
        door = self.door.add_to(spec, box, hinge, ajar=0.0, friction=_FRICTION, damping=_DAMPING)
        self._add_door(door)
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

    def _add_controls(self, body: mujoco.MjsBody) -> None:
        """Paint the panel above the door: a vacuum gauge and two valves."""
        front, z = -_DEPTH / 2, (_DOOR_BOTTOM + _DOOR_HEIGHT + _HEIGHT) / 2
        panel = (0.002, 0.27, 0.055)
        add_look(body, f"{self.name}_panel", panel, (front, 0, z), f"{self.name}_trim")
        for part, material, radius, y, deep in (
            ("gauge", "metal", 0.048, 0.0, 0.006),
            ("dial", "dial", 0.042, 0.0, 0.008),
            ("valve_in", "metal", 0.020, 0.16, 0.022),
            ("valve_out", "metal", 0.020, -0.16, 0.022),
        ):
            look, size = f"{self.name}_{material}", (radius, deep, 0.0)
            name, pos = f"{self.name}_{part}", (front, y, z)
            add_look(body, name, size, pos, look, shape=CYLINDER, quat=_ALONG_X)
        needle = (0.010, 0.001, 0.018)
        add_look(body, f"{self.name}_needle", needle, (front, 0.0, z + 0.016), f"{self.name}_grip")

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
