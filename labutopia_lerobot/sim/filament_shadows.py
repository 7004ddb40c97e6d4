"""Soft shadows in films: a lamp that is wide, as many sharp shadows that are laid over each other.

Filament's own soft shadows look like its hard ones (`filament.shadows.type`, MuJoCo
4.0.0, llvmpipe). Walls, ceiling and furniture cast none: the lamps of a room stand outside of it,
so that all would be in the shade.
"""

import math
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from labutopia_lerobot.sim.supersampling import Sample
from labutopia_lerobot.world import ROOM, FloatArray

if TYPE_CHECKING:
    from mujoco import mjrf

_HALF_WIDTH = math.tan(math.radians(4.0))
"""Tangent of half the angle under which things see the lamp: a panel of 30 cm from 2 m (ours)."""
_MAP = 4096
"""Pixels along a side of the map of shadows."""


class WideLamp:
    """A lamp of a scene of Filament's that casts shadows while it is asked to.

    Args:
        model: The model, compiled.
        name: Of the lamp.
        light: The lamp.
        shown: Returns what shows a geom.
        glass: Geoms of clear glass.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        name: str,
        light: "mjrf.Light",
        shown: Callable[[int], "mjrf.Renderable"],
        glass: Collection[int],
    ) -> None:
        self._light, self._shown, self._glass = light, shown, frozenset(glass)
        lamp = model.light(name)
        self._position_w = lamp.pos.copy()
        self._direction_w = lamp.dir / np.linalg.norm(lamp.dir)
        room = model.body(ROOM).id
        self._casting = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] != room]
        self._silent = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == room]

    @contextmanager
    def casting(self, sample: Sample) -> Iterator[None]:
        """Let it shine from one of its places, with shadows; afterwards it casts none.

        Args:
            sample: From which place, and whether glass is in the way.
        """
        for geom in self._silent:
            self._shown(geom).set_cast_shadow(False)
        for geom in self._casting:
            self._shown(geom).set_cast_shadow(sample.glass_shades or geom not in self._glass)
        self._light.set_shadow_map_size(_MAP)
        self._light.set_cast_shadow(True)
        self._light.set_pose(self._position_w, self._from(*sample.lamp))
        try:
            yield
        finally:
            self._light.set_cast_shadow(False)
            self._light.set_pose(self._position_w, self._direction_w)

    def _from(self, x: float, y: float) -> FloatArray:
        """Return in which direction it shines from a point of its disc, of radius 1."""
        one = np.cross(self._direction_w, (0.0, 0.0, 1.0))
        one /= np.linalg.norm(one)
        other = np.cross(self._direction_w, one)
        direction = self._direction_w + _HALF_WIDTH * (x * one + y * other)
        unit: FloatArray = direction / np.linalg.norm(direction)
        return unit
