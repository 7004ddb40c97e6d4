"""A sprung push button: a round cap on a slide, as on the front of any instrument."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.solid import (
    CYLINDER,
    UNTURNED,
    Quaternion,
    Vector,
    add_look,
    add_part,
)
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import PRESSED, Reading
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP, SOLREF

type Color = tuple[float, float, float, float]

_STOP = 0.002
"""Travel of the cap after the click [m]."""
_PRELOAD, _STIFFNESS = 1.8, 200.0
"""Force before the cap yields [N] and spring rate [N/m]: 2.8 N at the click, within the 2 to 5 N
that makers give for the contact blocks of 22 mm push buttons. The paper gives no figures."""
_DAMPING = 2.0
"""Plunger in its grease [N s/m]: the cap comes back in about 30 ms without bouncing."""
_MASS = 0.015
"""Cap and plunger of plastic with the moving contact [kg]."""


@dataclass(frozen=True)
class PushButton(Process):
    """A button; the frame of its name lies in the middle of its face.

    Its z axis is the way it is pressed, its x axis the way the back of a hand looks that presses it
    comfortably. Behind it is a snap-action contact, which clicks in at one travel and out at a
    lesser one. It is asked once per control period: a cap that springs back along a finger bounces
    for 20 ms, which any instrument's input ignores.

    Attributes:
        name: Name of its body and of its frame.
        color: Of the cap, red, green, blue, alpha.
        radius: Of the cap [m]; finger tips are 30 mm wide.
        travel: How far in it clicks [m] (original: 5 mm).
        differential: How far it comes back before it clicks out [m]: the differential travel of a
            subminiature snap-action switch, 0.010 inch (NATO stock number 5930-01-142-8727).
        proud: How far the cap stands out of the panel when nobody presses it [m].
    """

    name: str
    color: Color
    radius: float = 0.018
    travel: float = 0.005
    differential: float = 0.00025
    proud: float = 0.014

    @property
    def joint(self) -> str:
        """Name of its slide [m]; positive is in."""
        return f"{self.name}_slide"

    @property
    def effort(self) -> float:
        """Force with which a finger presses it as far as it goes [N]."""
        return 5.0

    @property
    def force_sensor(self) -> str:
        """Name of the sensor of the force on its cap [N]."""
        return f"{self.name}_force"

    @property
    def cap(self) -> str:
        """Name of the geom that is seen of it."""
        return f"{self.name}_cap"

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("in",)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        least = self.travel - self.differential if memory[0] > 0.0 else self.travel
        memory[0] = apparatus.joint(self.joint) >= least

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        """Return 1 from when it has clicked in until it clicks out, else 0."""
        return Reading(float(apparatus.memory(self)[0]), PRESSED)

    def add_to(
        self, spec: mujoco.MjSpec, parent: mujoco.MjsBody, pos: Vector, quat: Quaternion = UNTURNED
    ) -> None:
        """Build its body onto a panel (angles in radians).

        Args:
            spec: The spec of the panel.
            parent: The panel.
            pos: Where on the surface of the panel its axis is [m].
            quat: Orientation of its frame in the panel's, scalar-first; z points into the panel.
        """
        material = self.cap
        spec.add_material(name=material, rgba=self.color, specular=0.3, shininess=0.5)
        body = parent.add_body(name=self.name, pos=pos, quat=quat)
        body.add_joint(
            name=self.joint,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(0, 0, 1),
            range=(0.0, self.travel + _STOP),
            stiffness=_STIFFNESS,
            springref=-_PRELOAD / _STIFFNESS,
            damping=_DAMPING,
            solref_limit=SOLREF,
            solimp_limit=SOLIMP,
        )
        half = self.proud / 2
        size, middle = (self.radius, half, 0.0), (0.0, 0.0, -half)
        add_part(body, self.cap, size, middle, material, mass=_MASS, shape=CYLINDER)
        dome = (0.8 * self.radius, 0.0005, 0.0)  # a raised face catches the light at its edge
        face = (0.0, 0.0, -self.proud)
        add_look(body, f"{self.name}_dome", dome, face, material, shape=CYLINDER)
        body.add_site(name=self.name, pos=face, group=COLLISION_GROUP)
        body.add_site(
            name=self.force_sensor,
            type=CYLINDER,
            pos=middle,
            size=(self.radius + 0.002, half + 0.002, 0.0),
            group=COLLISION_GROUP,
        )
        spec.add_sensor(
            name=self.force_sensor,
            type=mujoco.mjtSensor.mjSENS_TOUCH,
            objtype=mujoco.mjtObj.mjOBJ_SITE,
            objname=self.force_sensor,
        )
        spec.add_exclude(bodyname1=parent.name, bodyname2=self.name)
