"""Timers: they count, and stop what they time."""

from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.drive import set_value
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading


def minutes_and_seconds(seconds: float) -> str:
    """Write a time [s]."""
    whole = int(seconds)
    return f"{whole // 60:02d}:{whole % 60:02d}"


@dataclass(frozen=True)
class Countdown(Process):
    """Counts the time down that is left; 0 is off. What it times has its name among what is on.

    With a start button it starts when that is pressed, with what is set; without one, as soon as
    its knob is turned. It does not start where a guard is open, and stops when one opens. Its
    display writes what is open, else what is left, else what is set.

    Attributes:
        name: What its reading is called, what is left [s].
        setting: A scale in minutes, or how many minutes there are always.
        start_button: Name of the button that starts it, if any.
        stop_button: Name of the button that stops it, if any.
        guards: What must be above 0 meanwhile.
    """

    name: str
    setting: Process | float
    start_button: str = ""
    stop_button: str = ""
    guards: tuple[Process, ...] = ()

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return "left", "start in", "set"

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin switched off."""
        apparatus.memory(self)[:] = 0.0, 0.0, set_value(self.setting, apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        left, was_in, was_set = memory
        now_set = set_value(self.setting, apparatus)
        pressed = apparatus.reading(self.start_button).value if self.start_button else 0.0
        left = max(0.0, left - apparatus.period)
        if left < apparatus.period / 2:  # what rounding has left of it
            left = 0.0
        starts = pressed > was_in if self.start_button else now_set != was_set
        if starts:
            left = 60.0 * now_set
        if self._open(apparatus) or (
            self.stop_button and apparatus.reading(self.stop_button).value
        ):
            left = 0.0
        memory[:] = left, pressed, now_set

    def _open(self, apparatus: Apparatus) -> str:
        """Return what a display writes of a guard that is open, or nothing."""
        return next((text for guard in self.guards if (text := guard.text(apparatus))), "")

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[0]), "s")

    @override
    def text(self, apparatus: Apparatus) -> str:
        left, _, minutes = apparatus.memory(self)
        return self._open(apparatus) or minutes_and_seconds(np.ceil(left or 60.0 * minutes))


@dataclass(frozen=True)
class Stopwatch(Process):
    """Counts up: one button starts and stops it, the other sets it to zero.

    Attributes:
        name: What its reading is called [s].
        start_button: Name of the button that starts it and stops it.
        reset_button: Name of the button that stops it and sets it to zero.
    """

    name: str
    start_button: str
    reset_button: str

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return "time", "runs", "start in"

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin at zero."""
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        time, runs, was_in = memory
        time += runs * apparatus.period
        pressed = apparatus.reading(self.start_button).value
        if pressed > was_in:
            runs = 1.0 - runs
        if apparatus.reading(self.reset_button).value:
            time = runs = 0.0
        memory[:] = time, runs, pressed

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        time, runs, _ = apparatus.memory(self)
        return Reading(float(time), "s", 0.1, settled=not runs)

    @override
    def text(self, apparatus: Apparatus) -> str:
        """Return minutes and seconds."""
        return minutes_and_seconds(self.reading(apparatus).value)
