"""Summary that an exported file must reproduce when it is opened: counts, masses, sizes."""

import math
from dataclasses import dataclass, fields
from itertools import product

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.export.carriers import FAR, carriers, is_drawn, is_joint, touches

_MASS_TOLERANCE = 0.01
"""Share by which masses may differ."""
_TOLERANCE = 1e-3
"""Tolerance of limits [rad or m], and of the corners of the whole [m]."""


@dataclass(frozen=True)
class Summary:
    """Numbers that are the same in a model and in its export.

    Attributes:
        moving: How many bodies move.
        drawn: How many shapes are seen.
        touched: How many shapes touch.
        limits: Least and greatest position of every hinge and slide, from its reference, sorted
            [rad or m]; infinite where there is none.
        masses: Of what moves, sorted [kg].
        low: Least corner of all that is seen or touches [m].
        high: Its greatest corner [m].
    """

    moving: int
    drawn: int
    touched: int
    limits: tuple[tuple[float, float], ...]
    masses: tuple[float, ...]
    low: tuple[float, float, float]
    high: tuple[float, float, float]

    @property
    def mass(self) -> float:
        """Mass of all that moves [kg]."""
        return sum(self.masses)

    def differences(self, other: "Summary") -> list[str]:
        """Return in what another differs, one line each."""
        same = {
            "limits": _near(self.limits, other.limits, atol=_TOLERANCE),
            "masses": _near(self.masses, other.masses, rtol=_MASS_TOLERANCE),
            "low": _near(self.low, other.low, atol=_TOLERANCE),
            "high": _near(self.high, other.high, atol=_TOLERANCE),
        }
        return [
            f"{field.name}: {getattr(self, field.name)} became {getattr(other, field.name)}"
            for field in fields(self)
            for mine, theirs in [(getattr(self, field.name), getattr(other, field.name))]
            if not same.get(field.name, mine == theirs)
        ]


def summary_of_model(model: mujoco.MjModel, data: mujoco.MjData) -> Summary:
    """Return what a compiled model says, in a pose."""
    moves_with = carriers(model)
    masses = np.bincount(moves_with, model.body_mass, model.nbody)
    moving = sorted({body for body in moves_with if body})
    joints = [joint for joint in range(model.njnt) if is_joint(model, joint)]
    geoms = range(model.ngeom)
    corners = [_geom_corners(model, data, g) for g in geoms if _is_summarized(model, g)]
    points = np.vstack([*corners, *([data.flexvert_xpos] if model.nflex else [])])
    return Summary(
        moving=len(moving),
        drawn=sum(is_drawn(model, geom) for geom in geoms) + model.nflex,
        touched=sum(touches(model, geom) for geom in geoms),
        limits=tuple(sorted(_limits(model, joint) for joint in joints)),
        masses=tuple(sorted(float(masses[body]) for body in moving)),
        low=tuple(points.min(axis=0).tolist()),
        high=tuple(points.max(axis=0).tolist()),
    )


def box_corners(low: NDArray[np.float64], high: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the corners of a box, shape (8, 3)."""
    return np.array(list(product(*zip(low, high, strict=True))))


def _is_summarized(model: mujoco.MjModel, geom: int) -> bool:
    return is_drawn(model, geom) or touches(model, geom)


def _geom_corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> NDArray[np.float64]:
    """Return the vertices of a mesh or the corners of the box around a shape, world frame."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        start = int(model.mesh_vertadr[mesh])
        points = model.mesh_vert[start : start + int(model.mesh_vertnum[mesh])]
    elif model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
        half = np.array([*(size or FAR for size in model.geom_size[geom, :2]), 0.0])
        points = box_corners(-half, half)
    else:
        points = box_corners(-model.geom_aabb[geom, 3:], model.geom_aabb[geom, 3:])
    corners: NDArray[np.float64] = points @ data.geom_xmat[geom].reshape(3, 3).T
    corners += data.geom_xpos[geom]
    return corners


def _limits(model: mujoco.MjModel, joint: int) -> tuple[float, float]:
    if not model.jnt_limited[joint]:
        return -math.inf, math.inf
    low, high = model.jnt_range[joint] - model.qpos0[model.jnt_qposadr[joint]]
    return float(low), float(high)


def _near(mine: object, theirs: object, *, rtol: float = 0.0, atol: float = 0.0) -> bool:
    first, second = np.asarray(mine, float), np.asarray(theirs, float)
    return first.shape == second.shape and np.allclose(first, second, rtol=rtol, atol=atol)
