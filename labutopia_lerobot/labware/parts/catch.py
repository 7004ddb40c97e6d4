"""A roller catch: what makes a door click shut, and keeps it shut."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_look, add_part
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLREF, VISUAL_GROUP

_RADIUS, _WIDTH = 0.005, 0.012
"""Radius and half length of the roller on the door and of the pin on the box [m]; ours."""
_SHUT = 0.006
"""Distance of the roller behind the pin when the door is shut [m]; ours. It still rests on the pin,
whose slope of 37 degrees there draws the door against its stop."""
_DROP, _TRAVEL = 0.0028, 0.006
"""Travel of the roller out again behind the pin, and in when pressed [m]; ours."""
_PRELOAD, _STIFFNESS = 23.0, 1500.0
"""Force before the roller yields [N] and spring rate [N/m]: see `HOLDS`."""
_DAMPING = 8.0
"""Damping of the plunger in its sleeve [N s/m]: it drops without bouncing."""
_MASS = 0.1
"""Mass of plunger and roller, and of the spring as felt at them [kg]."""
_HARD = (0.99, 0.999, 0.0005, 0.5, 2.0)
"""Contact that the spring presses in by less than 0.1 mm."""
_CLEAR = 0.004
"""Height of the middle of the roller above the door's edge [m]."""

HOLDS = 17.0
"""Force at the catch that pulls a shut door open [N]; a fifth more shuts it. Ours, no maker of
ovens gives: two fingers open it, and it does not shake open. A test measures it."""

_ACROSS = (0.5**0.5, 0.5**0.5, 0.0, 0.0)  # z axis along -y


@dataclass(frozen=True)
class Catch:
    """A sprung roller in the upper edge of a door, and a pin on the box that it drops behind.

    Contact and a spring do it: nothing else keeps the door shut, and nothing is remembered.

    Attributes:
        name: Name of the roller's body; prefix of the names of all its elements.
    """

    name: str

    @property
    def joint(self) -> str:
        """Name of the roller's slide [m]; 0 is all the way out."""
        return f"{self.name}_slide"

    @property
    def engaged_within(self) -> float:
        """Position of the slide of a shut door below which the roller is behind the pin [m]."""
        return 0.75 * _DROP

    def add_to(
        self, box: mujoco.MjsBody, door: mujoco.MjsBody, hinge: Vector, at: Vector, material: str
    ) -> None:
        """Build its halves onto a box, and onto the door in front of it.

        Args:
            box: What the door closes; its front, which faces -x, goes through the hinge.
            door: The door.
            hinge: Origin of the shut door in the frame of the box, which is turned as it is [m].
            at: Where on the door's upper edge the roller comes out [m], in the door's frame.
            material: Name of a material of the spec.
        """
        x, y, z = at
        body = door.add_body(name=self.name, pos=(x, y, z + _CLEAR))
        body.add_joint(
            name=self.joint,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(0, 0, -1),
            range=(0.0, _TRAVEL),
            stiffness=_STIFFNESS,
            springref=-_PRELOAD / _STIFFNESS,
            damping=_DAMPING,
            solref_limit=SOLREF,
            solimp_limit=_HARD,
        )
        roller = (_RADIUS, _WIDTH, 0.0)
        look = f"{self.name}_roller"
        add_look(body, look, roller, (0, 0, 0), material, mass=_MASS, shape=CYLINDER, quat=_ACROSS)
        body.add_geom(
            name=f"{self.name}_contact",
            type=mujoco.mjtGeom.mjGEOM_SPHERE,
            size=(_RADIUS, 0.0, 0.0),
            group=COLLISION_GROUP,
            mass=0.0,
            condim=1,  # it rolls
            priority=1,
            solref=SOLREF,
            solimp=_HARD,
        )
        height = z + _CLEAR + 2 * _RADIUS - _DROP
        pin = (hinge[0] + x - _SHUT, hinge[1] + y, hinge[2] + height)
        for suffix, group, collides in (
            ("pin", VISUAL_GROUP, 0),
            ("pin_contact", COLLISION_GROUP, 1),
        ):
            box.add_geom(
                name=f"{self.name}_{suffix}",
                type=CYLINDER,
                size=roller,
                pos=pin,
                quat=_ACROSS,
                material=material,
                group=group,
                contype=collides,
                conaffinity=collides,
                mass=0.0,
            )
        reach = (hinge[0] - pin[0] + _RADIUS) / 2  # from the front to beyond the pin
        plate = (reach, _WIDTH, 0.002)
        above = (hinge[0] - reach, pin[1], pin[2] + 0.004)
        add_part(box, f"{self.name}_bracket", plate, above, material)
