"""The liquid of a scene, between MuJoCo and the particles."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import announce_compiling
from labutopia_lerobot.liquids.account import mean_speeds, tally, transfers, whereabouts
from labutopia_lerobot.liquids.kept import Kept, Portion, is_column
from labutopia_lerobot.liquids.lattice import lattice
from labutopia_lerobot.liquids.solver.advance import NOTHING, advance
from labutopia_lerobot.liquids.solver.flow import Mixing
from labutopia_lerobot.liquids.surroundings import Surroundings
from labutopia_lerobot.processes import AMBIENT
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.substances.filling import Dispenser, Fillable, Filling, Intake
from labutopia_lerobot.substances.substance import ZERO_C, Substance
from labutopia_lerobot.world import FloatArray, LiquidAccount, Pose

_SETTLE_STEPS = 120
"""Steps in which a new filling comes to rest, the vessels standing still."""

_SETTLE_DAMPING = 0.9
_FASTEST = 50.0
"""Speed [m/s] that no liquid on a bench has: beyond it the solver has diverged."""

_JET_SPEED = 2.0
"""Fastest that liquid leaves a spout [m/s]: what 2 kPa, a squeeze by hand, drive out of it."""


class Liquid:
    """Particles of one or several substances among the vessels and shapes of a model.

    Args:
        model: The compiled scene.
        data: Its state; the walls are where it says at every step.
        vessels: All that can hold the liquid: vessels, bottles that it comes from, pipettes.
        fillings: Everything that is to be filled in: what it is, and how much of it in all.
        particles: Number of particles.
        robot: Root body of what can carry vessels, if anything.

    Attributes:
        vessels: Those that liquid flows among: neither bottles nor pipettes.
        substances: All that there are, each once.
        volume: Of a particle [m^3].
        positions: Shape (n, 3), metres, world frame; none before `fill`.
        velocities: Shape (n, 3), m/s, world frame.
        origins: Which of `names` held each particle at the fill, shape (n,); -1 none.
        names: Of all vessels, bottles and pipettes.
        kept: What stands in narrow tubes; `positions` and all other arrays are without it.
        temperatures: Of each particle, shape (n,), K.
        accounted: Which of `names` each particle was in at the last account, shape (n,); -1 none.
        speeds: Mean speed in each of `names` at the last account [m/s].
        diverged: Whether the solver has failed; the particles then stay where they are.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        vessels: Sequence[Fillable | Dispenser | Intake],
        fillings: Sequence[Filling],
        particles: int = PARTICLES,
        robot: int | None = None,
    ) -> None:
        announce_compiling()
        bottles = [vessel for vessel in vessels if isinstance(vessel, Dispenser)]
        self.vessels = tuple(vessel for vessel in vessels if isinstance(vessel, Fillable))
        pipettes = [vessel for vessel in vessels if isinstance(vessel, Intake)]
        self.names = tuple(vessel.name for vessel in (*self.vessels, *bottles, *pipettes))
        self.substances = tuple(dict.fromkeys(filling.substance for filling in fillings))
        volume = sum(filling.ml for filling in fillings) * 1e-6
        self.volume = volume / particles
        self._particles = particles
        self._waiting = {bottle.name: 0 for bottle in bottles}
        self._waiting_at_start = dict(self._waiting)
        self._room = AMBIENT
        self._own = np.full(len(self.names), np.nan)
        self._held = dict.fromkeys(self._waiting, self.substances[0])
        columns = [vessel for vessel in self.vessels if is_column(vessel)]
        self.kept = Kept(len(self.substances))
        self._keeps = bool(columns or pipettes)
        depths = [v.profile.depth(volume) for v in self.vessels if v not in columns]
        self._mixing = Mixing(self.substances, self.volume, max(depths, default=0.0))
        self._around = Surroundings(model, data, self.vessels, robot)
        self._impulse = np.zeros((self._around.owners, 6))
        self.empty()

    @property
    def hertz(self) -> int:
        """Steps per second."""
        return self._mixing.flow.hertz

    @property
    def spacing(self) -> float:
        """Edge of the cube that a particle's volume fills [m]."""
        return self._mixing.flow.spacing

    @property
    def amounts(self) -> FloatArray:
        """Part of each particle that is each substance, by volume, shape (n, substances).

        A copy; to set it changes what the particles are made of, and with that how they flow.
        """
        return self._amounts.copy()

    @amounts.setter
    def amounts(self, amounts: FloatArray) -> None:
        self._amounts = np.array(amounts)
        self._matter = self._mixing.matter(self._amounts)

    def empty(self) -> None:
        """Take all liquid away."""
        self._waiting = dict.fromkeys(self._waiting, 0)
        self._waiting_at_start = dict(self._waiting)
        self.kept.empty()
        self._start(np.empty((0, 3)), np.empty(0, int), np.empty((0, len(self.substances))))

    def _start(
        self, positions: FloatArray, origins: NDArray[np.int64], amounts: FloatArray
    ) -> None:
        self.positions = positions
        self.velocities = np.zeros_like(positions)
        self.diverged = False
        self.origins = origins
        self.amounts = amounts
        self.temperatures = self._beginning(origins)
        self.accounted: NDArray[np.int64] = np.full(len(positions), -1)
        self.speeds: FloatArray = np.zeros(len(self.names))
        self._last_held: NDArray[np.int64] = origins.copy()
        self._pressure: FloatArray = np.zeros(len(positions))
        self._touching: NDArray[np.int64] = np.full(len(positions), NOTHING)
        self._impulse[:] = 0.0
        self._around.move()
        self._around.move()

    def fill(
        self, contents: Mapping[Fillable | Dispenser, Filling], rng: np.random.Generator
    ) -> None:
        """Fill vessels, where they are and as they stand, and let the liquid come to rest in them.

        What there was before is taken away. What is in a squeeze bottle waits there until it is
        dispensed, what is in a burette until it is let out.

        Args:
            contents: What each vessel holds; together they are all the liquid there is.
            rng: Where the particles' disorder comes from.
        """
        self.empty()
        total = sum(filling.volume for filling in contents.values())
        heaps, origins, kinds, last = [np.empty((0, 3))], [], [], 0.0
        for vessel, filling in contents.items():
            first, last = last, last + filling.volume
            if filling.celsius is not None:
                self._own[self.names.index(vessel.name)] = filling.celsius + ZERO_C
            counts = [round(volume / total * self._particles) for volume in (first, last)]
            share = counts[1] - counts[0]
            if isinstance(vessel, Dispenser):
                self._waiting[vessel.name] = share
                self._held[vessel.name] = filling.substance
                continue
            index = self.vessels.index(vessel)
            if is_column(vessel):
                here = np.full(share, index)
                self.kept.add(index, self._portion(here, self._pure([filling.substance] * share)))
                continue
            local = lattice(vessel.profile, share, self._mixing.flow.spacing, rng)
            origin, rotation = self._around.glass.now
            heaps.append(origin[index] + local @ rotation[index].T)
            origins += [index] * share
            kinds += [filling.substance] * share
        self.start_dispensing()
        self._start(np.vstack(heaps), np.array(origins, dtype=int), self._pure(kinds))
        for _ in range(_SETTLE_STEPS if len(self.positions) else 0):
            self._advance()
            self.velocities *= _SETTLE_DAMPING

    def _pure(self, kinds: Sequence[Substance]) -> FloatArray:
        """Return the amounts of particles of one substance each, shape (n, substances)."""
        indices = [self.substances.index(kind) for kind in kinds]
        return np.eye(len(self.substances))[indices]

    def start_dispensing(self) -> None:
        """Count from now what the walls of bottles displace."""
        self._waiting_at_start = dict(self._waiting)

    def dispense(self, bottle: Dispenser, volume: float, spout: Pose, duration: float) -> None:
        """Let out of a bottle what its wall displaces, as fast as the spout lets it through.

        Args:
            bottle: What it leaves.
            volume: What the wall has displaced since `start_dispensing`, all in all [m^3].
            spout: End of the spout; z the way that the liquid leaves.
            duration: Time since the previous call [s].
        """
        waiting = self._waiting[bottle.name]
        if not waiting:
            return
        due = volume - (self._waiting_at_start[bottle.name] - waiting) * self.volume
        passing = min(due, _JET_SPEED * bottle.bore_area * duration)
        count = min(waiting, max(int(passing / self.volume), int(due >= self.volume)))
        if not count:
            return
        self._waiting[bottle.name] = waiting - count
        velocity = passing / duration / bottle.bore_area * spout.z_axis
        ages = duration * (np.arange(count)[:, None] + 0.5) / count
        self.release(
            spout.position_w + ages * velocity,
            np.tile(velocity, (count, 1)),
            self._held[bottle.name],
            self.names.index(bottle.name),
        )

    def release(
        self,
        positions: FloatArray,
        velocities: FloatArray,
        of: Substance | None = None,
        origin: int = -1,
    ) -> None:
        """Add particles, as from a spout.

        Args:
            positions: Shape (m, 3), metres, world frame, none in glass.
            velocities: Shape (m, 3), m/s, world frame.
            of: What they are; the first of the substances if not said.
            origin: Which of `names` they come from; -1 none.
        """
        count = len(positions)
        amounts = self._pure([of or self.substances[0]] * count)
        here = np.full(count, origin)
        self.add(positions, velocities, self._portion(here, amounts))

    def _portion(self, here: NDArray[np.int64], amounts: FloatArray) -> Portion:
        """Return what particles are that come from where they are, as warm as they begin."""
        return Portion(here, here, self._beginning(here), amounts)

    def _beginning(self, origins: NDArray[np.int64]) -> FloatArray:
        """Return how warm particles begin: as their filling says, or else as the room [K]."""
        own = np.append(self._own, np.nan)[origins]  # the last is that of no origin, -1
        return np.where(np.isnan(own), self._room, own)

    def add(self, positions: FloatArray, velocities: FloatArray, portion: Portion) -> None:
        """Add particles.

        Args:
            positions: Shape (m, 3), metres, world frame, none in glass.
            velocities: Shape (m, 3), m/s, world frame.
            portion: What they are.
        """
        count = len(positions)
        self.positions = np.vstack([self.positions, positions])
        self.velocities = np.vstack([self.velocities, velocities])
        self.amounts = np.vstack([self._amounts, portion.amounts])
        self.origins = np.append(self.origins, portion.origins)
        self._last_held = np.append(self._last_held, portion.last_held)
        self.temperatures = np.append(self.temperatures, portion.temperatures)
        self.accounted = np.append(self.accounted, np.full(count, -1))
        self._pressure = np.append(self._pressure, np.zeros(count))
        self._touching = np.append(self._touching, np.full(count, NOTHING))

    def take(self, which: NDArray[np.intp]) -> Portion:
        """Take particles away, by their indices, and return what they are."""
        origins, held = self.origins[which], self._last_held[which]
        taken = Portion(origins, held, self.temperatures[which], self._amounts[which])
        self.positions = np.delete(self.positions, which, axis=0)
        self.velocities = np.delete(self.velocities, which, axis=0)
        self.amounts = np.delete(self._amounts, which, axis=0)
        self.origins = np.delete(self.origins, which)
        self._last_held = np.delete(self._last_held, which)
        self.temperatures = np.delete(self.temperatures, which)
        self.accounted = np.delete(self.accounted, which)
        self._pressure = np.delete(self._pressure, which)
        self._touching = np.delete(self._touching, which)
        return taken

    def inside(self) -> NDArray[np.int64]:
        """Return which of `names` each particle is in, shape (n,); -1 none."""
        return self.vessels_at(self.positions)

    def vessels_at(self, points_w: FloatArray) -> NDArray[np.int64]:
        """Return which of `names` points are in, shape (m, 3) [m], shape (m,); -1 none."""
        around = self._around
        return whereabouts(points_w, around.glass, around.inner, around.smallest_first)

    def column(self, vessel: int) -> tuple[float, FloatArray]:
        """Return what stands in a narrow vessel, and what of it is each substance.

        Args:
            vessel: Which of `names`; there is something in it.

        Returns:
            Volume [m^3], and parts by volume, shape (substances,).
        """
        there = self.kept.portion.amounts[self.kept.holders == vessel]
        return len(there) * self.volume, there.mean(axis=0)

    def step(self) -> None:
        """Move on by 1 / `hertz`, to where the bodies are now, and push them.

        What the liquid does to a body stands in MuJoCo's `xfrc_applied` until the next step.
        """
        if not len(self.positions):
            if self._keeps:  # what comes out next must find the walls where they are
                self._around.move()
                self._impulse[:] = 0.0
                self._around.push(self._impulse)
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
        self._around.push(-self._mixing.density * self.volume * self.hertz * self._impulse)

    def _sane(self) -> bool:
        """Return whether all is in motion as liquid on a bench can be; a speed may be no number."""
        return not self.diverged and bool(np.abs(self.velocities).max() < _FASTEST)

    def _advance(self) -> None:
        advance(
            self.positions,
            self.velocities,
            self._pressure,
            self._matter,
            self._around.glass,
            self._around.shapes,
            self._mixing.flow,
            self._impulse,
            self._touching,
        )

    def take_account(self) -> LiquidAccount:
        """Return where the liquid is; `transfers` run from the previous call to this one."""
        count, kept = len(self.names), self.kept
        inside = self.inside()
        places = np.append(inside, kept.holders)
        origins = np.append(self.origins, kept.portion.origins)
        held = np.append(self._last_held, kept.portion.last_held)
        touching = np.append(self._touching, np.full(len(kept.holders), NOTHING))
        counts = tally(count, origins, places, touching, self._around.standing)
        for name, waiting in self._waiting.items():
            bottle = self.names.index(name)
            counts[bottle, bottle] += waiting
        moves = transfers(count, held, places)
        speeds = mean_speeds(count, self.velocities, inside)
        self._last_held = np.where(inside >= 0, inside, self._last_held)
        self.accounted, self.speeds = inside, speeds
        kept.remember(kept.holders)
        return LiquidAccount(self.names, counts, moves, speeds, self.volume)

    def warm_to(self, temperature: float) -> None:
        """Bring all liquid, and what comes later, to where it begins in a room so warm [K]."""
        self._room = temperature
        self.temperatures[:] = self._beginning(self.origins)
        self.kept.portion.temperatures[:] = self._beginning(self.kept.portion.origins)

    def state(self) -> FloatArray:
        """Return all that the next step depends on beside MuJoCo's state.

        Shape (2 + bottles + (11 + substances) n,), after what is kept where anything can be.
        """
        kept = [self.kept.state()] if self._keeps else []
        return np.concatenate(
            [
                *kept,
                [len(self.positions), self.diverged, *self._waiting.values()],
                self.positions.ravel(),
                self.velocities.ravel(),
                self._pressure,
                self._touching,
                self.origins,
                self._last_held,
                self.temperatures,
                self._amounts.ravel(),
            ]
        )

    def restore(self, state: FloatArray) -> None:
        """Go back to what `state` returned; MuJoCo's state must have been restored before."""
        if self._keeps:
            state = self.kept.restore(state)
        count, bottles = int(state[0]), len(self._waiting)
        waiting, rest = np.split(state[2:], [bottles])
        self._waiting = dict(zip(self._waiting, waiting.astype(int).tolist(), strict=True))
        positions, velocities, rest, amounts = np.split(rest, [3 * count, 6 * count, 11 * count])
        pressure, touching, origins, last_held, temperatures = rest.reshape(5, -1)
        parts = amounts.reshape(-1, len(self.substances))
        self._start(positions.reshape(-1, 3).copy(), origins.astype(int), parts)
        self.velocities[:] = velocities.reshape(-1, 3)
        self._pressure[:], self._touching[:], self._last_held[:] = pressure, touching, last_held
        self.temperatures[:] = temperatures
        self.diverged = bool(state[1])
