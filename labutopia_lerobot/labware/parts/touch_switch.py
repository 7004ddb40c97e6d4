"""A cup on a spring: what is pressed into it runs the instrument, as long as it is pressed."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.dials import MovingPart
from labutopia_lerobot.labware.parts.mechanism import in_millimetres
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import ON, Reading
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP, SOLREF

_CLICK, _STOP = 0.001, 0.003
"""Travel at which it switches, and at which it stops [m]; ours."""
_PRELOAD, _STIFFNESS = 3.0, 1500.0
"""Force under which it begins to give [N], and its spring [N/m]; ours: it switches at 4.5 N, less
what the cup weighs. A tube that stands in it with 10 ml weighs 0.4 N: it does not run."""
_DAMPING = 40.0
"""Of the cup in its guide [N s/m]; ours: it comes up within 40 ms, and does not swing."""


@dataclass(frozen=True)
class SprungCup:
    """A cup that gives when it is pressed down; the frame of its name is its body's.

    Attributes:
        name: Name of its body and of its frame.
    """

    name: str

    @property
    def joint(self) -> str:
        """Name of its slide [m]; positive is down."""
        return f"{self.name}_slide"

    @property
    def widest(self) -> float:
        """Where it stops [m]."""
        return _STOP

    @property
    def effort(self) -> float:
        """Force with which a hand presses it as far as it goes [N]."""
        return 12.0

    def format_position(self, position: float) -> str:
        """Write a travel [m] with a unit."""
        return in_millimetres(position)

    def add_to(self, carrier: mujoco.MjsBody, pos: Vector) -> mujoco.MjsBody:
        """Build its body, still without forms, onto what carries it.

        Args:
            carrier: What it moves on.
            pos: Where its origin is while nobody presses it [m].

        Returns:
            The body, turned as the carrier is.
        """
        body = carrier.add_body(name=self.name, pos=pos)
        body.add_joint(
            name=self.joint,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(0, 0, -1),
            range=(0.0, _STOP),
            limited=mujoco.mjtLimited.mjLIMITED_TRUE,
            stiffness=_STIFFNESS,
            springref=-_PRELOAD / _STIFFNESS,
            damping=_DAMPING,
            solref_limit=SOLREF,
            solimp_limit=SOLIMP,
        )
        body.add_site(name=self.name, group=COLLISION_GROUP)
        return body


@dataclass(frozen=True)
class TouchSwitch(Process):
    """A switch with the positions touch and on: 1 while the cup is pressed, or the switch is on.

    Attributes:
        name: What its reading is called.
        cup: The cup that is pressed.
        switch: The rocker; at 0 it is set to touch.
    """

    name: str
    cup: SprungCup
    switch: MovingPart

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        pressed = apparatus.joint(self.cup.joint) > _CLICK
        thrown = apparatus.joint(self.switch.joint) > self.switch.widest / 2
        return Reading(float(pressed or thrown), ON)
