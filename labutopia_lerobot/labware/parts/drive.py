"""Drives: what turns at the speed that a knob is set to, with the ramp of its motor."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.motor import Motor
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading

RPM = 2 * math.pi / 60.0
"""One turn per minute [rad/s]."""
FASTEST = 300.0
"""Fastest that a joint turns [rpm]; ours. It is 6 degrees per physics step, 60 steps to a turn: an
edge 20 mm from the axis goes 2 mm per step, about as thick as the thinnest wall it may meet. What
is faster is a state: the display and the liquid have it, the joint turns at this speed."""
_REGULATION = 5.0
"""Of the loop that makes up for friction and load, per second; ours: 0.2 s."""
_SHOWN = 2.0
"""How long the display shows what is set after the knob has moved [s]; ours."""
_NEAR = 0.02
"""Share of the set speed within which the reading counts as settled; ours: makers state that a
speed is kept within 1 to 2 parts in 100."""


def all_on(apparatus: Apparatus, names: tuple[str, ...]) -> bool:
    """Return whether all these readings are above 0."""
    return all(apparatus.reading(name).value > 0.0 for name in names)


def set_value(setting: Process | float, apparatus: Apparatus) -> float:
    """Return what a dial is set to, or what needs no dial."""
    if not isinstance(setting, Process):
        return setting
    reading = setting.reading(apparatus)
    return 0.0 if reading is None else reading.shown


@dataclass(frozen=True)
class Drive(Process):
    """A motor with a regulated speed; its reading is the actual speed.

    The set speed follows the knob while all that must be on is on, else it is 0. Its display shows
    the actual speed, and for two seconds after the knob has moved what is set.

    Attributes:
        name: What its reading is called.
        setting: What the speed is set with, or the one speed that it has [unit].
        ramp: How fast it speeds up [unit/s].
        brake: How fast it slows down [unit/s].
        on: Names of readings that must all be above 0: switches, guards, timers.
        motors: What it moves; none if nothing of it is seen.
        unit: Of its reading.
        resolution: Step of the last digit.
        gear: Speed of the joints per unit [rad/s or m/s].
        seen: Fastest that the joints move [unit].
    """

    name: str
    setting: Process | float
    ramp: float
    brake: float
    on: tuple[str, ...] = ()
    motors: tuple[Motor, ...] = ()
    unit: str = "rpm"
    resolution: float = 1.0
    gear: float = RPM
    seen: float = FASTEST

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("speed", "set", "shown", *(f"trim of {motor.of}" for motor in self.motors))

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin at rest."""
        memory = apparatus.memory(self)
        memory[:] = 0.0
        memory[1] = set_value(self.setting, apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, period = apparatus.memory(self), apparatus.period
        before, was_set, shown = memory[:3]
        now_set = set_value(self.setting, apparatus)
        shown = _SHOWN if now_set != was_set else max(0.0, shown - period)
        wanted = now_set if all_on(apparatus, self.on) else 0.0
        change = min(self.ramp * period, max(-self.brake * period, wanted - before))
        memory[:3] = before + change, now_set, shown
        self._move(apparatus, before)

    def _move(self, apparatus: Apparatus, before: float) -> None:
        """Command the motors to the present speed; `before` is that of a period ago [unit]."""
        memory, period = apparatus.memory(self), apparatus.period
        speed, was = (self.gear * min(value, self.seen) for value in (memory[0], before))
        for number, motor in enumerate(self.motors, start=3):
            joint = apparatus.model.joint(motor.joint).id
            degree = int(apparatus.model.jnt_dofadr[joint])
            lacking = speed - float(apparatus.data.qvel[degree])
            most = motor.stall / motor.gain
            trim = memory[number] + _REGULATION * lacking * period if speed else 0.0
            memory[number] = min(most, max(-most, trim))
            inertia = float(apparatus.model.dof_M0[degree])
            ahead = inertia * (speed - was) / period / motor.gain
            motor.command(apparatus, speed + memory[number] + ahead)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        """Return the actual speed."""
        speed, wanted = apparatus.memory(self)[:2]
        wanted *= all_on(apparatus, self.on)
        value = self._actual(apparatus, float(speed))
        settled = abs(value - wanted) <= max(self.resolution, _NEAR * wanted)
        return Reading(value, self.unit, self.resolution, bool(settled))

    def _actual(self, apparatus: Apparatus, speed: float) -> float:
        """Return the actual speed where the motor is meant to have a speed [unit]."""
        if not self.motors:
            return speed
        joint = apparatus.model.joint(self.motors[0].joint).id
        velocity = float(apparatus.data.qvel[apparatus.model.jnt_dofadr[joint]])
        return abs(velocity) / self.gear + max(0.0, speed - self.seen)

    @override
    def text(self, apparatus: Apparatus) -> str:
        _, wanted, shown = apparatus.memory(self)[:3]
        if shown > 0.0:
            return "set " + Reading(float(wanted), self.unit, self.resolution).text
        return super().text(apparatus)


@dataclass(frozen=True)
class Rocking(Drive):
    """A drive whose crank makes its joint go to and fro over its whole range.

    Attributes:
        range: How far the joint goes, from 0 [rad].
    """

    range: float = 0.0

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return (*super().slots, "crank")

    @override
    def _move(self, apparatus: Apparatus, before: float) -> None:
        memory, half = apparatus.memory(self), self.range / 2
        turned = self.gear * memory[0] * apparatus.period
        (motor,) = self.motors
        position = apparatus.joint(motor.joint)
        if not turned:
            memory[-1] = math.acos(min(1.0, max(-1.0, 1.0 - position / half)))
            motor.command(apparatus, 0.0)
            return
        memory[-1] = (memory[-1] + turned) % (2 * math.pi)
        due = half * (1.0 - math.cos(memory[-1]))
        fastest = 1.5 * half * self.gear * memory[0] + 0.1
        motor.command(apparatus, min(fastest, max(-fastest, (due - position) / apparatus.period)))

    @override
    def _actual(self, apparatus: Apparatus, speed: float) -> float:
        return speed


@dataclass(frozen=True)
class Pumping(Process):
    """What a pump delivers: so much with every turn of its drive.

    Attributes:
        name: What its reading is called.
        drive: What turns it.
        displacement: Volume per turn [ml].
    """

    name: str
    drive: Drive
    displacement: float

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        speed = self.drive.reading(apparatus)
        return Reading(self.displacement * speed.value, "ml/min", 0.1, speed.settled)
