"""Particles that stand still in narrow tubes: they count, but nothing moves them."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.substances.filling import Fillable, Narrow
from labutopia_lerobot.world import FloatArray


class Kept:
    """The particles in burettes, pipettes and syringes, in the order in which they came there.

    Args:
        nothing: No particles, of the substances and species of the scene.

    Attributes:
        holders: What each is in, shape (m,).
        portion: What they are.
    """

    def __init__(self, nothing: Portion) -> None:
        self._nothing = nothing
        self.empty()

    def empty(self) -> None:
        """Take all away."""
        self.holders: NDArray[np.int64] = np.empty(0, dtype=int)
        self.portion = self._nothing

    def count(self, holder: int) -> int:
        """Return how many are in something."""
        return int((self.holders == holder).sum())

    def add(self, holder: int, portion: Portion) -> None:
        """Put particles into something, after those that are there."""
        self.holders = np.append(self.holders, np.full(len(portion.origins), holder))
        self.portion = self.portion.with_more(portion)

    def take(self, holder: int, count: int, *, last: bool) -> Portion:
        """Take particles out of something.

        Args:
            holder: What they are in.
            count: How many, at most.
            last: Whether those that came last leave first.
        """
        there = np.flatnonzero(self.holders == holder)
        chosen = there[::-1][:count] if last else there[:count]
        taken = self.portion.part(chosen)
        self.holders = np.delete(self.holders, chosen)
        self.portion = self.portion.without(chosen)
        return taken

    def remember(self, inside: NDArray[np.int64]) -> None:
        """Note that the last to hold each particle is what it is in, shape (m,)."""
        self.portion = self.portion._replace(last_held=inside.copy())

    def state(self) -> FloatArray:
        """Return all of it, shape (1 + (4 + substances + species) m,)."""
        return np.concatenate([[len(self.holders)], self.holders, self.portion.numbers()])

    def restore(self, state: FloatArray) -> FloatArray:
        """Go back to what `state` returned, and return what follows it."""
        count = int(state[0])
        holders, rest = np.split(state[1:], [count])
        self.holders = holders.astype(int)
        self.portion, rest = self._nothing.from_numbers(rest, count)
        return rest


def is_column(vessel: Fillable) -> bool:
    """Return whether what a vessel holds stands still in it as one column."""
    return isinstance(vessel, Narrow) and vessel.column
