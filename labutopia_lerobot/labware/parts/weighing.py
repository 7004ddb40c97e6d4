"""Weighing: the load cell below a pan, what it averages, its tare button."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading

_AVERAGING = 0.25
"""Time constant of the average [s]; ours: a load that is set down reads within 1 part in 1000 after
1.7 s, as makers of analytical and precision balances state settling times of 1.5 to 2 s."""
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
    """

    name: str
    sensor: str
    pan: str
    resolution: float
    capacity: float
    tare: str
    doors: tuple[str, ...] = ()

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("mean", "tared", "button in", "band", "steady", "noise", "seed", "steps")

    @property
    @override
    def sensors(self) -> tuple[str, ...]:
        return (self.sensor,)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with what is on the pan, settled, and nothing tared."""
        memory = apparatus.memory(self)
        memory[:] = 0.0
        memory[0] = memory[3] = self._load(apparatus)
        memory[4] = _STEADY_FOR
        memory[6] = rng.integers(2**31)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, period = apparatus.memory(self), apparatus.period
        mean, tared, was_in, band, steady, _, seed, steps = memory
        mean += (self._load(apparatus) - mean) * -math.expm1(-period / _AVERAGING)
        noise = _NOISE * self.resolution * (_DRAUGHT if self._open(apparatus) else 1.0)
        drawn = np.random.Philox(key=int(seed), counter=int(steps) // _RENEWED)
        memory[5] = noise * np.random.Generator(drawn).standard_normal()
        shown = mean + memory[5]
        within = abs(shown - band) <= _BAND * self.resolution
        pressed = apparatus.reading(self.tare).value
        if pressed > was_in:
            tared = mean
        memory[0], memory[1], memory[2] = mean, tared, pressed
        memory[3], memory[4] = (band, steady + period) if within else (shown, 0.0)
        memory[7] = steps + 1

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        mean, tared, _, _, steady, noise, _, _ = apparatus.memory(self)
        if mean > _OVERLOAD * self.capacity:
            return Reading(math.inf, "g", self.resolution, settled=False)
        settled = bool(steady >= _STEADY_FOR)
        return Reading(float(mean + noise - tared), "g", self.resolution, settled)

    def _load(self, apparatus: Apparatus) -> float:
        """Return the mean force on the pan since the last step, as a mass [g]."""
        model = apparatus.model
        gravity = float(np.linalg.norm(model.opt.gravity))
        weight = float(model.body(self.pan).mass[0])
        return 1e3 * (float(apparatus.mean(self.sensor)[0]) / gravity - weight)

    def _open(self, apparatus: Apparatus) -> bool:
        return any(apparatus.joint(door) > _AJAR for door in self.doors)
