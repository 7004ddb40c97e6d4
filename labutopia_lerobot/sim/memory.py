"""Numbers that a simulation remembers beside MuJoCo's own, as part of MuJoCo's state."""

from collections.abc import Mapping

import mujoco

from labutopia_lerobot.world import FloatArray


class Memory:
    """Named slots in `mjData.userdata`: saved, restored and reset with all the rest.

    Args:
        slots: Name -> how many numbers it holds.
    """

    def __init__(self, slots: Mapping[str, int]) -> None:
        self._places: dict[str, slice] = {}
        self.size = 0
        for name, count in slots.items():
            self._places[name] = slice(self.size, self.size + count)
            self.size += count

    def of(self, data: mujoco.MjData, name: str) -> FloatArray:
        """Return the numbers of a slot, a view into the state, shape (count,)."""
        numbers: FloatArray = data.userdata[self._places[name]]
        return numbers
