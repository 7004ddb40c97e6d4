"""What a planar laser scanner sees: rays among everything that is drawn."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.robots.laser_scanner import LaserScanner
from labutopia_lerobot.sim.scene import Scene, ancestors
from labutopia_lerobot.world.model import VISUAL_GROUP

_SEEN = np.array([group <= VISUAL_GROUP for group in range(6)], np.uint8)
"""Groups of geoms that light meets: those that are drawn. Panes count as solid."""
_BEYOND = 1e-4
"""How far behind a part of the robot a ray goes on [m]."""


class LaserScan:
    """The scanner of a robot in a scene; to it the robot itself is not there.

    It is exact: a real one is off by up to 40 mm (UST-10LX) or 60 mm (TiM571).

    Args:
        scene: The compiled scene; its robot has a base.
        scanner: What the scanner is like.
    """

    def __init__(self, scene: Scene, scanner: LaserScanner) -> None:
        base = scene.robot.base
        assert base is not None
        self._model, self._scanner = scene.model, scanner
        self._base = scene.model.body(base.body).id
        bodies = [self._base in ancestors(scene.model, b) for b in range(scene.model.nbody)]
        self._own = np.array(bodies)[scene.model.geom_bodyid]
        angles = scanner.angles
        self._rays_b = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))])

    def ranges(self, data: mujoco.MjData) -> NDArray[np.float32]:
        """Return how far one sees along every ray [m], shape (beams,); from right to left."""
        turn = data.xmat[self._base].reshape(3, 3)
        start = data.xpos[self._base] + turn @ self._scanner.place
        rays = np.ascontiguousarray(self._rays_b @ turn.T)
        beams = len(rays)
        far, geoms = np.empty(beams), np.empty(beams, np.int32)
        mujoco.mj_multiRay(
            self._model,
            data,
            start,
            rays.ravel(),
            _SEEN,
            True,
            self._base,
            geoms,
            far,
            None,
            beams,
            self._scanner.farthest,
        )
        for beam in np.flatnonzero((geoms >= 0) & self._own[geoms]):
            far[beam] = self._past_itself(data, start, rays[beam], far[beam])
        far[far < 0.0] = self._scanner.farthest
        return np.clip(far, self._scanner.nearest, self._scanner.farthest).astype(np.float32)

    def _past_itself(
        self, data: mujoco.MjData, start: NDArray[np.float64], ray: NDArray[np.float64], far: float
    ) -> float:
        """Return how far a ray goes that meets a part of the robot first [m]; -1 for ever."""
        hit = np.empty(1, np.int32)
        while far < self._scanner.farthest:
            far += _BEYOND
            further = mujoco.mj_ray(
                self._model, data, start + far * ray, ray, _SEEN, True, self._base, hit
            )
            if further < 0.0:
                break
            far += further
            if not self._own[hit[0]]:
                return far
        return -1.0
