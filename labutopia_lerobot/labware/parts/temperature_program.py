"""A temperature program: which set point it is time for."""

from dataclasses import dataclass
from typing import override

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.processes.heat import CELSIUS
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class TemperatureProgram(Process):
    """What a cycler is to hold now: first one temperature, then a cycle of others, again and again.

    Attributes:
        name: What its reading is called [degrees C].
        timer: Name of the reading of what is left of the program [s]; 0 while it does not run.
        lasts: How long the program lasts [s].
        first: The first temperature [degrees C], and for how long [s].
        cycle: The others, in order.
    """

    name: str
    timer: str
    lasts: float
    first: tuple[float, float]
    cycle: tuple[tuple[float, float], ...]

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        since = self.lasts - apparatus.reading(self.timer).value - self.first[1]
        if since < 0.0:
            return Reading(self.first[0], CELSIUS)
        since %= sum(seconds for _, seconds in self.cycle)
        for celsius, seconds in self.cycle:
            since -= seconds
            if since < 0.0:
                return Reading(celsius, CELSIUS)
        return Reading(self.cycle[-1][0], CELSIUS)
