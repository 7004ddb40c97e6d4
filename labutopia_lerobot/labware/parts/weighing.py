"""Weighing: the load cell below a pan, what it averages, its tare button."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import override

import numpy as np

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import FloatArray, Reading

_STAGES, _AVERAGING = 4, 0.15
"""Averages one after another, and the time constant of each [s]; ours. A load that is set down
reads within 1 part in 1000 after 1.9 s, as makers of analytical and precision balances state
settling times of 1.5 to 2 s. Of 50 ml that stir in a beaker 1.3 mg are left (standard deviation,
1000 particles, 20 s), with a single average of 0.25 s it is 62 mg."""
_STEADY_FOR = 1.0
"""How long the average must stay within a band before the reading counts as settled [s]; ours."""
_BAND = 2.0
"""Half width of that band, in steps of the last digit; ours."""
_NOISE = 0.5
"""Standard deviation of a settled reading, in steps of the last digit; ours: makers state a
repeatability of one step of the last digit for balances of these classes."""
_DRAUGHT = 20.0
"""How many times that while a door is open; ours: weighing guides say of an analytical balance that
it does not settle with its draught shield open."""
_RENEWED = 6
"""Control steps between two numbers on the display: five a second; ours."""
_AJAR = 0.005
"""Position up to which a door of a draught shield counts as shut [rad or m]."""
_OVERLOAD = 1.02
"""Share of the capacity above which it shows an error; ours."""


@dataclass(frozen=True)
class Weighing(Process):
    """The mass on a pan [g], less what was tared, as the load cell feels it.

    What pushes the pan down counts, whatever it is: a finger, or liquid that is being poured. A pan
    that is lifted reads negative.

    Attributes:
        name: What its reading is called.
        sensor: Name of the sensor whose first number is the force on the load cell [N], positive
            down.
        pan: Name of the body of the pan, whose weight does not count.
        resolution: Step of the last digit [g].
        capacity: The most that it weighs [g].
        tare: Name of the button that sets it to zero.
        doors: Joints of the doors of its draught shield, which are shut at 0.
        tared: Least and most that was tared before the episode [g], drawn evenly.
    """

    name: str
    sensor: str
    pan: str
    resolution: float
    capacity: float
    tare: str
    doors: tuple[str, ...] = ()
    tared: tuple[float, float] = (0.0, 0.0)

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        averages = (f"average {stage}" for stage in range(_STAGES))
        return (*averages, "tared", "button in", "band", "steady", "noise", "seed", "steps")

    @property
    @override
    def sensors(self) -> tuple[str, ...]:
        return (self.sensor,)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with what is on the pan, settled, less what somebody has tared before."""
        averages, rest = self._split(apparatus)
        averages[:] = self._load(apparatus)
        rest[:] = (
            rng.uniform(*self.tared),
            0.0,
            averages[-1],
            _STEADY_FOR,
            0.0,
            rng.integers(2**31),
            0.0,
        )

    @override
    def step(self, apparatus: Apparatus) -> None:
        averages, rest = self._split(apparatus)
        tared, was_in, band, steady, _, seed, steps = rest.tolist()
        share, load = -math.expm1(-apparatus.period / _AVERAGING), self._load(apparatus)
        for stage, average in enumerate(averages.tolist()):
            averages[stage] = load = average + share * (load - average)
        noise = _NOISE * self.resolution * (_DRAUGHT if self._open(apparatus) else 1.0)
        noise *= _drawn(int(seed), int(steps) // _RENEWED)
        pressed = apparatus.reading(self.tare).value
        if pressed > was_in:
            tared = load
        within = abs(load + noise - band) <= _BAND * self.resolution
        band, steady = (band, steady + apparatus.period) if within else (load + noise, 0.0)
        rest[:] = tared, pressed, band, steady, noise, seed, steps + 1

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        *_, average, tared, _, _, steady, noise, _, _ = apparatus.memory(self).tolist()
        if average > _OVERLOAD * self.capacity:
            return Reading(math.inf, "g", self.resolution, settled=False)
        settled = steady >= _STEADY_FOR
        return Reading(average + noise - tared, "g", self.resolution, settled)

    def _split(self, apparatus: Apparatus) -> tuple[FloatArray, FloatArray]:
        """Return the averages [g] and the rest of what it remembers, views."""
        memory = apparatus.memory(self)
        return memory[:_STAGES], memory[_STAGES:]

    def _load(self, apparatus: Apparatus) -> float:
        """Return the mean force on the pan since the last step, as a mass [g]."""
        force = float(apparatus.mean(self.sensor)[0])
        return 1e3 * (force / apparatus.gravity - apparatus.mass(self.pan))

    def _open(self, apparatus: Apparatus) -> bool:
        return any(apparatus.joint(door) > _AJAR for door in self.doors)


@lru_cache(maxsize=64)
def _drawn(seed: int, number: int) -> float:
    """Return a number of the display's noise, normally distributed with deviation 1."""
    return float(np.random.Generator(np.random.Philox(key=seed, counter=number)).standard_normal())
