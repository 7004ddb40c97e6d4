"""A detent: what makes a knob click from step to step, and stay in one."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.world.model import COLLISION_GROUP, SOLREF

_WHEEL = 0.012
"""Radius of the circle of bumps inside the panel [m]; ours."""
_INSIDE = 0.006
"""Distance of the bumps behind the surface of the panel [m]."""
_PRELOAD, _STIFFNESS, _DAMPING, _MASS = 2.0, 400.0, 6.0, 0.1
_HARD = (0.99, 0.999, 0.0005, 0.5, 2.0)
"""Spring of the ball [N, N/m, N s/m, kg] and its contacts: a few N cm at the knob, as makers of
rotary switches give; mass and hardness as of the roller of `Catch`."""
_BIT = 4
"""Bit of MuJoCo's collision masks: balls and bumps meet nothing else."""


@dataclass(frozen=True)
class Detent:
    """A sprung ball that runs over bumps between the steps; contact and a spring do it.

    Attributes:
        name: Name of the ball's body; prefix of its elements.
        steps: How many positions there are, evenly from 0 to where the knob stops.
    """

    name: str
    steps: int

    def add_to(
        self, spec: mujoco.MjSpec, panel: mujoco.MjsBody, knob: mujoco.MjsBody, widest: float
    ) -> None:
        """Build the bumps onto a knob and the ball into the panel.

        Args:
            spec: What both are in.
            panel: What the knob turns on.
            knob: Its z axis points into the panel, from its surface on.
            widest: Where it stops [rad].
        """
        pitch = widest / (self.steps - 1)
        half = _WHEEL * math.sin(min(pitch, 1.2) / 2)
        bump = 0.6 * half
        rest = _WHEEL * math.cos(min(pitch, 1.2) / 2) + math.sqrt((2 * bump) ** 2 - half**2)
        for number in range(self.steps + 1):
            angle = math.pi - (number - 0.5) * pitch
            pos = (_WHEEL * math.cos(angle), _WHEEL * math.sin(angle), _INSIDE)
            self._add_ball(knob, f"{knob.name}_bump_{number}", bump, pos, contype=_BIT)
        turn = Rotation.from_quat(knob.quat, scalar_first=True)
        far = np.asarray(knob.pos) + turn.apply((-rest, 0.0, _INSIDE))
        body = panel.add_body(name=self.name, pos=far, quat=knob.quat)
        body.add_joint(
            name=f"{self.name}_slide",
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(1, 0, 0),
            range=(-2 * bump, bump),
            stiffness=_STIFFNESS,
            springref=_PRELOAD / _STIFFNESS,
            damping=_DAMPING,
            solref_limit=SOLREF,
        )
        self._add_ball(body, f"{self.name}_ball", bump, (0, 0, 0), conaffinity=_BIT, mass=_MASS)

    def _add_ball(
        self,
        body: mujoco.MjsBody,
        name: str,
        radius: float,
        pos: tuple[float, float, float],
        contype: int = 0,
        conaffinity: int = 0,
        mass: float = 0.0,
    ) -> None:
        body.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_SPHERE,
            size=(radius, 0.0, 0.0),
            pos=pos,
            group=COLLISION_GROUP,
            contype=contype,
            conaffinity=conaffinity,
            condim=1,  # it rolls
            solref=SOLREF,
            solimp=_HARD,
            mass=mass,
        )
