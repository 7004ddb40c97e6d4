"""A screw thread: a ridge around a neck, and lugs in a cap that run under it."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.mesh import Mesh
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP, SOLREF

_STEPS = 16
"""Straight pieces of ridge in a turn."""
_LUGS = 6
"""Lugs of a cap, evenly around it: they centre it, and over a turn keep it from tilting."""
_PLAY = 0.15
"""Share of the pitch by which ridge and lug together are thinner than the gap between turns."""


@dataclass(frozen=True)
class Thread:
    """A right-handed thread by contact alone: turned counterclockwise, a cap rises and comes off.

    The ridge begins a pitch and a half below the lip's height and winds down.

    Attributes:
        diameter: Outer diameter of the ridge [m].
        pitch: How far a cap rises in a turn [m].
        turns: Of the ridge.
    """

    diameter: float
    pitch: float
    turns: float = 1.5

    @property
    def bead(self) -> float:
        """Radius of ridge and lugs [m]."""
        return (1 - _PLAY) * self.pitch / 4

    @property
    def height(self) -> float:
        """Distance from the lip down to the lower end of the ridge [m]."""
        return (self.turns + 0.5) * self.pitch

    def add_ridge_to(self, body: mujoco.MjsBody, lip: float) -> None:
        """Build the ridge around the neck of a vessel, below its lip at a height [m]."""
        pieces = round(self.turns * _STEPS)
        ends = [self._on_ridge(2 * math.pi * n / _STEPS, lip) for n in range(pieces + 1)]
        for number in range(pieces):
            body.add_geom(
                name=f"{body.name}_ridge_{number:02d}",
                type=mujoco.mjtGeom.mjGEOM_CAPSULE,
                size=(self.bead, 0.0, 0.0),
                fromto=(*ends[number], *ends[number + 1]),
                group=COLLISION_GROUP,
                friction=FRICTION,
                solref=SOLREF,
                solimp=SOLIMP,
                mass=0.0,
            )

    def ridge(self, lip: float) -> Mesh:
        """Return what is seen of the ridge, below a lip at a height [m]."""
        around = 2 * np.pi * np.arange(6) / 5
        rings = []
        for number in range(round(self.turns * 2 * _STEPS) + 1):
            x, y, z = self._on_ridge(math.pi * number / _STEPS, lip)
            out = 1 + self.bead / math.hypot(x, y) * np.cos(around)
            rings.append(np.column_stack([out * x, out * y, z + self.bead * np.sin(around)]))
        index = np.arange(6 * len(rings)).reshape(-1, 6)
        a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
        halves = ((a, b, c), (a, c, d))
        faces = np.concatenate([np.stack(half, axis=-1).reshape(-1, 3) for half in halves])
        return np.concatenate(rings), faces

    def _on_ridge(self, angle: float, lip: float) -> tuple[float, float, float]:
        """Return the middle of the ridge, an angle up from its lower end [rad]."""
        radius = self.diameter / 2 - self.bead
        height = lip - self.height + self.pitch * angle / (2 * math.pi)
        return radius * math.cos(angle), radius * math.sin(angle), height

    def lugs(self, squeeze: float) -> list[tuple[float, float, float]]:
        """Return the middles of the lugs of a tight cap [m], from the middle of the lip.

        Args:
            squeeze: How far ridge and lug are pressed into each other [m].
        """
        first, apart = math.radians(20.0), 2 * math.pi / _LUGS
        return [self._under_ridge(first + n * apart, squeeze) for n in range(_LUGS)]

    def _under_ridge(self, angle: float, squeeze: float) -> tuple[float, float, float]:
        x, y, z = self._on_ridge(angle, 0.0)
        wider = 1 + 0.6 * self.bead / math.hypot(x, y)
        below = math.sqrt((2 * self.bead) ** 2 - (0.6 * self.bead) ** 2) - squeeze
        return wider * x, wider * y, z - below


GL45 = Thread(diameter=0.045, pitch=0.004)
"""Thread of laboratory bottles: GL 45 (DIN 168-1), pitch 4 mm; from memory."""
GL32 = Thread(diameter=0.032, pitch=0.004)
"""Thread of small bottles, otherwise as GL 45; from memory."""
