"""Working a pipette that is in the hand: its tip somewhere, its grips pressed as far as wanted."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates.pipette_tip import Pipette
from labutopia_lerobot.skills.posture import UP, upright_in_hand
from labutopia_lerobot.skills.skill import Phase, Target, carrier, waited
from labutopia_lerobot.world import CONTROL_HZ, Graspable, OpenVessel, World

HOLD = 0.0007
"""How much narrower than the grips at rest the gripper is commanded to hold a pipette [m]: its
servo then gives less than the springs of the grips; ours."""
_PRESSING = 0.010
"""How fast the command narrows and widens [m/s]; ours: a second to the first stop."""
_SHARE = 0.2
"""Share of what is missing of the stroke by which the command narrows in a control step; ours."""
_CLOSE = 2e-5
"""How near to the wanted stroke is near enough [m]: 0.3 % of the stroke to the first stop; ours."""
_STILL = 6
"""For how many control steps in a row; ours."""
_MOST = 240
"""After how many the stroke is left as it is; ours."""


class Workable(Pipette, Graspable, Protocol):
    """A pipette that a gripper takes by its grips."""

    @property
    def stroke(self) -> float:
        """Travel of both grips together to the first stop, or that displaces as much [m]."""
        ...

    @property
    def full_stroke(self) -> float:
        """Travel of both grips together to the second stop, or as far as they go [m]."""
        ...

    @property
    def stops_at_rest(self) -> bool:
        """Whether springs keep its grips at a stop while a hand holds it; else it squeezes them."""
        ...


def bodies(pipette: Pipette) -> frozenset[str]:
    """Return the names of its bodies, as contacts are called."""
    return frozenset({pipette.name, *(grip.name for grip in pipette.grips)})


@dataclass(frozen=True)
class Held:
    """A pipette in the hand, upright.

    Attributes:
        pipette: The pipette.
        touches: What hand and tip may touch, the pipette included.
    """

    pipette: Workable
    touches: frozenset[str]

    def tip_over(self, world: World, vessel: OpenVessel, height: float) -> Target:
        """Return the hand with the tip on a vessel's axis, `height` [m] above its mouth."""
        point = world.frame(vessel.rim).position_w + height * UP
        hand = carrier(world, self.pipette)(upright_in_hand(world, self.pipette, point))
        return lambda world: hand

    def at_rest(self, world: World) -> float:
        """Return the travel of both grips together at which the hand holds it now [m]."""
        return 0.0 if self.pipette.stops_at_rest else self._travel(world)

    def press(self, world: World, name: str, target: Target, stroke: float) -> Iterator[Phase]:
        """Yield what brings the travel of both grips together to `stroke` [m] by what it is."""
        shut, still = world.commanded_opening, 0
        for _ in range(_MOST):
            missing = stroke - self._travel(world)
            still = still + 1 if abs(missing) < _CLOSE else 0
            if still == _STILL:
                return
            fastest = _PRESSING / CONTROL_HZ
            shut -= max(-fastest, min(fastest, _SHARE * missing))
            yield self._worked(name, target, shut)

    def release(self, world: World, target: Target) -> Iterator[Phase]:
        """Yield what lets the grips come back to rest, slowly."""
        shut, rest = world.commanded_opening, self.pipette.grip_width - HOLD
        while shut < rest:
            shut = min(rest, shut + _PRESSING / CONTROL_HZ)
            yield self._worked("release", target, shut)

    def _travel(self, world: World) -> float:
        return sum(world.joint(grip.joint) for grip in self.pipette.grips)

    def _worked(self, name: str, target: Target, shut: float) -> Phase:
        step = waited(0.0)
        return Phase(name, target, max(0.0, shut), step, self.touches, self.pipette)
