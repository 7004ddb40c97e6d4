"""The hand on the wing of a stopcock: how it takes it, turns it and lets go of it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.skill import Condition, Phase, arrived, at, waited
from labutopia_lerobot.skills.turn_knob import Turnable
from labutopia_lerobot.world import Pose, World

_OPENING = 0.040
"""Distance between the pads around the wing before they close [m]; ours."""
_DEPTH = -0.007
"""How far behind the middle of the wing the middle of the pads comes [m]: its stem is thicker."""
_BEYOND = math.radians(4.0)
"""How far beyond either stop the hand aims [rad]; ours."""
_TURNING = 0.8
"""How fast the hand turns [rad/s]; ours."""
EASING = 0.25
"""How fast it turns where the last drops count [rad/s]; ours."""
SLIT = math.radians(75.0)
"""Angle at which the hand stops turning back: little runs, and a few degrees shut it; ours, for a
plug and a hole of 12.5 and 2 mm, which is shut at 72 degrees."""


class Wing(Turnable, Protocol):
    """The wing of a stopcock, open at its stop; its frame is in its middle, x along it."""

    @property
    def closed_within(self) -> float:
        """Where it is shut [rad]."""
        ...


@dataclass(frozen=True)
class HandOnWing:
    """Where the hand is when it has the wing, and the phases that take it and let go of it.

    Attributes:
        wing: The wing.
        grasp_w: The hand around it, at first.
        shut_w: The hand around it when it is shut.
        standoff: Distance from which the last approach starts, and to which the hand leaves [m].
    """

    wing: Wing
    grasp_w: Pose
    shut_w: Pose
    standoff: float

    @classmethod
    def before(cls, world: World, wing: Wing, standoff: float) -> "HandOnWing":
        """Return the hand that is going to take a wing as it is now."""
        # Either way round the fingers hold it; this way the wrist is not yet at its stop.
        grasp = world.frame(wing.name).turned(math.pi).advanced(_DEPTH)
        return cls(wing, grasp, grasp.turned(-world.joint(wing.joint)), standoff)

    def take(self) -> Iterator[Phase]:
        """Yield approach, reach and grip."""
        away, there = arrived(within=0.01, within_rad=0.1), arrived(within=0.004, within_rad=0.04)
        before = self.grasp_w.advanced(-self.standoff)
        yield Phase("approach", at(before), _OPENING, away, timeout_s=8.0)
        yield Phase("reach", at(self.grasp_w), _OPENING, there, self._touches, speed=0.10)
        yield Phase("grip", at(self.grasp_w), 0.0, waited(0.6), self._touches)

    def turn(self, name: str, angle: float, done: Condition, speed: float = _TURNING) -> Phase:
        """Return the phase in which the hand turns to an angle of the wing [rad]."""
        hand = at(self.shut_w.turned(angle))
        return Phase(name, hand, 0.0, done, self._touches, turn_speed=speed, timeout_s=60.0)

    def open(self) -> Phase:
        """Return the phase that opens it."""
        widest = self.wing.widest
        return self.turn("open", widest + _BEYOND, self.wing_beyond(widest - _BEYOND))

    def run_out(
        self, world: World, delivered: Readable, ml: float, last_ml: float
    ) -> Iterator[Phase]:
        """Yield open, run, narrow and trickle, after which a volume has run out; it runs on.

        Args:
            world: Where it runs.
            delivered: What reads how much has run out [ml].
            ml: How much is to run out.
            last_ml: How much is left to run when the hand begins to narrow it.
        """
        yield self.open()
        yield self.turn("run", self.wing.widest, has_run(delivered, ml - last_ml))
        yield self.turn("narrow", 0.0, self.wing_beyond(SLIT, back=True), EASING)
        here = world.joint(self.wing.joint)
        yield self.turn("trickle", here, has_run(delivered, ml), EASING)

    def let_go(self) -> Iterator[Phase]:
        """Yield shut, release and leave."""
        shut = self.wing_beyond(self.wing.closed_within / 5, back=True)
        yield self.turn("shut", -_BEYOND, shut)
        yield Phase("release", at(self.shut_w), _OPENING, waited(0.6), self._touches)
        away = arrived(within=0.01, within_rad=0.1)
        yield Phase(
            "leave", at(self.shut_w.advanced(-self.standoff)), _OPENING, away, self._touches
        )

    def wing_beyond(self, angle: float, *, back: bool = False) -> Condition:
        """Return whether the wing has been turned beyond an angle [rad], or back to it."""
        sign = -1.0 if back else 1.0
        return lambda world, _, elapsed: sign * (world.joint(self.wing.joint) - angle) >= 0.0

    @property
    def _touches(self) -> frozenset[str]:
        return frozenset({self.wing.name})


def has_run(delivered: Readable, ml: float) -> Condition:
    """Return whether so much has run out [ml].

    Args:
        delivered: What reads how much has.
        ml: How much.
    """
    return lambda world, _, elapsed: world.reading(delivered.name).value >= ml
