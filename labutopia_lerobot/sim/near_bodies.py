"""Which of many distance limits may act just now; the others would cost time and bound nothing."""

from collections.abc import Hashable, Mapping
from itertools import chain

import mink
import mujoco
import numpy as np


class NearBodies[Key: Hashable]:
    """Finds limits with a pair of geoms whose bounding spheres are within the limit's horizon.

    mink asks the same of every limit by itself, and a room has dozens. Without the others the
    program loses only rows that are never violated.

    Args:
        model: What the geoms are of.
        limits: The limits, each under a name.
    """

    def __init__(
        self, model: mujoco.MjModel, limits: Mapping[Key, mink.CollisionAvoidanceLimit]
    ) -> None:
        self._names = list(limits)
        pairs = [limit.geom_id_pairs for limit in limits.values()]
        each = np.array(list(chain.from_iterable(pairs)), dtype=np.intp)
        horizons = [limit.collision_detection_distance for limit in limits.values()]
        counts = [len(each) for each in pairs]
        self._owners = np.repeat(np.arange(len(counts)), counts)
        self._first, self._second = each.reshape(-1, 2).T
        radii = np.where(model.geom_rbound > 0.0, model.geom_rbound, np.inf)  # of a plane: 0
        self._within = radii[self._first] + radii[self._second] + np.repeat(horizons, counts)

    def at(self, data: mujoco.MjData) -> set[Key]:
        """Return the names of those that may act where the geoms are."""
        apart = data.geom_xpos[self._first] - data.geom_xpos[self._second]
        near = np.einsum("ij,ij->i", apart, apart) <= self._within**2
        return {self._names[owner] for owner in np.unique(self._owners[near])}
