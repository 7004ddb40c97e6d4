"""Particles that stand still in narrow tubes: they count, but nothing moves them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.substances.filling import Fillable, Narrow
from labutopia_lerobot.world import FloatArray


class Portion(NamedTuple):
    """What particles are, wherever they are.

    Attributes:
        origins: Where they were filled, shape (m,); -1 nowhere.
        last_held: What held them last, shape (m,); -1 nothing.
        temperatures: Of each, shape (m,), K.
        amounts: Part of each that is each substance, shape (m, substances).
    """

    origins: NDArray[np.int64]
    last_held: NDArray[np.int64]
    temperatures: FloatArray
    amounts: FloatArray


class Kept:
    """The particles in burettes, pipettes and syringes, in the order in which they came there.

    Args:
        substances: How many there are.

    Attributes:
        holders: What each is in, shape (m,).
        portion: What they are.
    """

    def __init__(self, substances: int) -> None:
        self._substances = substances
        self.empty()

    def empty(self) -> None:
        """Take all away."""
        nothing = np.empty(0, dtype=int)
        self.holders: NDArray[np.int64] = nothing
        self.portion = Portion(nothing, nothing, np.empty(0), np.empty((0, self._substances)))

    def count(self, holder: int) -> int:
        """Return how many are in something."""
        return int((self.holders == holder).sum())

    def add(self, holder: int, portion: Portion) -> None:
        """Put particles into something, after those that are there."""
        self.holders = np.append(self.holders, np.full(len(portion.origins), holder))
        old = self.portion
        self.portion = Portion(
            np.append(old.origins, portion.origins),
            np.append(old.last_held, portion.last_held),
            np.append(old.temperatures, portion.temperatures),
            np.vstack([old.amounts, portion.amounts]),
        )

    def take(self, holder: int, count: int, *, last: bool) -> Portion:
        """Take particles out of something.

        Args:
            holder: What they are in.
            count: How many, at most.
            last: Whether those that came last leave first.
        """
        there = np.flatnonzero(self.holders == holder)
        chosen = there[::-1][:count] if last else there[:count]
        origins, last_held, temperatures, amounts = self.portion
        taken = Portion(origins[chosen], last_held[chosen], temperatures[chosen], amounts[chosen])
        self.holders = np.delete(self.holders, chosen)
        self.portion = Portion(
            np.delete(origins, chosen),
            np.delete(last_held, chosen),
            np.delete(temperatures, chosen),
            np.delete(amounts, chosen, axis=0),
        )
        return taken

    def remember(self, inside: NDArray[np.int64]) -> None:
        """Note that the last to hold each particle is what it is in, shape (m,)."""
        self.portion = self.portion._replace(last_held=inside.copy())

    def state(self) -> FloatArray:
        """Return all of it, shape (1 + (4 + substances) m,)."""
        origins, last_held, temperatures, amounts = self.portion
        return np.concatenate(
            [[len(origins)], self.holders, origins, last_held, temperatures, amounts.ravel()]
        ).astype(float)

    def restore(self, state: FloatArray) -> FloatArray:
        """Go back to what `state` returned, and return what follows it."""
        count = int(state[0])
        numbers, amounts, rest = np.split(state[1:], [4 * count, (4 + self._substances) * count])
        holders, origins, last_held, temperatures = numbers.reshape(4, -1)
        self.holders = holders.astype(int)
        parts = amounts.reshape(-1, self._substances).copy()
        self.portion = Portion(
            origins.astype(int), last_held.astype(int), temperatures.copy(), parts
        )
        return rest


def is_column(vessel: Fillable) -> bool:
    """Return whether what a vessel holds stands still in it as one column."""
    return isinstance(vessel, Narrow) and vessel.column
