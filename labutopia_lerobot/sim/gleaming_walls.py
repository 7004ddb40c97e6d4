"""Walls of clear glass, turned about their axes towards the eye (see `labware.glass.gleam`)."""

from collections.abc import Iterator

import mujoco
import numpy as np

from labutopia_lerobot.labware.glass.gleam import GLEAM
from labutopia_lerobot.world import FloatArray


class GleamingWalls:
    """The walls of clear glass of a model."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._walls: dict[int, tuple[int, FloatArray]] = {}
        for geom in np.flatnonzero(model.geom_matid >= 0).tolist():
            texture = model.mat_texid[model.geom_matid[geom], mujoco.mjtTextureRole.mjTEXROLE_RGB]
            if texture >= 0 and model.texture(texture).name == GLEAM:
                within = np.empty(9)
                mujoco.mju_quat2Mat(within, model.geom_quat[geom])
                self._walls[geom] = int(model.geom_bodyid[geom]), within.reshape(3, 3)

    @property
    def geoms(self) -> tuple[int, ...]:
        """Their numbers."""
        return tuple(self._walls)

    def turned(self, data: mujoco.MjData, eye_w: FloatArray) -> Iterator[tuple[int, FloatArray]]:
        """Yield every wall with its axes, shape (3, 3), when what faces the eye is see-through.

        Args:
            data: Where the vessels are.
            eye_w: Where the eye is [m], world frame.
        """
        for geom, (body, within) in self._walls.items():
            axes = data.xmat[body].reshape(3, 3)
            x, y, _ = (eye_w - data.xpos[body]) @ axes  # z is the vessel's axis
            size = max(float(np.hypot(x, y)), 1e-9)
            turn = np.array([[x, -y, 0], [y, x, 0], [0, 0, size]]) / size
            yield geom, axes @ turn @ within
