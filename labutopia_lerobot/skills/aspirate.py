"""Draw up what a pipette holds from a vessel."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.pipette_in_hand import Held, Workable, bodies
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import OpenVessel, World


@dataclass(frozen=True)
class Aspirate:
    """Go over the vessel, press to the first stop, dip, release, wait, lift out.

    A little more than to the stop: the weight of the column keeps back 0.7 %, of a bulb 7.5 %
    (docs/small_volumes).

    Attributes:
        pipette: The pipette in the hand.
        vessel: What to draw from.
        further: How much further than to the first stop, in parts of that.
        gap: Height of the tip above the base of the vessel [m].
        clearance: Height of the tip above the mouth before and after [m].
        pause_s: Wait for the liquid to follow [s].
    """

    pipette: Workable
    vessel: OpenVessel
    further: float = 0.005
    gap: float = 0.005
    clearance: float = 0.04
    pause_s: float = 0.8

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield over, press, dip, release, wait and lift out."""
        pipette, vessel, own = self.pipette, self.vessel, bodies(self.pipette)
        held = Held(pipette, own | {vessel.name})
        away, there = arrived(within=0.006), arrived(within=0.003)
        rest = world.commanded_opening
        over = held.tip_over(world, vessel, self.clearance)
        yield Phase("over", over, rest, away, own, pipette, timeout_s=10.0)
        stroke = held.at_rest(world) + (1.0 + self.further) * pipette.stroke
        yield from held.press(world, "press", over, stroke)
        pressed = world.commanded_opening
        deep = held.tip_over(world, vessel, self.gap - vessel.height)
        yield Phase("dip", deep, pressed, there, held.touches, pipette, speed=0.06)
        yield Phase("settle", deep, pressed, waited(0.3), held.touches, pipette)
        yield from held.release(world, deep)
        rest = world.commanded_opening
        yield Phase("wait", deep, rest, waited(self.pause_s), held.touches, pipette)
        out = held.tip_over(world, vessel, self.clearance)
        yield Phase("lift out", out, rest, away, held.touches, pipette, speed=0.06)
        yield Phase("hold", out, rest, waited(0.2), own, pipette)
