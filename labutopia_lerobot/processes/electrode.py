"""Electrodes: what a sensor whose tip lies in a solution reads there."""

import math
from dataclasses import dataclass
from typing import override

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


@dataclass(frozen=True)
class PhElectrode(Process):
    """The pH of the liquid around the tip of an electrode; dashes where that is in no solution.

    It measures what is there, mixed or not: before a vessel has been stirred it shows a layer.

    Attributes:
        name: What its reading is called.
        tip: Name of the frame at its end.
        lag: Its time constant [s]; ours: makers state that a glass electrode shows 95 % of a
            change within some seconds, which is three time constants.
        resolution: Step of the last digit.
    """

    name: str
    tip: str
    lag: float = 1.5
    resolution: float = 0.01

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("sensed", "wet", "noise", "band", "steady", "seed", "steps")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with what is around the tip, settled."""
        ph = self._ph(apparatus)
        wet = not math.isnan(ph)
        sensed = ph if wet else 0.0
        seed = rng.integers(2**31)
        apparatus.memory(self)[:] = sensed, wet, 0.0, sensed, _STEADY_FOR, seed, 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        sensed, was_wet, noise, band, steady, seed, steps = memory
        memory[-1] = steps + 1
        if steps % _RENEWED:
            return
        ph, passed = self._ph(apparatus), _RENEWED * apparatus.period
        if math.isnan(ph):
            memory[1] = 0.0
            return
        share = -math.expm1(-passed / self.lag) if was_wet else 1.0
        sensed += share * (ph - sensed)
        drawn = np.random.Generator(np.random.Philox(key=int(seed), counter=int(steps) // _RENEWED))
        noise = _NOISE * self.resolution * drawn.standard_normal()
        stays = was_wet and abs(sensed + noise - band) <= _BAND * self.resolution
        band, steady = (band, steady + passed) if stays else (sensed + noise, 0.0)
        memory[:-2] = sensed, 1.0, noise, band, steady

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        sensed, wet, noise, _, steady, *_ = apparatus.memory(self)
        if not wet:
            return Reading(math.nan, "pH", self.resolution, settled=False)
        settled = bool(steady >= _STEADY_FOR)
        return Reading(float(sensed + noise), "pH", self.resolution, settled)

    def _ph(self, apparatus: Apparatus) -> float:
        """Return the pH around the tip now; not a number in air, and in what is no solution."""
        if apparatus.liquid is None:
            return math.nan
        solution = apparatus.liquid.solution_at(apparatus.site(self.tip).position_w)
        return math.nan if solution is None else solution.ph
