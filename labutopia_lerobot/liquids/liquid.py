"""The liquid of a scene, between MuJoCo and the particles."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.account import whereabouts
from labutopia_lerobot.liquids.filling import Dispenser, Fillable, Filling
from labutopia_lerobot.liquids.lattice import lattice
from labutopia_lerobot.liquids.solver import Flow, advance
from labutopia_lerobot.liquids.surroundings import Surroundings
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.world import FloatArray, Pose, Volumes

_SETTLE_STEPS = 120
"""Steps in which a new filling comes to rest, the vessels standing still."""

_SETTLE_DAMPING = 0.9

_FASTEST = 50.0
"""Speed [m/s] that no liquid on a bench has: beyond it the solver has diverged."""

_JET_SPEED = 2.0
"""Fastest that liquid leaves a spout [m/s]: what 2 kPa, a squeeze by hand, drive out of it (half of
density times speed squared)."""


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
        depths = [vessel.profile.depth(filling.volume) for vessel in vessels]
        self._flow = Flow.of(self.substance, self.volume, max(depths, default=0.0))
        self._around = Surroundings(model, data, vessels)
        self._impulse = np.zeros((self._around.owners, 6))
        self.empty()

    @property
    def hertz(self) -> int:
        """Steps per second."""
        return self._flow.hertz

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
        self._around.move()
        self._around.move()

    def fill(
        self, contents: Mapping[Fillable | Dispenser, Filling], rng: np.random.Generator
    ) -> None:
        """Fill vessels, where they are and as they stand, and let the liquid come to rest in them.

        What is in a squeeze bottle waits there until it is dispensed.

        Args:
            contents: What each vessel holds; together they are all the liquid there is.
            rng: Where the particles' disorder comes from.
        """
        self._around.move()
        total = sum(filling.volume for filling in contents.values())
        heaps, last = [np.empty((0, 3))], 0.0
        self._waiting = {}
        for vessel, filling in contents.items():
            first, last = last, last + filling.volume
            counts = [round(volume / total * self._particles) for volume in (first, last)]
            share = counts[1] - counts[0]
            if isinstance(vessel, Dispenser):
                self._waiting[vessel.name] = share
                continue
            index = self.vessels.index(vessel)
            local = lattice(vessel.profile, share, self._flow.spacing, rng)
            origin, rotation = self._around.glass.now
            heaps.append(origin[index] + local @ rotation[index].T)
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
        """Move on by 1 / `hertz`, to where the bodies are now, and push them.

        What the liquid does to a body stands in MuJoCo's `xfrc_applied` until the next step.
        """
        if not len(self.positions):
            return
        self._around.move()
        before = self.positions.copy()
        if self._sane():
            self._advance()
        if not self._sane():
            self.diverged = True
            self.positions, self.velocities[:] = before, 0.0
            self._impulse[:] = 0.0
        # Newton's third law: minus what the bodies gave to the particles.
        self._around.push(-self.substance.density * self.volume * self.hertz * self._impulse)

    def _sane(self) -> bool:
        """Tell whether all is in motion as liquid on a bench can be; a speed may be no number."""
        return not self.diverged and bool(np.abs(self.velocities).max() < _FASTEST)

    def _advance(self) -> None:
        advance(
            self.positions,
            self.velocities,
            self._pressure,
            self._around.glass,
            self._around.shapes,
            self._flow,
            self._impulse,
            self._on_surface,
        )

    def counts(self) -> tuple[NDArray[np.int64], int]:
        """Return the number of particles in each vessel, shape (vessels,), and on other things.

        The rest is on its way.
        """
        places = whereabouts(self.positions, self._around.glass, self._around.inner)
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
