"""Facts about a pipette that a gripper works: in the hand, its tip in a vessel or out of it."""

import math
from typing import Protocol

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, FloatArray, OpenVessel, Thing, World


class Grip(Thing, Protocol):
    """What a pad presses."""

    @property
    def joint(self) -> str:
        """Name of its slide [m]; 0 is at rest."""
        ...


class Pipette(Thing, Protocol):
    """A pipette with two grips, which pads press together."""

    @property
    def grips(self) -> tuple[Grip, Grip]:
        """What the pads press together."""
        ...

    @property
    def draws_at(self) -> str:
        """Name of the frame at the end of its tip; z the way that liquid leaves."""
        ...


@predicate("{pipette} in hand")
def in_hand(world: World, pipette: Pipette) -> bool:
    """Each pad touches a grip, not the same one."""
    left, right = (grip.name for grip in pipette.grips)
    on_left, on_right = world.touched_by(LEFT_PAD), world.touched_by(RIGHT_PAD)
    return (left in on_left and right in on_right) or (right in on_left and left in on_right)


@predicate("tip of {pipette} in {vessel}")
def tip_in(world: World, pipette: Pipette, vessel: OpenVessel) -> bool:
    """End of the tip is below the mouth of a vessel, and within it."""
    x, y, z = _tip(world, pipette, vessel)
    return math.hypot(x, y) < vessel.mouth_radius and bool(-vessel.height < z < 0.0)


@predicate("tip of {pipette} {by:g} m above {vessel}")
def tip_above(world: World, pipette: Pipette, vessel: OpenVessel, *, by: float) -> bool:
    """End of the tip is higher than the mouth of a vessel by a distance [m], wherever it is."""
    return bool(_tip(world, pipette, vessel)[2] > by)


def _tip(world: World, pipette: Pipette, vessel: OpenVessel) -> FloatArray:
    """Return where the end of the tip is in the frame of the mouth, shape (3,), metres."""
    return world.frame(vessel.rim).local(world.frame(pipette.draws_at).position_w)
