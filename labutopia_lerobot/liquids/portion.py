"""What particles are, wherever they are: the one list of all that goes with them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world import FloatArray


class Portion(NamedTuple):
    """What particles are, wherever they are: poured, dripping, in a pipette, on the bench.

    Attributes:
        origins: Where they were filled, shape (m,); -1 nowhere.
        last_held: What held them last, shape (m,); -1 nothing.
        temperatures: Of each, shape (m,), K.
        amounts: Part of each that is each substance, shape (m, substances).
        contents: What each holds of every species, shape (m, species) [mol]; no species where
            nothing is dissolved.
    """

    origins: NDArray[np.int64]
    last_held: NDArray[np.int64]
    temperatures: FloatArray
    amounts: FloatArray
    contents: FloatArray

    def part(self, which: NDArray[np.intp]) -> "Portion":
        """Return some of the particles, by their indices."""
        return Portion._make(field[which] for field in self)

    def without(self, which: NDArray[np.intp]) -> "Portion":
        """Return the other particles."""
        return Portion._make(np.delete(field, which, axis=0) for field in self)

    def with_more(self, others: "Portion") -> "Portion":
        """Return the particles, others after them."""
        return Portion._make(np.concatenate(both) for both in zip(self, others, strict=True))

    def numbers(self) -> FloatArray:
        """Return all of it, one field after the other, shape ((3 + substances + species) m,)."""
        return np.concatenate([field.ravel() for field in self]).astype(float)

    def from_numbers(self, numbers: FloatArray, count: int) -> tuple["Portion", FloatArray]:
        """Return the particles of what `numbers` returned of a portion like this one, and the rest.

        Args:
            numbers: What it returned, and anything after it.
            count: Number of the particles.
        """
        fields = []
        for like in self:
            size = count * int(np.prod(like.shape[1:], dtype=int))
            own, numbers = np.split(numbers, [size])
            fields.append(own.reshape(count, *like.shape[1:]).astype(like.dtype))
        return Portion._make(fields), numbers
