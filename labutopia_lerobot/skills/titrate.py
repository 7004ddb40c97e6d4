"""Titrate: let most of it run from a burette, and the rest drop by drop as a pH meter says."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.hand_on_wing import SLIT, HandOnWing, Wing, has_run
from labutopia_lerobot.skills.skill import Condition, Phase
from labutopia_lerobot.world import World

_PINCHED = math.radians(67.0)
"""Angle of the wing between two drops, at which nothing runs; ours: as `SLIT`."""
_AIM = math.radians(8.0)
"""How far beyond what it wants to reach the hand aims, which holds the wing loosely [rad]; ours."""
_SLOWLY = 0.08
"""How fast it turns until a drop runs [rad/s]; ours: 1.5 degrees are from none to 0.1 ml/s."""
_NOT_YET = 2.0
"""How long a drop takes to fall and to begin to mix, before a reading can count [s]; ours."""
_DROPS = 40
"""After so many it gives up; ours."""


@dataclass(frozen=True)
class Titrate:
    """Grip the wing and keep it: run some out, pinch it, then a drop for each settled reading.

    Attributes:
        wing: What to turn.
        delivered: What reads how much has run out [ml].
        meter: What reads the pH.
        ph: Reading at which it is shut.
        first_ml: How much runs before the first reading.
        drop_ml: How much runs between two readings.
        last_ml: How much is left of the first when the hand begins to narrow it.
        standoff: Distance from which the last approach starts, and to which the hand leaves [m].
    """

    wing: Wing
    delivered: Readable
    meter: Readable
    ph: float
    first_ml: float
    drop_ml: float
    last_ml: float = 0.8
    standoff: float = 0.10

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, reach, grip, open, run and narrow; watch and drip; shut and let go."""
        hand = HandOnWing.before(world, self.wing, self.standoff)
        yield from hand.take()
        yield from hand.run_out(world, self.delivered, self.first_ml, self.last_ml)
        yield hand.turn("pinch", _PINCHED - _AIM, hand.wing_beyond(_PINCHED, back=True))
        for _ in range(_DROPS):
            yield hand.turn("watch", _PINCHED, self._says)
            if self._there(world):
                break
            enough = world.reading(self.delivered.name).value + self.drop_ml
            yield hand.turn("drip", SLIT + _AIM, has_run(self.delivered, enough), _SLOWLY)
            yield hand.turn("pinch", _PINCHED - _AIM, hand.wing_beyond(_PINCHED, back=True))
        yield from hand.let_go()

    @property
    def _says(self) -> Condition:
        return lambda world, _, elapsed: (
            self._there(world) or (elapsed >= _NOT_YET and world.reading(self.meter.name).settled)
        )

    def _there(self, world: World) -> bool:
        return world.reading(self.meter.name).value >= self.ph
