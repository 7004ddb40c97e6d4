"""A temperature probe that is kept in a vessel."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes.heat import CELSIUS
from labutopia_lerobot.processes.process import Apparatus, Process
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class Probe(Process):
    """What a probe in a vessel reads: the liquid there, or else the wall, with a lag.

    The probe itself is not built: it would be a sensor of a few grams that sends what it reads.

    Attributes:
        name: What its reading is called.
        vessel: Name of the vessel.
        lag: Its time constant [s]; ours: a Pt1000 in a thin sheath takes seconds in water.
        resolution: Step of the last digit [K].
    """

    name: str
    vessel: str
    lag: float = 2.0
    resolution: float = 0.1

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("sensed", "begun")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, now = apparatus.memory(self), self._now(apparatus)
        share = -math.expm1(-apparatus.period / self.lag) if memory[1] else 1.0
        memory[:] = memory[0] + share * (now - memory[0]), 1.0

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        sensed, begun = apparatus.memory(self)
        value = float(sensed) if begun else self._now(apparatus)
        return Reading(value, CELSIUS, self.resolution)

    def _now(self, apparatus: Apparatus) -> float:
        return apparatus.reading(f"{self.vessel}_temperature").value
