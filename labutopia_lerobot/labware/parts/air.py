"""Air that is moved: fans, and pumps that evacuate."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.drive import all_on, set_value
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading

AMBIENT = 1013.0
"""Pressure of the air [mbar]."""


@dataclass(frozen=True)
class Fan(Process):
    """A fan: the speed of its air follows its switch as a first-order lag does.

    Attributes:
        name: What its reading is called.
        on: Name of the reading that is above 0 while it is on.
        speed: Of the air where it is on [m/s].
        lag: Time constant of fan and duct [s].
    """

    name: str
    on: str
    speed: float
    lag: float = 3.0

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("speed",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        memory[0] += -math.expm1(-apparatus.period / self.lag) * (
            self._wanted(apparatus) - memory[0]
        )

    def _wanted(self, apparatus: Apparatus) -> float:
        return self.speed if all_on(apparatus, (self.on,)) else 0.0

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        speed = float(apparatus.memory(self)[0])
        return Reading(speed, "m/s", 0.01, abs(speed - self._wanted(apparatus)) < 0.01)


@dataclass(frozen=True)
class Vacuum(Process):
    """The pressure in what a pump evacuates, which falls towards its end vacuum.

    Its regulator lets air in where the pressure would fall below what is set.

    Attributes:
        name: What its reading is called.
        on: Name of the reading that is above 0 while it pumps.
        setting: What the pressure is set with, or what needs no dial [mbar].
        end: End vacuum [mbar].
        pumping: Volume that it evacuates over its pumping speed [s].
        leaking: Time constant with which the air comes back [s].
    """

    name: str
    on: str
    setting: Process | float
    end: float
    pumping: float
    leaking: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("missing",)  # to the pressure of the air [mbar]: 0 before the start

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        pressure, allowed = AMBIENT - memory[0], set_value(self.setting, apparatus)
        goal, lag = AMBIENT, self.leaking
        if all_on(apparatus, (self.on,)):
            goal, lag = (self.end, self.pumping) if pressure > allowed else (allowed, self.pumping)
        after = goal + (pressure - goal) * math.exp(-apparatus.period / lag)
        if goal == self.end:
            after = max(after, allowed)
        memory[0] = AMBIENT - after

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        pressure = AMBIENT - float(apparatus.memory(self)[0])
        wanted = set_value(self.setting, apparatus)
        still = abs(pressure - wanted) < 1.0 if all_on(apparatus, (self.on,)) else False
        return Reading(pressure, "mbar", 1.0, still)
