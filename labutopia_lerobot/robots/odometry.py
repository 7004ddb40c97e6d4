"""Odometry of a base: where it believes to be, from how its wheels have turned.

Borenstein and Feng (1996, "Measurement and Correction of Systematic Odometry Errors in Mobile
Robots"): on smooth floors indoors systematic errors, of wheels that are not as wide and not as far
apart as they should be, contribute much more than slipping. Their three kinds are drawn for an
episode, and nothing after that: lengths and turns come out too long or too short, and a straight
way is bent. So the error grows with the way driven and with the turns.
"""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import FloatArray

LENGTH, TURN = 0.01, 0.02
"""Standard deviations of the errors of lengths and of turns, as shares; ours."""
BEND = math.radians(0.3)
"""The same of how much a straight way is bent [rad/m]; ours: with it, 10 m straight on end 0.26 m
aside. Their uncalibrated base is 0.3 m off after a square of 16 m."""


@dataclass(frozen=True)
class Odometry(Process):
    """Dead reckoning from a true start, in the room's frame.

    Attributes:
        name: Of the process.
        joints: Slides of the base along x and y of the room, and the hinge about z.
    """

    name: str
    joints: tuple[str, str, str]

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        poses = [f"{of} {axis}" for of in ("believed", "last") for axis in ("x", "y", "yaw")]
        return ("length", "turn", "bend", *poses)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Draw the errors; it knows where it starts."""
        here = self._true(apparatus)
        errors = rng.normal(0.0, (LENGTH, TURN, BEND))
        apparatus.memory(self)[:] = np.concatenate([errors, here, here])

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Add what the wheels say of the way since the last step."""
        memory, here = apparatus.memory(self), self._true(apparatus)
        (length, turn, bend), believed, last = memory[:3], memory[3:6], memory[6:]
        x, y, turned = here - last
        middle = last[2] + 0.5 * turned
        ahead = math.cos(middle) * x + math.sin(middle) * y
        left = math.cos(middle) * y - math.sin(middle) * x
        turned = (1.0 + turn) * turned + bend * ahead
        middle = believed[2] + 0.5 * turned
        c, s = (1.0 + length) * math.cos(middle), (1.0 + length) * math.sin(middle)
        believed += (c * ahead - s * left, s * ahead + c * left, turned)
        last[:] = here

    def pose(self, apparatus: Apparatus) -> FloatArray:
        """Return where the base believes to be: x, y [m] and heading [rad], shape (3,), a copy."""
        return apparatus.memory(self)[3:6].copy()

    def _true(self, apparatus: Apparatus) -> FloatArray:
        return np.array([apparatus.joint(name) for name in self.joints])
