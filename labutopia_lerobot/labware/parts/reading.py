"""Readings of displays: a state, a mass on a pan, what a knob is set to, the time."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np


@dataclass(frozen=True)
class Either:
    """One text or another: by whether a door is open, or a switch on.

    Attributes:
        joint: Name of its joint.
        beyond: Position up to which it counts as shut, or off [rad or m].
        then: The text beyond that.
        otherwise: The text up to that.
    """

    joint: str
    beyond: float
    then: str
    otherwise: str

    def text(self, model: mujoco.MjModel, data: mujoco.MjData) -> str:
        """Return the text for where it is."""
        return self.then if float(data.joint(self.joint).qpos[0]) > self.beyond else self.otherwise


@dataclass(frozen=True)
class Mass:
    """Mass on a pan, in grams, less what was tared; the weight of the pan always is.

    Attributes:
        sensor: Name of the sensor of the force on what carries the pan [N].
        pan: Name of the pan's body.
        digits: Behind the decimal point.
        most: Capacity [g]; above it shows `Err`.
    """

    sensor: str
    pan: str
    digits: int
    most: float

    @property
    def tare(self) -> str:
        """Name of the model's number for what was tared [kg]."""
        return f"{self.pan}_tare"

    def text(self, model: mujoco.MjModel, data: mujoco.MjData) -> str:
        """Return the mass with a unit."""
        grams = 1e3 * (self.mass(model, data) - float(model.numeric(self.tare).data[0]))
        step = 10.0**-self.digits
        rounded = round(grams / step) * step + 0.0  # no minus zero
        return "Err" if rounded > self.most else f"{rounded:.{self.digits}f} g"

    def mass(self, model: mujoco.MjModel, data: mujoco.MjData) -> float:
        """Return the mass on the pan, tared or not [kg]."""
        gravity = float(np.linalg.norm(model.opt.gravity))
        force = float(data.sensor(self.sensor).data[0])
        return abs(force) / gravity - float(model.body(self.pan).mass[0])


@dataclass(frozen=True)
class Scale:
    """A scale: what a knob is set to, or how far something has moved.

    Attributes:
        joint: Name of its joint.
        widest: Where that stops [rad or m].
        lowest: What is shown at 0.
        highest: What is shown at `widest`.
        unit: Behind the number.
        step: To what it is rounded.
    """

    joint: str
    widest: float
    lowest: float
    highest: float
    unit: str
    step: float = 1.0

    def text(self, model: mujoco.MjModel, data: mujoco.MjData) -> str:
        """Return the number with its unit."""
        share = min(1.0, max(0.0, float(data.joint(self.joint).qpos[0]) / self.widest))
        value = round((self.lowest + share * (self.highest - self.lowest)) / self.step) * self.step
        digits = max(0, -math.floor(math.log10(self.step)))
        return f"{value:.{digits}f} {self.unit}".rstrip()


@dataclass(frozen=True)
class Clock:
    """The time since the episode began, or what is left of a time.

    Attributes:
        start: Time that is counted down [s]; 0 counts up.
    """

    start: float = 0.0

    def text(self, model: mujoco.MjModel, data: mujoco.MjData) -> str:
        """Return minutes and seconds."""
        seconds = max(0, math.ceil(self.start - data.time)) if self.start else int(data.time)
        return f"{seconds // 60:02d}:{seconds % 60:02d}"
