"""Give out what a pipette holds into a vessel."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.pipette_in_hand import Held, Workable, bodies
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import OpenVessel, World


@dataclass(frozen=True)
class Dispense:
    """Go over the vessel, lower the tip to its bottom, press to the second stop, lift, release.

    A jet that falls far splashes: from 15 mm below the mouth one in a hundred lost a drop.

    Attributes:
        pipette: The pipette in the hand.
        vessel: What to give it into.
        gap: Height of the tip above the base of the vessel [m].
        clearance: Height of the tip above the mouth before and after [m].
        pause_s: Wait for the last drop [s].
    """

    pipette: Workable
    vessel: OpenVessel
    gap: float = 0.012
    clearance: float = 0.04
    pause_s: float = 0.5

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield over, lower, press, wait, lift out and release."""
        pipette, vessel, own = self.pipette, self.vessel, bodies(self.pipette)
        held = Held(pipette, own | {vessel.name})
        away, there = arrived(within=0.006), arrived(within=0.003)
        rest = world.commanded_opening
        over = held.tip_over(world, vessel, self.clearance)
        yield Phase("over", over, rest, away, own, pipette, timeout_s=10.0)
        low = held.tip_over(world, vessel, self.gap - vessel.height)
        yield Phase("lower", low, rest, there, held.touches, pipette, speed=0.08)
        yield from held.press(world, "press", low, pipette.stroke)
        yield from held.press(world, "blow out", low, pipette.full_stroke)
        pressed = world.commanded_opening
        yield Phase("wait", low, pressed, waited(self.pause_s), held.touches, pipette)
        out = held.tip_over(world, vessel, self.clearance)
        yield Phase("lift out", out, pressed, away, held.touches, pipette, speed=0.08)
        yield from held.release(world, out)
        yield Phase("hold", out, world.commanded_opening, waited(0.3), own, pipette)
