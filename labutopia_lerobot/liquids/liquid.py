"""The liquid of a scene, between MuJoCo and the particles."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.account import whereabouts
from labutopia_lerobot.liquids.bodies import Glass, Shapes
from labutopia_lerobot.liquids.filling import Dispenser, Fillable, Filling
from labutopia_lerobot.liquids.lattice import lattice
from labutopia_lerobot.liquids.obstacles import BOX, CAPSULE, CYLINDER, PLANE, SPHERE
from labutopia_lerobot.liquids.solver import LIQUID_HZ, Flow, advance
from labutopia_lerobot.liquids.walls import EDGE_NUMBERS, edges_of
from labutopia_lerobot.world import FloatArray, Pose, Volumes

PARTICLES = 1000
"""Particles of a scene by default: 0.1 ml each in 100 ml."""

_SETTLE_STEPS = 120
"""Steps in which a new filling comes to rest, the vessels standing still."""

_SETTLE_DAMPING = 0.9

_FASTEST = 50.0
"""Speed [m/s] that no liquid on a bench has: beyond it the solver has diverged."""

_ENDLESS = 1e6
"""Radius of the ball around a plane [m]."""

_JET_SPEED = 2.0
"""Fastest that liquid leaves a spout [m/s]: what 2 kPa, a squeeze by hand, drive out of it (half of
density times speed squared)."""

_KINDS = {
    mujoco.mjtGeom.mjGEOM_PLANE: PLANE,
    mujoco.mjtGeom.mjGEOM_SPHERE: SPHERE,
    mujoco.mjtGeom.mjGEOM_CAPSULE: CAPSULE,
    mujoco.mjtGeom.mjGEOM_CYLINDER: CYLINDER,
    mujoco.mjtGeom.mjGEOM_BOX: BOX,
}


class Liquid:
    """Particles of one substance among the vessels and shapes of a model.

    Args:
        model: The compiled scene.
        data: Its state; the walls are where it says at every step.
        vessels: Everything that can hold the liquid.
        filling: What it is, and how much there is of it in all.
        particles: Number of particles.

    Attributes:
        positions: Shape (n, 3), metres, world frame; none before `fill`.
        velocities: Shape (n, 3), m/s, world frame.
        diverged: Whether the solver has failed; the particles then stay where they are.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        vessels: Sequence[Fillable],
        filling: Filling,
        particles: int = PARTICLES,
    ) -> None:
        self.vessels = tuple(vessels)
        self.substance = filling.substance
        self.volume = filling.volume / particles
        self._particles = particles
        self._sources: frozenset[str] = frozenset()
        self._filled: dict[str, int] = {}
        self._waiting: dict[str, int] = {}
        self._flow = Flow.of(self.substance, self.volume)
        self._data = data
        self._bodies = np.array([model.body(vessel.name).id for vessel in vessels])
        self._geoms = _solid_geoms(model, set(self._bodies.tolist()))
        self._owners = np.concatenate([self._bodies, model.geom_bodyid[self._geoms]])
        self._movable = np.flatnonzero(model.body_weldid[self._owners] > 0)
        edges = [edges_of(vessel.profile) for vessel in vessels]
        self._glass = _glass(self.vessels, edges)
        self._inner = np.array([len(vessel.profile.inner) for vessel in vessels])
        self._shapes = _shapes(model, self._geoms)
        boxed = model.geom_type[self._geoms] == mujoco.mjtGeom.mjGEOM_MESH
        self._centres = np.where(boxed[:, None], model.geom_aabb[self._geoms, :3], 0.0)
        self._impulse = np.zeros((len(self._owners), 6))
        self.empty()

    def empty(self) -> None:
        """Take all liquid away."""
        self._waiting = dict.fromkeys(self._waiting, 0)
        self._start(np.empty((0, 3)))

    def _start(self, positions: FloatArray) -> None:
        self.positions = positions
        self.velocities = np.zeros_like(positions)
        self.diverged = False
        self._pressure: FloatArray = np.zeros(len(positions))
        self._on_surface: NDArray[np.bool_] = np.zeros(len(positions), dtype=np.bool_)
        self._impulse[:] = 0.0
        self._find_walls()
        self._find_walls()

    def fill(
        self, contents: Mapping[Fillable | Dispenser, Filling], rng: np.random.Generator
    ) -> None:
        """Fill vessels, where they are and as they stand, and let the liquid come to rest in them.

        What is in a squeeze bottle waits there until it is dispensed.

        Args:
            contents: What each vessel holds; together they are all the liquid there is.
            rng: Where the particles' disorder comes from.
        """
        self._find_walls()
        total = sum(filling.volume for filling in contents.values())
        heaps, left = [np.empty((0, 3))], self._particles
        self._waiting = {}
        for vessel, filling in contents.items():
            share = min(left, round(filling.volume / total * self._particles))
            left -= share
            if isinstance(vessel, Dispenser):
                self._waiting[vessel.name] = share
                continue
            index = self.vessels.index(vessel)
            local = lattice(vessel.profile, share, self._flow.spacing, rng)
            turn, origin = self._glass.rotation[index], self._glass.origin[index]
            heaps.append(origin + local @ turn.T)
        self._filled = dict(self._waiting)
        self._start(np.vstack(heaps))
        self._sources = frozenset(vessel.name for vessel in contents)
        for _ in range(_SETTLE_STEPS if len(self.positions) else 0):
            self._advance()
            self.velocities *= _SETTLE_DAMPING

    def dispense(self, bottle: Dispenser, volume: float, spout: Pose, duration: float) -> None:
        """Let liquid out of a bottle, a particle for every volume of one that its wall displaces.

        A wall that snaps in displaces more than the spout lets through at once; it follows.

        Args:
            bottle: What it leaves.
            volume: What the wall has displaced since the bottle was filled, all in all [m^3].
            spout: End of the spout; z the way that the liquid leaves.
            duration: Time since the previous call [s].
        """
        waiting = self._waiting.get(bottle.name, 0)
        if not waiting:
            return
        filled = self._filled[bottle.name]
        due = volume - (filled - waiting) * self.volume
        passing = min(due, _JET_SPEED * bottle.bore_area * duration)
        count = min(waiting, max(int(passing / self.volume), int(due >= self.volume)))
        if not count:
            return
        self._waiting[bottle.name] = waiting - count
        velocity = passing / duration / bottle.bore_area * spout.z_axis
        ages = duration * (np.arange(count)[:, None] + 0.5) / count
        self.release(spout.position_w + ages * velocity, np.tile(velocity, (count, 1)))

    def release(self, positions: FloatArray, velocities: FloatArray) -> None:
        """Add particles, as from a spout.

        Args:
            positions: Shape (m, 3), metres, world frame, none in glass.
            velocities: Shape (m, 3), m/s, world frame.
        """
        fresh = np.zeros(len(positions))
        self.positions = np.vstack([self.positions, positions])
        self.velocities = np.vstack([self.velocities, velocities])
        self._pressure = np.append(self._pressure, fresh)
        self._on_surface = np.append(self._on_surface, fresh.astype(np.bool_))

    def step(self) -> None:
        """Move on by 1 / `LIQUID_HZ`, to where the bodies are now, and push them.

        What the liquid does to a body stands in MuJoCo's `xfrc_applied` until the next step.
        """
        if not len(self.positions):
            return
        self._find_walls()
        before = self.positions.copy()
        if self._sane():
            self._advance()
        if not self._sane():
            self.diverged = True
            self.positions, self.velocities[:] = before, 0.0
            self._impulse[:] = 0.0
        self._push_bodies()

    def _sane(self) -> bool:
        """Tell whether all is in motion as liquid on a bench can be; a speed may be no number."""
        return not self.diverged and bool(np.abs(self.velocities).max() < _FASTEST)

    def _advance(self) -> None:
        advance(
            self.positions,
            self.velocities,
            self._pressure,
            self._glass,
            self._shapes,
            self._flow,
            self._impulse,
            self._on_surface,
        )

    def _find_walls(self) -> None:
        """Read where the walls are now, and remember where they were."""
        data = self._data
        for walls in (self._glass, self._shapes):
            walls.old_origin[:], walls.old_rotation[:] = walls.origin, walls.rotation
        self._glass.origin[:] = data.xpos[self._bodies]
        self._glass.rotation[:] = data.xmat[self._bodies].reshape(-1, 3, 3)
        self._shapes.origin[:], self._shapes.rotation[:] = self._shape_frames()

    def _shape_frames(self) -> tuple[FloatArray, FloatArray]:
        rotation = self._data.geom_xmat[self._geoms].reshape(-1, 3, 3)
        offset = np.einsum("sij,sj->si", rotation, self._centres)
        return self._data.geom_xpos[self._geoms] + offset, rotation

    def _push_bodies(self) -> None:
        applied = self._data.xfrc_applied
        applied[self._owners[self._movable]] = 0.0
        # Newton's third law: minus what the bodies gave to the particles.
        wrench = -self.substance.density * self.volume * LIQUID_HZ * self._impulse[self._movable]
        bodies = self._owners[self._movable]
        force, moment = wrench[:, :3], wrench[:, 3:]
        moment = moment - np.cross(self._data.xipos[bodies], force)
        np.add.at(applied, bodies, np.hstack([force, moment]))

    def counts(self) -> tuple[NDArray[np.int64], int]:
        """Return the number of particles in each vessel, shape (vessels,), and on other things.

        The rest is on its way.
        """
        places = whereabouts(self.positions, self._glass, self._inner)
        inside = np.bincount(places[places >= 0], minlength=len(self.vessels))
        return inside, int(np.count_nonzero(self._on_surface & (places < 0)))

    def volumes(self) -> Volumes:
        """Return where the liquid is."""
        inside, spilled = self.counts()
        names = [vessel.name for vessel in self.vessels]
        return Volumes(
            total=self._particles * self.volume,
            inside={
                name: int(count) * self.volume
                for name, count in (*zip(names, inside, strict=True), *self._waiting.items())
            },
            spilled=spilled * self.volume,
            sources=self._sources,
        )

    def state(self) -> FloatArray:
        """Return all that the next step depends on beside MuJoCo's state, shape (2 + 8 n,)."""
        return np.concatenate(
            [
                [len(self.positions), self.diverged, *self._waiting.values()],
                self.positions.ravel(),
                self.velocities.ravel(),
                self._pressure,
                self._on_surface,
            ]
        )

    def restore(self, state: FloatArray) -> None:
        """Go back to what `state` returned; MuJoCo's state must have been restored before."""
        count, bottles = int(state[0]), len(self._waiting)
        waiting, rest = np.split(state[2:], [bottles])
        self._waiting = dict(zip(self._waiting, waiting.astype(int).tolist(), strict=True))
        positions, velocities, rest = np.split(rest, [3 * count, 6 * count])
        self._start(positions.reshape(-1, 3).copy())
        self.velocities[:] = velocities.reshape(-1, 3)
        self._pressure[:], self._on_surface[:] = rest.reshape(2, -1)
        self.diverged = bool(state[1])


