"""What waits in bottles and behind taps, as whole particles, until it is let out."""

from collections.abc import Iterable

import numpy as np

from labutopia_lerobot.substances.filling import Dispenser, Filling
from labutopia_lerobot.world import FloatArray

_JET_SPEED = 2.0
"""Fastest that liquid leaves a spout [m/s]: what 2 kPa, a squeeze by hand, drive out of it."""


class Bottles:
    """The liquid in the bottles of a scene.

    Args:
        names: Of the bottles.
        particle: Volume of a particle [m^3].

    Attributes:
        waiting: Number of particles in each, by its name.
        held: What each holds.
    """

    def __init__(self, names: Iterable[str], particle: float) -> None:
        self._particle = particle
        self.waiting = dict.fromkeys(names, 0)
        self.held: dict[str, Filling] = {}
        self.start()

    def empty(self) -> None:
        """Take all away."""
        self.waiting = dict.fromkeys(self.waiting, 0)
        self.start()

    def fill(self, name: str, filling: Filling, count: int) -> None:
        """Put particles into one."""
        self.waiting[name], self.held[name] = count, filling

    def start(self) -> None:
        """Count from now what the walls displace."""
        self._at_start = dict(self.waiting)

    def let_out(self, bottle: Dispenser, volume: float, duration: float) -> tuple[int, float]:
        """Take particles out of one, as fast as the spout lets them through.

        Args:
            bottle: What they leave.
            volume: What the wall has displaced since `start`, all in all [m^3].
            duration: Time since the previous call [s].

        Returns:
            How many leave, and how fast [m/s].
        """
        waiting = self.waiting.get(bottle.name, 0)  # none of what only furnishes a room
        if not waiting:
            return 0, 0.0
        due = volume - (self._at_start[bottle.name] - waiting) * self._particle
        passing = min(due, _JET_SPEED * bottle.bore_area * duration)
        count = min(waiting, max(int(passing / self._particle), int(due >= self._particle)))
        self.waiting[bottle.name] = waiting - count
        return count, passing / duration / bottle.bore_area

    def restore(self, waiting: FloatArray) -> None:
        """Go back to how many particles were in each."""
        self.waiting = dict(zip(self.waiting, np.round(waiting).astype(int).tolist(), strict=True))
