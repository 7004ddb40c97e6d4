"""Streams of water that run freely: they fall, grow thin, end on what they strike; seen only."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.labware.parts.supply import Supply
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

_GRAVITY = np.array([0.0, 0.0, -9.81])
"""[m/s^2], as in MuJoCo."""
_WIDEST = 2.0
"""By how much a stream is wider than its outlet at most; ours: where it rises it slows down."""
_BUILT = 0.020
"""Length of a piece as it is built [m]."""
_WATER = (0.78, 0.88, 0.96)
_OPACITY = 0.45
"""Of running water; ours."""


@dataclass(frozen=True)
class Stream(Process):
    """Water that is seen to run from outlets: it remembers nothing, and nothing feels it.

    It flies as a body does that is thrown from the outlet; its cross-section times its speed is the
    flow everywhere (continuity). Liquid that a task has filled in is drawn by itself instead.

    Attributes:
        name: Beginning of the names of its geoms.
        of: What feeds it, each outlet alike.
        outlets: Names of the frames where it leaves, z the way that it does.
        radius: Of an outlet [m].
        falls: How far below its outlet it ends at the latest [m].
        lengths: Of how many straight lengths each stream is drawn.
    """

    name: str
    of: Supply
    outlets: tuple[str, ...]
    radius: float
    falls: float
    lengths: int = 6

    @override
    def show(self, apparatus: Apparatus) -> None:
        seen = 0.0 if self.of.pours(apparatus) else self.of.flow(apparatus)
        speed = seen / len(self.outlets) / (math.pi * self.radius**2)
        for number, outlet in enumerate(self.outlets):
            names = [f"{self.name}_{number}_{n}" for n in range(self.lengths)]
            if speed:
                self._run(apparatus, outlet, speed, names)
            elif apparatus.model.geom(names[0]).rgba[3]:  # it has just run dry
                for name in names:
                    apparatus.model.geom(name).rgba[3] = 0.0

    def path(self, start_w: FloatArray, velocity_w: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where a stream is, and how fast, at the ends of its lengths.

        Args:
            start_w: Where it leaves, shape (3,) [m].
            velocity_w: How fast, shape (3,) [m/s].

        Returns:
            Positions [m] and velocities [m/s], both of shape (lengths + 1, 3), world frame.
        """
        up, pull = float(velocity_w[2]), -float(_GRAVITY[2])
        lasts = (up + math.sqrt(up**2 + 2 * pull * self.falls)) / pull
        times = np.linspace(0.0, lasts, self.lengths + 1)[:, None]
        positions: FloatArray = start_w + times * velocity_w + times**2 / 2 * _GRAVITY
        return positions, velocity_w + times * _GRAVITY

    def _run(self, apparatus: Apparatus, outlet: str, speed: float, names: list[str]) -> None:
        model, data = apparatus.model, apparatus.data
        site = apparatus.site(outlet)
        carrier = int(model.site(outlet).bodyid[0])
        points, velocities = self.path(site.position_w, speed * site.z_axis)
        struck = False
        for name, start, end, one, other in zip(
            names, points[:-1], points[1:], velocities[:-1], velocities[1:], strict=True
        ):
            geom = model.geom(name)
            geom.rgba[3] = 0.0 if struck else _OPACITY
            if struck:
                continue
            along = end - start
            length = float(np.linalg.norm(along))
            free = _clear_way(model, data, start, along, carrier)
            struck, length = free < length, min(free, length)
            along /= np.linalg.norm(along)
            wide = math.sqrt(speed / max(float(np.linalg.norm(one + other)) / 2, 1e-6))
            # Filament keeps compiled sizes; a frame that stretches, both renderers take.
            wide = min(wide, _WIDEST)
            stretched = _turn_to(along) * (wide, wide, length / _BUILT)
            data.geom_xpos[int(geom.id)] = start + length / 2 * along
            data.geom_xmat[int(geom.id)] = stretched.ravel()

    def add_to(
        self,
        spec: mujoco.MjSpec,
        body: mujoco.MjsBody,
        places: tuple[tuple[Vector, Quaternion], ...],
    ) -> None:
        """Build its outlets, and what is seen of it, still dry.

        Args:
            spec: What the body is in.
            body: What its outlets are part of.
            places: Position [m] and orientation, scalar-first, of each outlet in its frame.
        """
        spec.add_material(name=self.name, emission=0.2, specular=0.8, shininess=0.8)
        for number, (outlet, (pos, quat)) in enumerate(zip(self.outlets, places, strict=True)):
            body.add_site(name=outlet, pos=pos, quat=quat, group=COLLISION_GROUP)
            for n in range(self.lengths):
                body.add_geom(
                    name=f"{self.name}_{number}_{n}",
                    type=mujoco.mjtGeom.mjGEOM_CYLINDER,
                    size=(self.radius, _BUILT / 2, 0.0),
                    pos=pos,
                    material=self.name,
                    rgba=(*_WATER, 0.0),
                    group=VISUAL_GROUP,
                    contype=0,
                    conaffinity=0,
                    mass=0,
                )


def _turn_to(along: FloatArray) -> FloatArray:
    """Return the rotation that brings z to a direction of unit length, shape (3, 3)."""
    quat, turn = np.empty(4), np.empty(9)
    mujoco.mju_quatZ2Vec(quat, along)
    mujoco.mju_quat2Mat(turn, quat)
    return turn.reshape(3, 3)


def _clear_way(
    model: mujoco.MjModel, data: mujoco.MjData, start: FloatArray, along: FloatArray, carrier: int
) -> float:
    """Return how far it is to what something strikes that does not carry its outlet [m]."""
    groups, hit = np.zeros(6, dtype=np.uint8), np.array([-1], dtype=np.int32)
    groups[COLLISION_GROUP] = 1
    way = along / np.linalg.norm(along)
    distance: float = mujoco.mj_ray(model, data, start, way, groups, 1, carrier, hit)
    return math.inf if distance < 0.0 else distance
