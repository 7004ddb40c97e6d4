"""Let liquid run out through a stopcock until a volume has, and shut it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.skill import Condition, Phase, arrived, at, waited
from labutopia_lerobot.skills.turn_knob import Turnable
from labutopia_lerobot.world import World

_OPENING = 0.040
"""Distance between the pads around the wing before they close [m]; ours."""
_DEPTH = -0.007
"""How far behind the middle of the wing the middle of the pads comes [m]: its stem is thicker."""
_SLIT = math.radians(75.0)
"""Angle at which the hand stops turning back: little runs, and a few degrees shut it; ours, for a
plug and a hole of 12.5 and 2 mm, which is shut at 72 degrees."""
_BEYOND = math.radians(4.0)
"""How far beyond either stop the hand aims [rad]; ours."""
_TURNING, _EASING = 0.8, 0.25
"""How fast the hand turns, and where the last drops count [rad/s]; ours."""


class Wing(Turnable, Protocol):
    """The wing of a stopcock, open at its stop; its frame is in its middle, x along it."""

    @property
    def closed_within(self) -> float:
        """Where it is shut [rad]."""
        ...


@dataclass(frozen=True)
class RunOut:
    """Grip the wing and keep it: open, let run, turn back to a slit, wait, shut; then let go.

    Attributes:
        wing: What to turn.
        delivered: What reads how much has run out [ml].
        ml: How much is to run out.
        last_ml: How much is left to run when the hand begins to narrow it.
        standoff: Distance from which the last approach starts, and to which the hand leaves [m].
    """

    wing: Wing
    delivered: Readable
    ml: float
    last_ml: float = 0.8
    standoff: float = 0.10

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, reach, grip, open, run, narrow, trickle, shut, release and leave."""
        touches = frozenset({self.wing.name})
        away, there = arrived(within=0.01, within_rad=0.1), arrived(within=0.004, within_rad=0.04)
        # Either way round the fingers hold it; this way the wrist is not yet at its stop.
        wing = world.frame(self.wing.name).turned(math.pi).advanced(_DEPTH)
        shut_hand = wing.turned(-world.joint(self.wing.joint))
        before = wing.advanced(-self.standoff)
        yield Phase("approach", at(before), _OPENING, away, timeout_s=8.0)
        yield Phase("reach", at(wing), _OPENING, there, touches, speed=0.10)
        yield Phase("grip", at(wing), 0.0, waited(0.6), touches)

        def turn(name: str, angle: float, done: Condition, speed: float = _TURNING) -> Phase:
            hand = shut_hand.turned(angle)
            return Phase(name, at(hand), 0.0, done, touches, turn_speed=speed, timeout_s=60.0)

        yield turn(
            "open", self.wing.widest + _BEYOND, self._wing_beyond(self.wing.widest - _BEYOND)
        )
        coarse = self._has_run(self.ml - self.last_ml)
        yield turn("run", self.wing.widest, coarse)
        yield turn("narrow", 0.0, self._wing_beyond(_SLIT, back=True), _EASING)
        here = world.joint(self.wing.joint)
        yield turn("trickle", here, self._has_run(self.ml), _EASING)
        yield turn("shut", -_BEYOND, self._wing_beyond(self.wing.closed_within / 5, back=True))
        yield Phase("release", at(shut_hand), _OPENING, waited(0.6), touches)
        yield Phase("leave", at(shut_hand.advanced(-self.standoff)), _OPENING, away, touches)

    def _has_run(self, ml: float) -> Condition:
        return lambda world, _, elapsed: world.reading(self.delivered.name).value >= ml

    def _wing_beyond(self, angle: float, *, back: bool = False) -> Condition:
        sign = -1.0 if back else 1.0
        return lambda world, _, elapsed: sign * (world.joint(self.wing.joint) - angle) >= 0.0
