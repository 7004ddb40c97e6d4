"""Knobs: a dial that is turned clockwise, with steps that click where it has some."""

import math
from dataclasses import dataclass

import mujoco
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.detent import Detent
from labutopia_lerobot.labware.parts.form import Block, Turned
from labutopia_lerobot.labware.parts.mechanism import add_moving, in_degrees
from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.world.model import COLLISION_GROUP

_FRICTION, _DAMPING = 0.010, 0.008
"""Friction, damping of a panel potentiometer [N m, N m s/rad]: makers give 0.3 to 1.5 N cm
of turning torque."""
_DENSITY = 1100.0
"""Density of ABS with its insert [kg/m^3]."""


@dataclass(frozen=True)
class Knob:
    """A dial with a pointer; the frame of its name lies in the middle of its face.

    Its z axis points into the panel; the dial turns about it, clockwise for who looks at it. Its x
    axis goes along the pointer.

    Attributes:
        name: Name of its body and of its frame.
        widest: Where it stops [rad]; 300 degrees as potentiometers do.
        diameter: Of the dial [m].
        depth: How far it stands out [m].
        steps: Positions at which it clicks, evenly from 0 to `widest`; 0 for none.
        look: Its finish.
        pointer: Finish of its pointer.
        begins: Where it is turned to when an episode begins [rad].
    """

    name: str
    widest: float = math.radians(300.0)
    diameter: float = 0.030
    depth: float = 0.018
    steps: int = 0
    look: str = "anthracite"
    pointer: str = "white"
    begins: float = 0.0

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]."""
        return f"{self.name}_hinge"

    @property
    def effort(self) -> float:
        """Torque with which two fingers turn it [N m]."""
        return 0.15 if self.steps else 0.05

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return in_degrees(position)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        piece: str,
        parent: mujoco.MjsBody,
        pos: Vector,
        quat: Quaternion,
    ) -> None:
        """Build its body onto a panel.

        Args:
            spec: What the panel is in (angles in radians).
            piece: Name of the piece.
            parent: The panel.
            pos: Where on the surface of the panel its axis is [m].
            quat: Orientation of its frame when it is half turned, in the panel's, scalar-first; z
                points into the panel.
        """
        half = math.degrees(self.widest) / 2
        start = Rotation.from_quat(quat, scalar_first=True) * Rotation.from_euler(
            "z", -half, degrees=True
        )
        w, x, y, z = (float(part) for part in start.as_quat(scalar_first=True))
        body = add_moving(
            spec,
            parent,
            self,
            pos,
            (0, 0, 1),
            quat=(w, x, y, z),
            friction=_FRICTION,
            damping=_DAMPING,
            begins=self.begins,
        )
        radius, depth = self.diameter / 2, self.depth
        skirt = [(0, 0), (radius, 0), (radius, 0.2 * depth), (0.82 * radius, 0.3 * depth)]
        skirt += [(0.76 * radius, depth), (0, depth)]
        line = Block(
            (0.15 * radius, 0.95 * radius),
            (-0.06 * radius, 0.06 * radius),
            (-depth - 0.0006, -0.2 * depth),
            self.pointer,
            edge=0.0,
            touch=False,
        )
        mass = _DENSITY * 0.7 * math.pi * radius**2 * depth
        forms = (Turned(skirt, self.look, axis=(0, 0, -1), segments=24), line)
        assemble(spec, body, piece, forms, mass)
        body.add_site(name=self.name, pos=(0, 0, -depth), group=COLLISION_GROUP)
        if self.steps:
            Detent(f"{self.name}_detent", self.steps).add_to(spec, parent, body, self.widest)
