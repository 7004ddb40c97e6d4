"""A person who walks to and fro through the laboratory: a cylinder with a head."""

import math
from dataclasses import dataclass
from typing import ClassVar, override

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Form, Rod
from labutopia_lerobot.labware.parts.motor import Motor
from labutopia_lerobot.labware.parts.mounting import Fixed
from labutopia_lerobot.processes import Apparatus, Process

WAY = 2.0
"""How far a person walks before turning round [m]; ours."""
RADIUS = 0.25
"""Of a person [m]; ours: shoulders of 0.49 m, as DIN 33402-2 has them for a man in the middle."""
_HEIGHT, _MASS = 1.75, 75.0
"""[m] and [kg]; DIN 33402-2, a man in the middle."""
_PACE = (0.4, 0.7)
"""Least and greatest speed [m/s]; ours: somebody who carries something."""
_REST = (0.5, 3.0)
"""Least and greatest time at either end [s]; ours."""
_THERE = 0.03
"""Distance from the end at which a person has come there [m]; ours: more than a step in time."""
_SEES = 0.65
"""Distance ahead at which a person stops for what is in the way [m], not for what it does not touch
at the end of the way; ours: a step."""
_SPARE = 0.05
"""Distance from that end below which it is in the way all the same [m]; ours: a round column is
nearer than it looks."""
_PATIENCE = 2.0
"""Time after which one who has stopped turns round [s]; ours."""
_EYES = np.array(
    [
        (math.sqrt(RADIUS**2 - left**2), left, height)
        for left in np.linspace(-0.2, 0.2, 6)
        for height in np.arange(0.1, 1.75, 0.1)
    ]
    + [(0.0, left, height) for left in (-0.28, 0.28) for height in np.arange(0.1, 1.75, 0.02)]
)
"""Where the rays begin in which one looks ahead, shape (n, 3) [m]: ahead, to the left and above the
feet; on one's surface and, closer together, 3 cm beside it. Ours: a hand is 0.1 m wide, and a
finger that comes in from the side 2 cm high."""
_NEAR = 1.6
"""Distance of a body below which one looks [m]; ours: a step, oneself, and half of a base."""
_STALL, _GAIN = 200.0, 1500.0
"""Greatest force [N] and force per difference of speed [N s/m] of the legs; ours."""


@dataclass(frozen=True)
class Walk(Process):
    """To and fro along a straight line, with rests; it stops for what is in the way.

    Attributes:
        name: Of the process.
        person: Name of the body.
        motor: What moves it.
    """

    name: str
    person: str
    motor: Motor

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("pace", "rest", "towards", "rests for", "stopped for")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin to walk away from the start, or to rest there a while."""
        rest = rng.uniform(*_REST)
        begin = rng.uniform(0.0, rest)
        apparatus.memory(self)[:] = (rng.uniform(*_PACE), rest, 1.0, begin, 0.0)

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Walk, rest, or wait."""
        memory, period = apparatus.memory(self), apparatus.period
        pace, rest, towards, rests, stopped = memory
        place, speed = apparatus.joint(self.motor.joint), 0.0
        left = WAY - place if towards > 0.0 else place
        if rests > 0.0:
            memory[3] = rests - period
        elif left < _THERE:
            memory[2:] = (-towards, rest, 0.0)
        elif stopped > _PATIENCE:
            memory[2:] = (-towards, 0.0, 0.0)
        elif self._sees_something(apparatus, towards, min(left + _SPARE, _SEES)):
            memory[4] = stopped + period
        else:
            speed, memory[4] = pace * towards, 0.0
        self.motor.command(apparatus, speed)

    def _sees_something(self, apparatus: Apparatus, towards: float, within: float) -> bool:
        """Return whether anything that can move is so near ahead [m]: walls are beside the way."""
        model, data = apparatus.model, apparatus.data
        body = model.body(self.person).id
        others = (model.body_weldid > 0) & (model.body_weldid != body)
        away = np.hypot(*(data.xpos[others] - data.xpos[body])[:, :2].T)
        if not (away < _NEAR).any():
            return False
        turn = data.xmat[body].reshape(3, 3)
        ahead, hit = towards * turn[:, 0], np.zeros(1, np.int32)
        for eye in data.xpos[body] + _EYES * (towards, 1.0, 1.0) @ turn.T:
            distance = mujoco.mj_ray(model, data, eye, ahead, None, 0, body, hit)
            if 0.0 <= distance < within:
                return True
        return False


@dataclass(frozen=True)
class PasserBy(Fixed):
    """A person who walks along x of the place where it starts, 2 m far, and back.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        walks: It does.
    """

    name: str
    walks: ClassVar[bool] = True
    height: ClassVar[float] = _HEIGHT
    footprint_radius: ClassVar[float] = RADIUS

    @property
    def joints(self) -> tuple[str, ...]:
        """Where on its way it is."""
        return (self._motor.joint,)

    @property
    def processes(self) -> tuple[Process, ...]:
        return (Walk(f"{self.name}_walk", self.name, self._motor),)

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build it, on a slide along x that begins where it starts."""
        body = parent.add_body(name=self.name, gravcomp=1)
        body.add_joint(
            name=self._motor.joint,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=(1, 0, 0),
            range=(0.0, WAY),
            limited=mujoco.mjtLimited.mjLIMITED_TRUE,
        )
        width = 2 * RADIUS
        forms: list[Form] = [
            Rod((0, 0, 0.02), (0, 0, 0.55), 0.8 * width, "anthracite"),
            Rod((0, 0, 0.55), (0, 0, 1.48), width, "cloth"),
            Rod((0, 0, 1.48), (0, 0, _HEIGHT), 0.17, "wood"),
        ]
        assemble(spec, body, self.name, forms, _MASS)
        self._motor.add_to(spec)
        return body

    @property
    def _motor(self) -> Motor:
        return Motor(self.name, f"{self.name}_slide", _STALL, _GAIN)
