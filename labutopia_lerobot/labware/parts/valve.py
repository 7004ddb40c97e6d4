"""Taps and hand-wheels: what opens and shuts a line."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned
from labutopia_lerobot.labware.parts.mechanism import add_moving, in_degrees
from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.world.model import COLLISION_GROUP


@dataclass(frozen=True)
class Tap:
    """A wing on a plug: along the line it is open, across it is shut; a quarter of a turn.

    The frame of its name lies in the middle of the wing, z along its axis into what carries it, x
    along the wing.

    Attributes:
        name: Name of its body and of its frame.
        length: Of the wing [m].
        look: Its finish.
        standoff: From what carries it to the wing [m].
    """

    name: str
    length: float = 0.040
    look: str = "blue"
    standoff: float = 0.016

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is shut."""
        return f"{self.name}_hinge"

    @property
    def widest(self) -> float:
        """Angle at which it is open [rad]."""
        return math.pi / 2

    @property
    def closed_within(self) -> float:
        """Angle below which it counts as shut [rad]; ours: those of ware are shut from 18 deg on.

        (`Bore.opening`)
        """
        return math.radians(10.0)

    @property
    def effort(self) -> float:
        """Torque with which two fingers turn it [N m]."""
        return 0.2

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
        """Build its body onto a line.

        Args:
            spec: What the line is in (angles in radians).
            piece: Name of the piece.
            parent: The line.
            pos: Where on its surface the axis is [m].
            quat: Orientation of the shut wing in the line's frame, scalar-first; z points into it.
        """
        body = add_moving(
            spec, parent, self, pos, (0, 0, 1), quat=quat, friction=0.04, damping=0.03
        )
        half, wide, out = self.length / 2, 0.10 * self.length, self.standoff
        forms = (
            Rod((0, 0, 0), (0, 0, -out), 0.35 * self.length, self.look),
            Block((-half, half), (-wide, wide), (-out - 0.008, -out + 0.002), self.look),
        )
        assemble(spec, body, piece, forms, mass=0.02)
        body.add_site(name=self.name, pos=(0, 0, -out - 0.003), group=COLLISION_GROUP)


@dataclass(frozen=True)
class HandWheel:
    """A spoked wheel on a spindle, turned counterclockwise to open.

    The frame of its name lies in the middle of the wheel, z along its axis into what carries it.

    Attributes:
        name: Name of its body and of its frame.
        diameter: Of the wheel [m].
        turns: From shut to open.
        look: Its finish.
        standoff: From what carries it to the wheel [m].
        effort: Torque with which a hand turns it [N m].
    """

    name: str
    diameter: float = 0.060
    turns: float = 1.0
    look: str = "black"
    standoff: float = 0.020
    effort: float = 1.5

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is shut."""
        return f"{self.name}_hinge"

    @property
    def widest(self) -> float:
        """Angle at which it is open [rad]."""
        return 2 * math.pi * self.turns

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
        """Build its body onto a valve; see `Tap.add_to`."""
        effort = self.effort
        body = add_moving(
            spec,
            parent,
            self,
            pos,
            (0, 0, -1),
            quat=quat,
            friction=0.2 * effort,
            damping=0.15 * effort,
        )
        radius, out = self.diameter / 2, self.standoff
        rim, thick = 0.14 * radius, 0.26 * radius
        section = [(radius - thick, -rim), (radius, -rim), (radius, rim), (radius - thick, rim)]
        section.append(section[0])
        forms: list[Form] = [
            Turned(section, self.look, (0, 0, -out), edge=0.4 * rim, touch=False),
            Rod((0, 0, 0), (0, 0, -out - rim), 0.36 * radius, "chrome"),
        ]
        arms = 5
        for arm in range(arms):
            angle, reach = 2 * math.pi * arm / arms, radius - thick / 2
            end = (reach * math.cos(angle), reach * math.sin(angle), -out)
            forms.append(Rod((0, 0, -out), end, 1.4 * rim, self.look, segments=10))
        assemble(spec, body, piece, forms, mass=500.0 * self.diameter**2 * 2 * rim)
        body.add_geom(
            name=f"{self.name}_rim_contact",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=(radius, rim, 0.0),
            pos=(0, 0, -out),
            group=COLLISION_GROUP,
            mass=0.0,
        )
        body.add_site(name=self.name, pos=(0, 0, -out), group=COLLISION_GROUP)
