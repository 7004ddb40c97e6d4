"""The liquid of a scene, between MuJoCo and the particles."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.kept_answers import KeptAnswers
from labutopia_lerobot.kernel import announce_compiling
from labutopia_lerobot.liquids.account import (
    mean_speeds,
    stirring,
    tally,
    transfers,
    whereabouts,
)
from labutopia_lerobot.liquids.beginning import Beginning
from labutopia_lerobot.liquids.bottled import Bottles
from labutopia_lerobot.liquids.kept import Kept, is_column
from labutopia_lerobot.liquids.lattice import lattice
from labutopia_lerobot.liquids.outflow import stream
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.solver.advance import NOTHING, advance
from labutopia_lerobot.liquids.solver.flow import Mixing
from labutopia_lerobot.liquids.surroundings import Carrier, Surroundings
from labutopia_lerobot.liquids.temperature import capacities
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.substances.filling import Dispenser, Fillable, Filling, Intake
from labutopia_lerobot.world import FloatArray, LiquidAccount, Pose, Solution

_SETTLE_STEPS = 120
"""Steps in which a new filling comes to rest, the vessels standing still."""

_SETTLE_DAMPING = 0.9
_FASTEST = 50.0
"""Speed [m/s] that no liquid on a bench has: beyond it the solver has diverged."""


class Liquid:
    """Particles of one or several substances among the vessels and shapes of a model.

    Args:
        model: The compiled scene.
        data: Its state; the walls are where it says at every step.
        vessels: All that can hold it: vessels, bottles that it comes from, pipettes, drains.
        fillings: Everything that is to be filled in: what it is, and how much of it in all.
        particles: Number of particles.
        robot: What can carry vessels, if anything.
        answers: Of a language model, which decide what may form; None for the rules.

    Attributes:
        vessels: Those that liquid flows among: neither bottles, pipettes nor drains.
        substances: All that there are, each once.
        volume: Of a particle [m^3].
        around: What it is among.
        positions: Shape (n, 3), metres, world frame; none before `fill`.
        velocities: Shape (n, 3), m/s, world frame.
        names: Of all vessels, bottles, pipettes and drains.
        bottles: What waits in squeeze bottles.
        solutions: All that is dissolved; None where nothing is.
        kept: What stands in narrow tubes; `positions` and all other arrays are without it.
        accounted: Which of `names` each particle was in at the last account, shape (n,); -1 none.
        stirring: How fast what is in each of `names` moved within it at the last account [m/s].
        evaporated: How many particles have left as vapour since the fill.
        diverged: Whether the solver has failed; the particles then stay where they are.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        vessels: Sequence[Fillable | Dispenser | Intake],
        fillings: Sequence[Filling],
        particles: int = PARTICLES,
        robot: Carrier | None = None,
        answers: KeptAnswers | None = None,
    ) -> None:
        announce_compiling()
        bottles = [vessel for vessel in vessels if isinstance(vessel, Dispenser)]
        self.vessels = tuple(vessel for vessel in vessels if isinstance(vessel, Fillable))
        pipettes = [vessel for vessel in vessels if isinstance(vessel, Intake)]
        self.names = tuple(vessel.name for vessel in (*self.vessels, *bottles, *pipettes))
        volume = sum(filling.ml for filling in fillings) * 1e-6
        self.volume = volume / particles
        self._particles = particles
        self.bottles = Bottles([bottle.name for bottle in bottles], self.volume)
        self._beginning = Beginning(fillings, self.names, self.volume, answers)
        self.substances, self.solutions = self._beginning.substances, self._beginning.solutions
        self.kept = Kept(self._beginning.nothing)
        self._keeps = bool(pipettes) or any(is_column(vessel) for vessel in self.vessels)
        depths = [v.profile.depth(volume) for v in self.vessels if not is_column(v)]
        self._mixing = Mixing(self.substances, self.volume, max(depths, default=0.0))
        self.around = Surroundings(model, data, self.vessels, robot)
        self._impulse = np.zeros((self.around.owners, 6))
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
    def origins(self) -> NDArray[np.int64]:
        """Which of `names` held each particle at the fill, shape (n,); -1 none."""
        return self._what.origins

    @property
    def temperatures(self) -> FloatArray:
        """Of each particle, shape (n,), K; processes change it in place."""
        return self._what.temperatures

    @property
    def what(self) -> Portion:
        """What the particles in motion are; processes change temperatures and contents in place."""
        return self._what

    @property
    def amounts(self) -> FloatArray:
        """Part of each particle that is each substance, by volume, shape (n, substances).

        A copy; to set it changes what the particles are made of, and with that how they flow.
        """
        return self._what.amounts.copy()

    @amounts.setter
    def amounts(self, amounts: FloatArray) -> None:
        self._be(self._what._replace(amounts=np.array(amounts)))

    def _be(self, what: Portion) -> None:
        """Let the particles in motion be made of something."""
        self._what = what
        self.weigh()

    def weigh(self) -> None:
        """Let the particles in motion weigh what they hold by now."""
        self._matter = self._mixing.matter(self._what.amounts, self.solute_masses(self._what))

    def solute_masses(self, what: Portion) -> FloatArray | float:
        """Return by how much what is dissolved makes particles heavier, shape (m,) or 0 [kg]."""
        return 0.0 if self.solutions is None else self.solutions.masses(what.contents)

    def empty(self) -> None:
        """Take all liquid away."""
        self.bottles.empty()
        self.kept.empty()
        if self.solutions is not None:
            self.solutions.empty()
        self._start(np.empty((0, 3)), self._beginning.nothing)

    def _start(self, positions: FloatArray, what: Portion) -> None:
        self.positions = positions
        self.velocities = np.zeros_like(positions)
        self.diverged, self.evaporated = False, 0
        self._be(what)
        self.accounted: NDArray[np.int64] = np.full(len(positions), -1)
        self.stirring: FloatArray = np.zeros(len(self.names))
        self._pressure: FloatArray = np.zeros(len(positions))
        self._touching: NDArray[np.int64] = np.full(len(positions), NOTHING)
        self._impulse[:] = 0.0
        self.around.move()
        self.around.move()

    def fill(
        self, contents: Mapping[Fillable | Dispenser, Filling], rng: np.random.Generator
    ) -> None:
        """Fill vessels, where they are and as they stand, and let the liquid come to rest in them.

        What there was before is taken away. Squeeze bottles and burettes keep theirs until let out.

        Args:
            contents: What each vessel holds; together they are all the liquid there is.
            rng: Where the particles' disorder comes from.
        """
        self.empty()
        total = sum(filling.volume for filling in contents.values())
        heaps, held, last = [np.empty((0, 3))], list[tuple[int, Filling]](), 0.0
        for vessel, filling in contents.items():
            first, last = last, last + filling.volume
            self._beginning.warm(self.names.index(vessel.name), filling.celsius)
            counts = [round(volume / total * self._particles) for volume in (first, last)]
            share = counts[1] - counts[0]
            if isinstance(vessel, Dispenser):
                self.bottles.fill(vessel.name, filling, share)
                continue
            index = self.vessels.index(vessel)
            if is_column(vessel):
                self.kept.add(index, self._beginning.fresh([(index, filling)] * share))
                continue
            local = lattice(vessel.profile, share, self._mixing.flow.spacing, rng)
            origin, rotation = self.around.glass.now
            heaps.append(origin[index] + local @ rotation[index].T)
            held += [(index, filling)] * share
        self.bottles.start()
        self._start(np.vstack(heaps), self._beginning.fresh(held))
        for _ in range(_SETTLE_STEPS if len(self.positions) else 0):
            self._advance()
            self.velocities *= _SETTLE_DAMPING
        self._beginning.strew(self._what, self.positions[:, 2], held)
        self.weigh()

    def dispense(self, bottle: Dispenser, volume: float, spout: Pose, duration: float) -> None:
        """Let out of a bottle what its wall displaces, as fast as the spout lets it through.

        Args:
            bottle: What it leaves.
            volume: What the wall has displaced since the start, all in all [m^3].
            spout: End of the spout; z the way that the liquid leaves.
            duration: Time since the previous call [s].
        """
        count, speed = self.bottles.let_out(bottle, volume, duration)
        if count:
            velocity = speed * spout.z_axis
            ages = duration * (np.arange(count)[:, None] + 0.5) / count
            bore = bottle.bore_area
            places = stream(spout, velocity, ages, self.spacing, self.around, bore)
            held, origin = self.bottles.held[bottle.name], self.names.index(bottle.name)
            self.release(places, np.tile(velocity, (count, 1)), held, origin)

    def release(
        self,
        positions: FloatArray,
        velocities: FloatArray,
        of: Filling | None = None,
        origin: int = -1,
    ) -> None:
        """Add particles, as from a spout.

        Args:
            positions: Shape (m, 3), metres, world frame, none in glass.
            velocities: Shape (m, 3), m/s, world frame.
            of: What they are, whatever its volume; the first of the fillings if not said.
            origin: Which of `names` they come from; -1 none.
        """
        held = [(origin, of or self._beginning.fillings[0])] * len(positions)
        self.add(positions, velocities, self._beginning.fresh(held))

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
        self._be(self._what.with_more(portion))
        self.accounted = np.append(self.accounted, np.full(count, -1))
        self._pressure = np.append(self._pressure, np.zeros(count))
        self._touching = np.append(self._touching, np.full(count, NOTHING))

    def take(self, which: NDArray[np.intp]) -> Portion:
        """Take particles away, by their indices, and return what they are."""
        taken = self._what.part(which)
        self.positions = np.delete(self.positions, which, axis=0)
        self.velocities = np.delete(self.velocities, which, axis=0)
        self._be(self._what.without(which))
        self.accounted = np.delete(self.accounted, which)
        self._pressure = np.delete(self._pressure, which)
        self._touching = np.delete(self._touching, which)
        return taken

    def over_bottoms(self) -> FloatArray:
        """Return how high particles are for crystals, as `Surroundings.over_bottoms` has it."""
        return self.around.over_bottoms(self.positions, self.accounted)

    def inside(self) -> NDArray[np.int64]:
        """Return which of `names` each particle is in, shape (n,); -1 none."""
        return self.vessels_at(self.positions)

    def vessels_at(self, points_w: FloatArray) -> NDArray[np.int64]:
        """Return which of `names` points are in, shape (m, 3) [m], shape (m,); -1 none."""
        around = self.around
        return whereabouts(points_w, around.glass, around.inner, around.smallest_first)

    def solution(self, vessel: int) -> Solution:
        """Return what is in a vessel, bottle or pipette, by its index in `names`."""
        what = self._what.part(np.flatnonzero(self.accounted == vessel))
        if self._keeps:
            kept = np.flatnonzero(self.kept.holders == vessel)
            what = what.with_more(self.kept.portion.part(kept))
        if waiting := self.bottles.waiting.get(self.names[vessel], 0):
            held = vessel, self.bottles.held[self.names[vessel]]
            what = what.with_more(self._beginning.fresh([held] * waiting))
        weights = capacities(what.amounts, self.substances, self.volume)
        if self.solutions is None:
            return self._beginning.plain.solution(what, weights)
        return self.solutions.solution(vessel, what, weights)

    def step(self) -> None:
        """Move on by 1 / `hertz`, to where the bodies are now, and push them.

        What the liquid does to a body stands in MuJoCo's `xfrc_applied` until the next step.
        """
        if not len(self.positions):
            if self._keeps or self.bottles.held:  # what comes next must find the walls here
                self.around.move()
                self._impulse[:] = 0.0
                self.around.push(self._impulse)
            return
        self.around.move()
        before = self.positions.copy()
        if self._sane():
            self._advance()
        if not self._sane():
            self.diverged = True
            self.positions, self.velocities[:] = before, 0.0
            self._impulse[:] = 0.0
        # Newton's third law: minus what the bodies gave to the particles.
        self.around.push(-self._mixing.density * self.volume * self.hertz * self._impulse)

    def _sane(self) -> bool:
        """Return whether all is in motion as liquid on a bench can be; a speed may be no number."""
        return not self.diverged and bool(np.abs(self.velocities).max() < _FASTEST)

    def _advance(self) -> None:
        advance(
            self.positions,
            self.velocities,
            self._pressure,
            self._matter,
            self.around.glass,
            self.around.shapes,
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
        held = np.append(self._what.last_held, kept.portion.last_held)
        touching = np.append(self._touching, np.full(len(kept.holders), NOTHING))
        counts = tally(count, origins, places, touching, self.around.standing)
        for name, waiting in self.bottles.waiting.items():
            bottle = self.names.index(name)
            counts[bottle, bottle] += waiting
        moves = transfers(count, held, places)
        last = np.where(inside >= 0, inside, self._what.last_held)
        self._what = self._what._replace(last_held=last)
        self.accounted, self.stirring = inside, stirring(count, self.velocities, inside)
        kept.remember(kept.holders)
        speeds = mean_speeds(count, self.velocities, inside)
        return LiquidAccount(self.names, counts, moves, speeds, self.volume, self.evaporated)

    def warm_to(self, temperature: float) -> None:
        """Bring all liquid, and what comes later, to where it begins in a room so warm [K]."""
        self._beginning.room = temperature
        self.temperatures[:] = self._beginning.temperatures(self.origins)
        kept = self.kept.portion
        kept.temperatures[:] = self._beginning.temperatures(kept.origins)

    def state(self) -> FloatArray:
        """Return all that the next step depends on beside MuJoCo's state.

        Shape (3 + bottles + (11 + substances + species) n,), after what is kept where anything can
        be, and `Solutions.state` where anything is dissolved.
        """
        kept = [self.kept.state()] if self._keeps else []
        solutions = [] if self.solutions is None else [self.solutions.state()]
        return np.concatenate(
            [
                *kept,
                *solutions,
                [len(self.positions), self.diverged, self.evaporated],
                list(self.bottles.waiting.values()),
                self.positions.ravel(),
                self.velocities.ravel(),
                self._pressure,
                self._touching,
                self._what.numbers(),
            ]
        )

    def restore(self, state: FloatArray) -> None:
        """Go back to what `state` returned; MuJoCo's state must have been restored before."""
        if self._keeps:
            state = self.kept.restore(state)
        if self.solutions is not None:
            state = self.solutions.restore(state)
        count, bottles = int(state[0]), len(self.bottles.waiting)
        waiting, rest = np.split(state[3:], [bottles])
        self.bottles.restore(waiting)
        positions, velocities, rest = np.split(rest, [3 * count, 6 * count])
        pressure, touching, rest = np.split(rest, [count, 2 * count])
        what, _ = self._what.from_numbers(rest, count)
        self._start(positions.reshape(-1, 3).copy(), what)
        self.velocities[:] = velocities.reshape(-1, 3)
        self._pressure[:], self._touching[:] = pressure, touching
        self.diverged, self.evaporated = bool(state[1]), int(state[2])
