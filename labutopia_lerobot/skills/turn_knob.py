"""Turn a knob to where it is wanted, gripping anew where the wrist would not go on."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.skills.skill import Condition, Phase, arrived, at, waited
from labutopia_lerobot.world import Pose, World

_HALF = math.radians(50.0)
"""How far the hand turns to either side of how it is comfortable [rad]; ours."""
_COMFORT = math.radians(30.0)
"""How the hand is turned to a knob on an upright panel from where its back looks up [rad]; ours:
turned by up to 80 degrees to either side of that the default robot keeps all joints 0.5 rad from
their ends, where the panel looks 20 to 40 degrees to its left."""
_SQUEEZE = 0.014
"""How much narrower than the knob the closed gripper is commanded [m]."""
_NEAR = math.radians(1.5)
"""How far from where it is wanted a knob may be left [rad]; ours."""
_TURNING = 0.6
"""How fast the hand turns [rad/s]; ours."""
_GRIPS = 6
"""How often it is gripped at most."""


class Turnable(Protocol):
    """Something that turns about the z axis of its frame, which points into what bears it."""

    @property
    def name(self) -> str:
        """Name of its body and of its frame."""
        ...

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; it turns about the z axis of its frame."""
        ...

    @property
    def widest(self) -> float:
        """Where it stops [rad]."""
        ...


class Dial(Turnable, Protocol):
    """A knob; the origin of its frame is in the middle of its face, x along its pointer."""

    @property
    def diameter(self) -> float:
        """Of the dial [m]."""
        ...


@dataclass(frozen=True)
class TurnKnob:
    """Approach along the axis, grip, turn, release and back off, again until it is where it should.

    Attributes:
        knob: What to turn.
        to: Position of its hinge to turn it to [rad].
        standoff: Distance from which the first approach starts, and to which the hand leaves [m].
        depth: How far behind the knob's face the middle of the pads comes [m].
        opening: Distance between the pads around the knob [m].
    """

    knob: Dial
    to: float
    standoff: float = 0.10
    depth: float = 0.002
    opening: float = 0.060

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, then reach, grip, turn, release and back off, and leave."""
        touches, shut = frozenset({self.knob.name}), 0.76 * self.knob.diameter - _SQUEEZE
        axis = self._axis(world)
        away, there = arrived(within=0.01, within_rad=0.1), arrived(within=0.004, within_rad=0.04)
        angle = 0.0
        for grip in range(_GRIPS):
            lacking = self.to - world.joint(self.knob.joint)
            if abs(lacking) < _NEAR:
                break
            swing = max(-2 * _HALF, min(2 * _HALF, lacking))
            angle = -swing / 2
            if grip == 0:
                before = axis.turned(angle).advanced(-self.standoff)
                yield Phase("approach", at(before), self.opening, away, timeout_s=8.0)
            near = axis.turned(angle).advanced(-0.035)
            yield Phase("align", at(near), self.opening, away, touches)
            held = axis.turned(angle)
            yield Phase("reach", at(held), self.opening, there, touches, speed=0.10)
            yield Phase("grip", at(held), shut, waited(0.6), touches)
            goal, start = world.joint(self.knob.joint) + swing, angle
            turned = axis.turned(start + swing)
            yield Phase(
                "turn",
                at(turned),
                shut,
                _reached(self.knob.joint, goal, 0.6 + abs(swing) / _TURNING),
                touches,
                turn_speed=_TURNING,
            )
            angle = start + swing
            yield Phase("release", at(turned), self.opening, waited(0.6), touches)
            yield Phase("back off", at(turned.advanced(-0.035)), self.opening, away, touches)
        last = axis.turned(angle).advanced(-self.standoff)
        yield Phase("leave", at(last), self.opening, away, touches)

    def _axis(self, world: World) -> Pose:
        """Return the pose of the hand around the knob at its middle position, as a panel is."""
        frame, half = world.frame(self.knob.name), self.knob.widest / 2
        middle = _COMFORT + half - world.joint(self.knob.joint)
        return frame.turned(middle).advanced(self.depth)


def _reached(joint: str, goal: float, seconds: float) -> Condition:
    """A joint is at a position [rad], or the hand has had time enough."""
    return lambda world, _, elapsed: abs(world.joint(joint) - goal) < _NEAR / 3 or elapsed > seconds
