"""Surroundings of a liquid, as MuJoCo has them: vessels by their glass, all else by its shapes."""

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.bodies import (
    BodyFrames,
    Glass,
    Shapes,
    free_way,
    no_glass_between,
)
from labutopia_lerobot.liquids.solver.obstacles import BOX, CAPSULE, CYLINDER, PLANE, SPHERE
from labutopia_lerobot.liquids.solver.walls import EDGE_NUMBERS, edges_of
from labutopia_lerobot.substances.filling import Fillable
from labutopia_lerobot.world import FloatArray

_KINDS = {
    mujoco.mjtGeom.mjGEOM_PLANE: PLANE,
    mujoco.mjtGeom.mjGEOM_SPHERE: SPHERE,
    mujoco.mjtGeom.mjGEOM_CAPSULE: CAPSULE,
    mujoco.mjtGeom.mjGEOM_CYLINDER: CYLINDER,
    mujoco.mjtGeom.mjGEOM_BOX: BOX,
}


_FALLS = 0.05
"""Speed from which on a thing does not stand [m/s]; ours: a free fall of 0.1 mm."""
_LEANS = 0.996
"""Cosine of the tilt from which on a vessel leans: 5 degrees; ours."""
_PRESSED = 3e-4
"""How deep in a wall a tip may be that is pressed against it [m]; ours: glass is thicker."""


class Carrier(NamedTuple):
    """The robot: what lies on what it holds is not yet spilled.

    Attributes:
        root: Its root body.
        base: That of a base that drives, if it has one: what lies on its deck is spilled, though
            that moves.
    """

    root: int
    base: int | None = None


