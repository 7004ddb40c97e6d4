"""A bench-top cabinet of three drawers on slides, each with a bar handle."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.openable import Drawer, Handle
from labutopia_lerobot.labware.parts.solid import Vector, add_part

_DEPTH, _WIDTH, _HEIGHT = 0.560, 0.420, 0.480
"""Outer size [m]; ours: the top handle is as high as the original's, 1.15 m above the floor, and
within reach over its whole region."""
_SHEET = 0.010
"""Thickness of walls and of the drawers' sides [m]."""
_FRONT = 0.018
"""Thickness of the drawers' fronts, which close flush against the box [m]."""
_GAP = 0.003
"""Between two drawers, and between a drawer and the box [m]."""
_HANDLE_LENGTH = 0.160
"""Length of the bar [m], a usual one for furniture (hole spacing 160 mm)."""

_WIDEST = 0.300
"""Travel at which the slides stop [m]."""
_CLOSED = 0.002
"""Travel below which no gap is seen: less than that between two drawers [m]."""
_DRAWER_MASS = 3.0
"""A drawer of 1 mm steel sheet with what is in it [kg]."""
_FRICTION = 4.0
"""Dry friction of the slides [N]: ball bearings on steel run at about 1 % of the load, the rest is
the detent that keeps an empty drawer from creeping; ours, a few newtons as usual in furniture."""
_DAMPING = 15.0
"""Grease in the slides [N s/m]; ours: a drawer let go of at 0.3 m/s runs on for 2 cm."""

_LEVELS = ("bottom", "middle", "top")


@dataclass(frozen=True)
class Cabinet(Equipment):
    """A cabinet with a bottom, a middle and a top drawer; its front faces -x of its own frame.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        ajar: How far the top drawer stands open at the start [m].
    """

    name: str
    ajar: float = 0.0
    size = (0.629, 0.420, 0.480)
    mass = 25.0
    source = "ours; handle as high as the original's"
    passive = True

    @property
    def drawers(self) -> tuple[Drawer, ...]:
        """The drawers from bottom to top."""
        names = [f"{self.name}_{level}" for level in _LEVELS]
        handles = [Handle(f"{name}_handle", _HANDLE_LENGTH) for name in names]
        return tuple(
            Drawer(f"{name}_drawer", handle, widest=_WIDEST, closed_within=_CLOSED)
            for name, handle in zip(names, handles, strict=True)
        )

    @property
    def top_drawer(self) -> Drawer:
        """The drawer that a robot at the bench can reach best."""
        return self.drawers[-1]

    @property
    def mechanisms(self) -> tuple[Drawer, ...]:
        return self.drawers

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return math.hypot(_DEPTH, _WIDTH) / 2

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of each drawer's joint and handle (see `Drawer`, `Handle`).

        Returns:
            The body; its origin is the centre of the base, z up.
        """
        add_materials(
            spec,
            self.name,
            ("shell", (0.56, 0.60, 0.64, 1.0), 0.2),
            ("front", (0.25, 0.45, 0.60, 1.0), 0.2),
            ("tray", (0.80, 0.82, 0.83, 1.0), 0.2),
            ("metal", (0.82, 0.83, 0.84, 1.0), 0.6),
        )
        box = parent.add_body(name=self.name)
        self._add_box(box)
        for level, drawer in enumerate(self.drawers):
            self._add_drawer(spec, box, drawer, level)
        return box

    def _add_box(self, body: mujoco.MjsBody) -> None:
        x, y, z, half = _DEPTH / 2, _WIDTH / 2, _HEIGHT / 2, _SHEET / 2
        walls: dict[str, tuple[Vector, Vector]] = {
            "left": ((x, half, z), (0, y - half, z)),
            "right": ((x, half, z), (0, half - y, z)),
            "back": ((half, y, z), (x - half, 0, z)),
            "floor": ((x, y, half), (0, 0, half)),
            "roof": ((x, y, half), (0, 0, 2 * z - half)),
        }
        for wall, (size, pos) in walls.items():
            add_part(body, f"{self.name}_{wall}", size, pos, f"{self.name}_shell")

    def _add_drawer(
        self, spec: mujoco.MjSpec, box: mujoco.MjsBody, drawer: Drawer, level: int
    ) -> None:
        """Add a drawer: an open tray behind a front, which covers the box's edges."""
        start = self.ajar if drawer == self.top_drawer else 0.0
        tall = _HEIGHT / len(_LEVELS)
        middle = (level + 0.5) * tall
        closed: Vector = (-_DEPTH / 2, 0.0, middle)
        body = box.add_body(name=drawer.name, pos=(closed[0] - start, *closed[1:]))
        # MuJoCo reads `ref` as the joint's position in the pose that is built, and starts there.
        body.add_joint(
            name=drawer.joint,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(-1, 0, 0),
            range=(0.0, _WIDEST),
            ref=start,
            frictionloss=_FRICTION,
            damping=_DAMPING,
        )
        quarter = math.sqrt(0.5)
        box.add_site(name=drawer.joint, pos=closed, quat=(quarter, 0, -quarter, 0))  # z along -x
        spec.add_exclude(bodyname1=box.name, bodyname2=drawer.name)
        front = (_FRONT / 2, _WIDTH / 2, (tall - _GAP) / 2)
        share = _DRAWER_MASS / 5
        look = f"{self.name}_front"
        add_part(body, f"{drawer.name}_front", front, (-_FRONT / 2, 0, 0), look, mass=share)
        x, y = _DEPTH / 2 - _SHEET, _WIDTH / 2 - _SHEET - _GAP
        deep, half = 0.7 * tall, _SHEET / 2
        low = -tall / 2 + _SHEET + _GAP
        sides: dict[str, tuple[Vector, Vector]] = {
            "floor": ((x, y, half), (x, 0, low + half)),
            "left": ((x, half, deep / 2), (x, y - half, low + deep / 2)),
            "right": ((x, half, deep / 2), (x, half - y, low + deep / 2)),
            "back": ((half, y, deep / 2), (2 * x - half, 0, low + deep / 2)),
        }
        for side, (size, pos) in sides.items():
            add_part(body, f"{drawer.name}_{side}", size, pos, f"{self.name}_tray", mass=share)
        drawer.handle.add_to(body, (-_FRONT, 0, 0), f"{self.name}_metal", lying=True)
