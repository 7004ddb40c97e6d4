"""Puffs of steam or mist over a mouth: they rise or sink, and are drawn only."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import VISUAL_GROUP

_PUFFS = 16
"""How many there are over a mouth."""
_WIDENS = 1.6
"""By how much a puff is wider where it vanishes than at the mouth; ours."""
_OPACITY = 0.10
"""Of the densest puff; ours."""
_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
"""Angle from puff to puff about the axis [rad]: no two go above each other."""


@dataclass(frozen=True)
class Puffs:
    """The visible part of vapour that leaves a mouth.

    Attributes:
        name: Beginning of the names of its geoms.
        radius: Of the mouth [m].
        length: How high a puff gets over the mouth, or how deep it sinks below it [m].
        speed: How fast it goes along its way [m/s].
        aside: How far from the axis it begins and ends, in radii.
        sinks: Whether it is heavier than air, and goes over the rim and down.
    """

    name: str
    radius: float
    length: float
    speed: float
    aside: tuple[float, float]
    sinks: bool = False

    def show(self, apparatus: Apparatus, mouth_w: FloatArray, dense: float) -> None:
        """Bring them up to now.

        Args:
            apparatus: The processes at work.
            mouth_w: Middle of the mouth, shape (3,), world frame [m].
            dense: How dense they are, from 0 to 1.
        """
        near, far = self.aside
        seconds = apparatus.data.time
        for number in range(_PUFFS):
            geom = apparatus.model.geom(f"{self.name}_{number}")
            way = (seconds * self.speed / self.length + number / _PUFFS) % 1.0
            wide = 0.55 * self.radius * (1.0 + (_WIDENS - 1.0) * way)
            geom.size = (wide, wide, 1.3 * wide)
            # It comes into being over the mouth, and dissolves as it mixes with the room's air.
            geom.rgba[3] = _OPACITY * dense * math.sin(math.pi * math.sqrt(way))
            turn = _GOLDEN * number + 2.0 * way
            out = self.radius * (near + (far - near) * way)
            up = -self.length * way**2 if self.sinks else way * self.length
            drift = np.array((out * math.cos(turn), out * math.sin(turn), up))
            apparatus.data.geom_xpos[int(geom.id)] = mouth_w + drift

    def add_to(self, spec: mujoco.MjSpec, body: mujoco.MjsBody, parked: Vector) -> None:
        """Build them, still invisible.

        Args:
            spec: What the body is in.
            body: What they are part of.
            parked: Where they are while nothing is to be seen, in its frame [m].
        """
        spec.add_material(name=self.name, emission=0.35, specular=0.0, shininess=0.0)
        for number in range(_PUFFS):
            body.add_geom(
                name=f"{self.name}_{number}",
                type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
                size=(self.radius, self.radius, 0.3 * self.length),
                pos=parked,
                material=self.name,
                rgba=(0.93, 0.94, 0.95, 0.0),
                group=VISUAL_GROUP,
                contype=0,
                conaffinity=0,
                mass=0,
            )