class Surroundings:
    """The walls of a scene, moving with its bodies; their owners are first vessels, then geoms.

    Args:
        model: The compiled scene.
        data: Its state.
        vessels: Everything that can hold liquid.
        robot: What can carry things, if anything.

    Attributes:
        glass: The vessels.
        shapes: All else that things collide with; a mesh is the box around it.
        inner: Number of edges of each vessel's cavity, shape (vessels,).
        smallest_first: The vessels, by the volume of their cavities, shape (vessels,).
        owners: Number of vessels and shapes.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        vessels: Sequence[Fillable],
        robot: Carrier | None = None,
    ) -> None:
        self._data = data
        self._robot = -1 if robot is None else robot.root
        self._vessels = np.array([model.body(vessel.name).id for vessel in vessels], dtype=int)
        solid = (model.geom_contype | model.geom_conaffinity) != 0
        self._geoms = np.flatnonzero(solid & ~np.isin(model.geom_bodyid, self._vessels))
        self._bodies = np.concatenate([self._vessels, model.geom_bodyid[self._geoms]])
        welded = model.body_weldid[self._bodies]
        self._moves = welded > 0
        self._deck = np.zeros(len(welded), dtype=bool)
        if robot is not None and robot.base is not None:
            self._deck = welded == model.body_weldid[robot.base]
        self._movable = np.flatnonzero(self._moves)
        self._roots = model.body_rootid[self._bodies]
        self._root_of_geom = model.body_rootid[model.geom_bodyid]
        free = model.jnt_type == mujoco.mjtJoint.mjJNT_FREE
        self._free = model.body_rootid[model.jnt_bodyid[free]]
        self._falling_dofs = model.jnt_dofadr[free][:, None] + np.arange(3)
        self.owners = len(self._bodies)
        self.inner = np.array([len(vessel.profile.inner) for vessel in vessels], dtype=int)
        capacities = [vessel.profile.capacity for vessel in vessels]
        self.smallest_first = np.argsort(capacities, kind="stable")
        self.glass = _glass(vessels)
        self.shapes = _shapes(model, self._geoms)
        boxed = model.geom_type[self._geoms] == mujoco.mjtGeom.mjGEOM_MESH
        self._centres = np.where(boxed[:, None], model.geom_aabb[self._geoms, :3], 0.0)

    def move(self) -> None:
        """Read where the walls are now, and remember where they were."""
        data = self._data
        for walls in (self.glass, self.shapes):
            walls.before.origin[:], walls.before.rotation[:] = walls.now
        self.glass.now.origin[:] = data.xpos[self._vessels]
        self.glass.now.rotation[:] = data.xmat[self._vessels].reshape(-1, 3, 3)
        rotation = data.geom_xmat[self._geoms].reshape(-1, 3, 3)
        offset = np.einsum("sij,sj->si", rotation, self._centres)
        self.shapes.now.origin[:] = data.geom_xpos[self._geoms] + offset
        self.shapes.now.rotation[:] = rotation

    @property
    def standing(self) -> NDArray[np.bool_]:
        """Mask of the owners that stand, shape (owners,): not touched by the robot, not falling.

        The deck of a base that drives counts as such.
        """
        data = self._data
        geoms = data.contact.geom[(data.contact.geom >= 0).all(axis=1)]  # no flexes
        of_geom = self._root_of_geom[geoms]
        held = of_geom[(of_geom == self._robot).any(axis=1)].ravel()
        speeds = np.linalg.norm(data.qvel[self._falling_dofs], axis=1)
        carried = np.concatenate([held, self._free[speeds > _FALLS]])
        stands: NDArray[np.bool_] = np.isin(self._roots, [self._robot, *carried], invert=True)
        stands |= ~self._moves | self._deck
        return stands

    def over_bottoms(self, positions: FloatArray, inside: NDArray[np.int64]) -> FloatArray:
        """Return how high points are for crystals, which stay on a bottom, shape (n,) [m].

        In a vessel that stands, their height; in one that leans, how far they are from its base:
        wet grains hold together (Hornbaker and others, Nature 387, 1997) and do not slide down.

        Args:
            positions: Shape (n, 3), metres, world frame.
            inside: Which vessel each is in, shape (n,); -1 none.
        """
        heights, now = positions[:, 2].copy(), self.glass.now
        for vessel in np.flatnonzero(now.rotation[:, 2, 2] < _LEANS):
            held = inside == vessel
            along = positions[held] - now.origin[vessel]
            heights[held] = along @ now.rotation[vessel][:, 2]
        return heights

    def free_way(self, start: FloatArray, end: FloatArray) -> float:
        """Return how much of a straight way nothing is in, as `bodies.free_way` has it."""
        return float(free_way(start, end, self.glass, self.shapes))

    def no_glass_between(self, points_w: FloatArray, end_w: FloatArray) -> NDArray[np.bool_]:
        """Return which points, shape (n, 3) [m], no glass keeps from another one, shape (n,)."""
        clear: NDArray[np.bool_] = no_glass_between(points_w, end_w, self.glass, _PRESSED)
        return clear

    def push(self, wrench: FloatArray) -> None:
        """Apply forces until the next call, through MuJoCo's `xfrc_applied`.

        Args:
            wrench: Force [N] and moment about the world's origin [N m] on every owner, shape
                (owners, 6), world frame; on what cannot move it is lost.
        """
        _push(wrench, self._bodies, self._movable, self._data.xipos, self._data.xfrc_applied)


@kernel
def _push(
    wrench: FloatArray,
    bodies: NDArray[np.int64],
    movable: NDArray[np.int64],
    centre: FloatArray,
    applied: FloatArray,
) -> None:
    """Sum the wrenches on every body, about its centre of mass."""
    for owner in movable:
        applied[bodies[owner]] = 0.0
    for owner in movable:
        force, moment, arm = wrench[owner, :3], wrench[owner, 3:], centre[bodies[owner]]
        applied[bodies[owner], :3] += force
        applied[bodies[owner], 3:] += moment - np.cross(arm, force)


def _glass(vessels: Sequence[Fillable]) -> Glass:
    edges = [edges_of(vessel.profile) for vessel in vessels]
    heights = np.array([vessel.profile.height for vessel in vessels])
    widest = np.array([max(r for r, _ in vessel.profile.outer) for vessel in vessels])
    return Glass(
        np.vstack([np.empty((0, EDGE_NUMBERS)), *edges]),
        np.cumsum([0, *(len(part) for part in edges)]),
        heights / 2,
        np.hypot(heights / 2, widest),
        _frames(len(vessels)),
        _frames(len(vessels)),
    )


def _shapes(model: mujoco.MjModel, geoms: NDArray[np.intp]) -> Shapes:
    kinds = [_KINDS.get(mujoco.mjtGeom(kind), BOX) for kind in model.geom_type[geoms]]
    boxed = np.isin(model.geom_type[geoms], [int(kind) for kind in _KINDS], invert=True)
    size = np.where(boxed[:, None], model.geom_aabb[geoms, 3:], model.geom_size[geoms])
    fixed = model.body_weldid[model.geom_bodyid[geoms]] == 0
    frames = _frames(len(geoms)), _frames(len(geoms))
    return Shapes(np.array(kinds, dtype=np.int64), size, fixed, *frames)


def _frames(count: int) -> BodyFrames:
    return BodyFrames(np.zeros((count, 3)), np.tile(np.eye(3), (count, 1, 1)))
