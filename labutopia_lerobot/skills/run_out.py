"""Let liquid run out through a stopcock until a volume has, and shut it."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.hand_on_wing import HandOnWing, Wing
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.world import World


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
        hand = HandOnWing.before(world, self.wing, self.standoff)
        yield from hand.take()
        yield from hand.run_out(world, self.delivered, self.ml, self.last_ml)
        yield from hand.let_go()
