"""Account of the liquid of a scene: its place and its origin."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError


class UnknownVesselError(UserError, LookupError):
    """A predicate or skill asks for a vessel that is not in the scene; the message lists those."""


@dataclass(frozen=True, eq=False)
class LiquidAccount:
    """Account of the liquid of a scene by the vessel it was filled into, at one control step.

    Every particle is counted once, and every volume is a number of particles times the volume of
    one: inside vessels, spilled, clinging and in flight are all of it, exactly.

    Attributes:
        vessels: Names of all vessels, bottles, pipettes and drains. Any of them may be an origin:
            what held a particle when the scene was filled.
        counts: Particles by origin, after the vessels none, and by place: inside each vessel, then
            spilled, clinging, in flight; shape (vessels + 1, vessels + 3).
        moves: Particles that since the previous control step have arrived in a vessel (column)
            after another one had been the last to hold them (row), shape (vessels, vessels).
        speeds: Mean speed of the particles inside each vessel [m/s], shape (vessels,); 0 for none.
        particle_volume: Of each [m^3].
        vapour: Particles that have left as vapour since the fill; they are in none of `counts`.
    """

    vessels: tuple[str, ...]
    counts: NDArray[np.int64]
    moves: NDArray[np.int64]
    speeds: NDArray[np.float64]
    particle_volume: float
    vapour: int = 0

    @property
    def evaporated(self) -> float:
        """Volume that has left as vapour since the fill [m^3]."""
        return self.vapour * self.particle_volume

    @property
    def total(self) -> float:
        """All of it that is still there [m^3]."""
        return self._volume(self.counts)

    @property
    def inside(self) -> Mapping[str, float]:
        """Volume in each vessel, by its name, wherever it came from [m^3]."""
        return {name: self._volume(self.counts[:, v]) for v, name in enumerate(self.vessels)}

    @property
    def retained(self) -> float:
        """Volume in the vessels that it was filled into [m^3]."""
        return self._volume(np.diagonal(self.counts[:-1]))

    @property
    def poured(self) -> float:
        """Volume in other vessels than it was filled into [m^3]."""
        elsewhere = self.counts[:, :-3].copy()
        np.fill_diagonal(elsewhere, 0)
        return self._volume(elsewhere)

    @property
    def spilled(self) -> float:
        """Volume in no vessel, on what stands: bench, floor, plate, outside of a vessel [m^3]."""
        return self._volume(self.counts[:, -3])

    @property
    def clinging(self) -> float:
        """Volume in no vessel, and on the robot, on what it holds or on what falls [m^3]."""
        return self._volume(self.counts[:, -2])

    @property
    def in_flight(self) -> float:
        """Volume in no vessel, and touching nothing [m^3]."""
        return self._volume(self.counts[:, -1])

    @property
    def transfers(self) -> Mapping[tuple[str, str], float]:
        """Volumes moved since the previous control step, by (from, to) [m^3]; no zeros."""
        return {
            (self.vessels[a], self.vessels[b]): int(self.moves[a, b]) * self.particle_volume
            for a, b in np.argwhere(self.moves).tolist()
        }

    @property
    def millilitres(self) -> dict[str, float]:
        """The total and its five parts as `info` has them [ml]."""
        names = ("total", "poured", "retained", "spilled", "clinging", "in_flight")
        return {f"ml_{name}": round(1e6 * float(getattr(self, name)), 6) for name in names}

    def originated_in(self, vessel: str) -> float:
        """Return all that was filled into a vessel, wherever it is [m^3]."""
        return self._volume(self.counts[self._index(vessel)])

    def from_in(self, origin: str, vessel: str) -> float:
        """Return what was filled into one vessel and is inside another, or the same one [m^3]."""
        return self._volume(self.counts[self._index(origin), self._index(vessel)])

    def elsewhere(self, allowed: Collection[tuple[str, str]]) -> Mapping[str, float]:
        """Return what is in vessels that it was neither filled into nor is allowed to get into.

        Args:
            allowed: Pairs of an origin and a vessel.

        Returns:
            Origin -> volume [m^3], of every vessel and bottle.
        """
        own = np.eye(len(self.vessels), dtype=bool)
        for origin, vessel in allowed:
            own[self._index(origin), self._index(vessel)] = True
        astray = np.where(own, 0, self.counts[:-1, :-3])
        return {name: self._volume(astray[v]) for v, name in enumerate(self.vessels)}

    def spilled_from(self, origin: str) -> float:
        """Return what was filled into a vessel and is spilled [m^3]."""
        return self._volume(self.counts[self._index(origin), -3])

    def speed_in(self, vessel: str) -> float:
        """Return how fast what is inside a vessel moves, on the average [m/s]."""
        return float(self.speeds[self._index(vessel)])

    def _index(self, vessel: str) -> int:
        if vessel not in self.vessels:
            raise UnknownVesselError(
                f"A predicate or a skill asks for the liquid of '{vessel}', which holds none. Put "
                f"it into the `start` of the task. Vessels there: {', '.join(self.vessels)}"
            )
        return self.vessels.index(vessel)

    def _volume(self, counts: NDArray[np.int64]) -> float:
        return int(counts.sum()) * self.particle_volume
