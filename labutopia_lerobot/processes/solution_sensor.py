"""Sensors in solutions: a number with a lag and some noise, and when it counts as settled."""

import math
from abc import ABC, abstractmethod
from typing import ClassVar, override

import numpy as np

from labutopia_lerobot.processes.process import Apparatus, Process
from labutopia_lerobot.world import Reading

_RENEWED = 6
"""Control steps between two measurements: five a second; ours, as of balances."""
_NOISE = 0.3
"""Standard deviation of a settled reading, in steps of the last digit; ours: makers state a
repeatability of one step of the last digit for meters that show 0.01 of pH."""
_BAND, _STEADY_FOR = 2.5, 3.0
"""Half width of the band, in steps of the last digit, in which a reading must stay, and for how
long [s], before it counts as settled; ours: makers let 0.01 to 0.02 of pH pass in some seconds."""


class SolutionSensor(Process, ABC):
    """What a sensor reads of a solution; dashes where there is none, or nothing is known of it.

    A frozen dataclass, which says what it senses.

    Attributes:
        name: What its reading is called.
        lag: Its time constant [s].
        resolution: Step of the last digit.
        unit: Of the reading.
        most: The greatest number that it shows.
    """

    name: str
    lag: float
    resolution: float
    unit: ClassVar[str]
    most: ClassVar[float] = math.inf

    @abstractmethod
    def sensed(self, apparatus: Apparatus) -> float:
        """Return what there is to be read now, without lag or noise; not a number for nothing."""

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("sensed", "wet", "noise", "band", "steady", "seed", "steps")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with what there is, settled."""
        now = self.sensed(apparatus)
        wet = not math.isnan(now)
        sensed = now if wet else 0.0
        seed = rng.integers(2**31)
        apparatus.memory(self)[:] = sensed, wet, 0.0, sensed, _STEADY_FOR, seed, 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        sensed, was_wet, noise, band, steady, seed, steps = memory
        memory[-1] = steps + 1
        if steps % _RENEWED:
            return
        now, passed = self.sensed(apparatus), _RENEWED * apparatus.period
        if math.isnan(now):
            memory[1] = 0.0
            return
        share = -math.expm1(-passed / self.lag) if was_wet else 1.0
        sensed += share * (now - sensed)
        drawn = np.random.Generator(np.random.Philox(key=int(seed), counter=int(steps) // _RENEWED))
        noise = _NOISE * self.resolution * drawn.standard_normal()
        stays = was_wet and abs(sensed + noise - band) <= _BAND * self.resolution
        band, steady = (band, steady + passed) if stays else (sensed + noise, 0.0)
        memory[:-2] = sensed, 1.0, noise, band, steady

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        sensed, wet, noise, _, steady, *_ = apparatus.memory(self)
        if not wet:
            return Reading(math.nan, self.unit, self.resolution, settled=False)
        value = float(sensed + noise)
        settled = bool(steady >= _STEADY_FOR)
        return Reading(
            value if value <= self.most else math.inf, self.unit, self.resolution, settled
        )