def _solid_geoms(model: mujoco.MjModel, vessels: set[int]) -> NDArray[np.intp]:
    """Return the geoms that liquid runs off: all that things collide with but the vessels'."""
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    return np.flatnonzero(solid & ~np.isin(model.geom_bodyid, list(vessels)))


def _glass(vessels: Sequence[Fillable], edges: Sequence[FloatArray]) -> Glass:
    heights = np.array([vessel.profile.height for vessel in vessels])
    widest = np.array([max(r for r, _ in vessel.profile.outer) for vessel in vessels])
    return Glass(
        np.vstack([np.empty((0, EDGE_NUMBERS)), *edges]),
        np.cumsum([0, *(len(part) for part in edges)]),
        heights / 2,
        np.hypot(heights / 2, widest),
        *_frames(len(vessels)),
        *_frames(len(vessels)),
    )


def _shapes(model: mujoco.MjModel, geoms: NDArray[np.intp]) -> Shapes:
    """Describe geoms; a mesh is the box around it."""
    kinds = [_KINDS.get(mujoco.mjtGeom(kind), BOX) for kind in model.geom_type[geoms]]
    boxed = np.isin(model.geom_type[geoms], [int(kind) for kind in _KINDS], invert=True)
    size = np.where(boxed[:, None], model.geom_aabb[geoms, 3:], model.geom_size[geoms])
    radius = np.linalg.norm(size, axis=1)
    radius[np.array(kinds) == CAPSULE] = size[np.array(kinds) == CAPSULE, :2].sum(axis=1)
    radius[np.array(kinds) == PLANE] = _ENDLESS
    return Shapes(
        np.array(kinds, dtype=np.int64), size, radius, *_frames(len(geoms)), *_frames(len(geoms))
    )


def _frames(count: int) -> tuple[FloatArray, FloatArray]:
    return np.zeros((count, 3)), np.tile(np.eye(3), (count, 1, 1))
