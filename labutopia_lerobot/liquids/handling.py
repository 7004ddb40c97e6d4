"""What processes do to a liquid: move it, warm it, stir it."""

from typing import override

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.outflow import stream
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.temperature import capacities, mix, warmth
from labutopia_lerobot.liquids.vortex import stir
from labutopia_lerobot.processes.liquid_handling import LiquidHandling, Pool, Stock, Warmth
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import FloatArray, Pose, Solution

_REACH = 1.0
"""How far from the next particle a point still lies in the liquid, in spacings; ours: in a lattice
it is 0.87 at most, and above a level surface it ends half a spacing over it."""

_HOLE = 1.5
"""How far from the next particle a point still lies in a hole that a pipette has just drawn, in
spacings; ours: half a spacing more, for liquid that has yet to flow in."""

_AROUND = 2.0
"""How far around a point its liquid reaches, in spacings; ours: some 30 particles, a drop of 2 ml
in a scene of 60 ml."""


class Handling(LiquidHandling):
    """What processes may do to a liquid; volumes, origins and mixtures stay as they are.

    Args:
        liquid: The liquid.
    """

    def __init__(self, liquid: Liquid) -> None:
        self._liquid = liquid

    @property
    @override
    def particle(self) -> float:
        return self._liquid.volume

    @override
    def dispense(self, bottle: Dispenser, volume: float, spout: Pose, duration: float) -> None:
        self._liquid.dispense(bottle, volume, spout, duration)

    @override
    def waiting(self, bottle: Dispenser) -> float:
        return self._liquid.bottles.waiting.get(bottle.name, 0) * self._liquid.volume

    @override
    def stock(self, vessel: str, inlet_w: FloatArray) -> Stock | None:
        liquid, holder = self._liquid, self._liquid.names.index(vessel)
        kept = np.flatnonzero(liquid.kept.holders == holder)
        if len(kept):
            return self._of(liquid.kept.portion.part(kept[:1]), len(kept))
        inside = np.flatnonzero(liquid.inside() == holder)
        if not len(inside):
            return None
        nearest = self._distances(inlet_w)[inside].argmin()
        return self._of(liquid.what.part(inside[[nearest]]), len(inside))

    @override
    def near(self, point_w: FloatArray) -> Stock | None:
        near = self._within_reach(point_w)
        if not len(near):  # there may be a hole, with liquid beside or over it
            near = self._within_reach(point_w, _HOLE)
            tops = self._liquid.positions[near, 2] + 0.5 * self._liquid.spacing
            near = near[:1] if (tops > point_w[2]).any() else near[:0]
        return self._of(self._liquid.what.part(near[:1]), len(near)) if len(near) else None

    @override
    def solution_at(self, point_w: FloatArray) -> Solution | None:
        liquid, near = self._liquid, self._within_reach(point_w, _AROUND)
        if liquid.solutions is None or not len(self._within_reach(point_w)):
            return None
        vessel = int(liquid.accounted[near[0]])
        if vessel < 0:
            return None
        near = near[liquid.accounted[near] == vessel]
        weights = self._capacities()[near]
        return liquid.solutions.solution(vessel, liquid.what.part(near), weights)

    @override
    def temperature_at(self, point_w: FloatArray) -> float | None:
        if not len(self._within_reach(point_w)):
            return None
        near = self._within_reach(point_w, _AROUND)
        weights = self._capacities()[near]
        return float(weights @ self._liquid.temperatures[near] / weights.sum())

    @override
    def gas_from(self, vessel: str) -> float:
        liquid = self._liquid
        if liquid.solutions is None:
            return 0.0
        return float(liquid.solutions.given_off[liquid.names.index(vessel)].sum())

    @override
    def drop_at(self, point_w: FloatArray) -> Solution | None:
        return self._drop(self._within_reach(point_w))

    @override
    def drop_on(self, patch: Pose, size: tuple[float, float]) -> Solution | None:
        places = (self._liquid.positions - patch.position_w) @ patch.rotation_w
        reach = 0.5 * np.array([*size, 2.0 * self._liquid.spacing])
        return self._drop(np.flatnonzero((np.abs(places) <= reach).all(axis=1)))

    def _drop(self, near: NDArray[np.intp]) -> Solution | None:
        liquid = self._liquid
        near = near[liquid.accounted[near] < 0]
        if liquid.solutions is None or not len(near):
            return None
        return liquid.solutions.drop(liquid.what.part(near), self._capacities()[near])

    @override
    def gather(self, vessel: str) -> None:
        liquid, holder = self._liquid, self._liquid.names.index(vessel)
        if len(liquid.positions):
            inside = np.flatnonzero(liquid.inside() == holder)
            if len(inside):
                liquid.kept.add(holder, liquid.take(inside))

    @override
    def let_out(
        self, vessel: str, inlet_w: FloatArray, count: int, outlet: Pose, speed: float
    ) -> int:
        liquid, holder = self._liquid, self._liquid.names.index(vessel)
        if holder >= len(liquid.vessels) or liquid.kept.count(holder):
            # A pipette gives out first what it drew in last; a burette what is lowest.
            portion = liquid.kept.take(holder, count, last=holder >= len(liquid.vessels))
        else:
            inside = np.flatnonzero(liquid.inside() == holder)
            order = np.argsort(self._distances(inlet_w)[inside], kind="stable")
            portion = liquid.take(inside[order[:count]])
        self._put(portion, outlet, speed)
        return len(portion.origins)

    @override
    def draw(self, into: str, count: int, tip_w: FloatArray) -> int:
        liquid = self._liquid
        portion = liquid.take(self._within_reach(tip_w, 2.0)[:count])
        liquid.kept.add(liquid.names.index(into), portion)
        return len(portion.origins)

    @override
    def lying_in(self, pool: Pool) -> float:
        return len(self._pooled(pool)[0]) * self._liquid.volume

    @override
    def run_down(self, into: str, count: int, pool: Pool) -> int:
        liquid = self._liquid
        if not count or into not in liquid.names:
            return 0
        pooled, places = self._pooled(pool)
        order = np.argsort(np.linalg.norm(places, axis=1), kind="stable")
        portion = liquid.take(pooled[order[:count]])
        liquid.kept.add(liquid.names.index(into), portion)
        return len(portion.origins)

    @override
    def warmth(self, vessel: str) -> Warmth | None:
        liquid = self._liquid
        held = self._held(vessel) if vessel in liquid.names else None
        if held is None or not held.any():
            return None
        own = liquid.temperatures[held]
        return warmth(liquid.amounts[held], own, liquid.substances, liquid.volume)

    @override
    def warm(self, vessel: str, heat: float) -> None:
        held = self._held(vessel)
        self._liquid.temperatures[held] += heat / self._capacities()[held].sum()

    @override
    def evaporate(self, vessel: str, count: int) -> float:
        liquid = self._liquid
        held = np.flatnonzero(self._held(vessel))
        upwards = held[np.argsort(liquid.positions[held, 2], kind="stable")]
        staying, leaving = np.split(upwards, [max(len(held) - count, min(len(held), 1))])
        if liquid.solutions is not None:
            for one in leaving:
                away = np.linalg.norm(liquid.positions[staying] - liquid.positions[one], axis=1)
                heir = staying[away.argmin()]
                liquid.what.contents[heir] += liquid.solutions.left_behind(
                    liquid.what.contents[one]
                )
        heat = float(self._capacities()[leaving] @ liquid.temperatures[leaving])
        liquid.take(leaving)
        liquid.evaporated += len(leaving)
        return heat

    @override
    def warm_to(self, temperature: float) -> None:
        self._liquid.warm_to(temperature)

    @override
    def all_at(self, temperature: float) -> bool:
        return bool((self._liquid.temperatures == temperature).all())

    @override
    def mix(self, period: float) -> None:
        liquid = self._liquid
        mix(liquid.temperatures, self._capacities(), liquid.accounted, liquid.stirring, period)

    @override
    def react(self, period: float) -> None:
        liquid = self._liquid
        if liquid.solutions is not None:
            heights = liquid.positions[:, 2]
            beds = liquid.over_bottoms() if liquid.solutions.crystals.any() else heights
            liquid.solutions.react(
                liquid.what,
                heights,
                beds,
                self._capacities(),
                liquid.accounted,
                liquid.stirring,
                period,
            )
            liquid.weigh()

    @override
    def stir(self, at: FloatArray, speed: float, radius: float, duration: float) -> None:
        liquid = self._liquid
        inside = liquid.vessels_at(np.vstack([at, liquid.positions]))
        if inside[0] >= 0 and len(liquid.positions):
            wet = inside[1:] == inside[0]
            stir(liquid.velocities, liquid.positions, wet, at, speed, radius, duration)

    @override
    def masses(self) -> tuple[FloatArray, FloatArray]:
        liquid = self._liquid
        densities = np.array([substance.density for substance in liquid.substances])
        masses = liquid.volume * liquid.amounts @ densities + liquid.solute_masses(liquid.what)
        return liquid.positions.copy(), masses

    def _held(self, vessel: str) -> NDArray[np.bool_]:
        """Return which particles a vessel held at the last account, shape (n,)."""
        liquid = self._liquid
        held: NDArray[np.bool_] = liquid.accounted == liquid.names.index(vessel)
        return held

    def _pooled(self, pool: Pool) -> tuple[NDArray[np.intp], FloatArray]:
        """Return which particles stand in a pool, the lowest first, and where in its frame [m].

        Each stands on those below: it is no higher than their level, but for the slope of the floor
        and two spacings (ours).
        """
        liquid, frame = self._liquid, pool.frame
        places = (liquid.positions - frame.position_w) @ frame.rotation_w
        there = ((places >= pool.low) & (places <= pool.high)).all(axis=1) & (liquid.accounted < 0)
        order = np.flatnonzero(there)[np.argsort(places[there, 2], kind="stable")]
        levels = np.arange(len(order)) * liquid.volume / pool.area
        over = places[order, 2] - levels > pool.rise + 2.0 * liquid.spacing
        standing = order[: over.argmax()] if over.any() else order
        return standing, places[standing]

    def _capacities(self) -> FloatArray:
        liquid = self._liquid
        return capacities(liquid.amounts, liquid.substances, liquid.volume)

    def _put(self, portion: Portion, outlet: Pose, speed: float) -> None:
        """Put particles before an outlet, one after the other."""
        count, spacing = len(portion.origins), self._liquid.spacing
        if count:
            along: FloatArray = np.multiply(spacing, np.arange(count)[:, None] + 0.5)
            positions = stream(outlet, outlet.z_axis, along, spacing, self._liquid.around)
            velocities = np.tile(speed * outlet.z_axis, (count, 1))
            self._liquid.add(positions, velocities, portion)

    def _distances(self, point_w: FloatArray) -> FloatArray:
        distances: FloatArray = np.linalg.norm(self._liquid.positions - point_w, axis=1)
        return distances

    def _within_reach(self, point_w: FloatArray, reach: float = _REACH) -> NDArray[np.intp]:
        """Return which particles are so many spacings from a point, the nearest first.

        Those behind glass are not: nothing is drawn or measured through the wall of a vessel.
        """
        distances, liquid = self._distances(point_w), self._liquid
        order = np.argsort(distances, kind="stable")
        near = order[distances[order] < reach * liquid.spacing]
        return near[liquid.around.no_glass_between(liquid.positions[near], point_w)]

    def _of(self, what: Portion, count: int) -> Stock:
        """Return a number of particles, and what the only one of a portion is made of.

        Volumes add up; viscosities mix by their logarithms, as in `solver.flow`.
        """
        kinds, amounts, volume = self._liquid.substances, what.amounts[0], self._liquid.volume
        solutes = float(np.sum(self._liquid.solute_masses(what))) / volume
        return Stock(
            count * volume,
            float(amounts @ [kind.density for kind in kinds]) + solutes,
            float(np.exp(amounts @ np.log([kind.viscosity for kind in kinds]))),
            float(amounts @ [kind.surface_tension for kind in kinds]),
        )
