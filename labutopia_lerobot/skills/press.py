"""Press a button with the closed gripper."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import Button, Pose, World


@dataclass(frozen=True)
class Press:
    """The phases of the paper ("Press"), along the axis of the button, whatever its direction.

    Attributes:
        button: What to press.
        hold: How long it is kept in [s].
        standoff: Distance from which the press starts, and to which the hand leaves [m] (original:
            0.2).
        spacing: Distance between the pads while pressing [m] (original: 0.0015).
        beyond: How much further than the click the press aims, so that it surely comes [m].
    """

    button: Button
    hold: float
    standoff: float = 0.10
    spacing: float = 0.0
    beyond: float = 0.004

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, close, press, hold and leave."""
        button = self.button
        touches = frozenset({button.name})
        before = self._before(world)
        opening = world.commanded_opening
        yield Phase("approach", lambda w: before, opening, arrived(0.01, 0.1), timeout_s=8.0)
        yield Phase("close", lambda w: before, self.spacing, self._closed, timeout_s=2.0)
        inside = before.advanced(self.standoff + button.travel + self.beyond)
        yield Phase("press", lambda w: inside, self.spacing, self._clicked, touches, speed=0.06)
        yield Phase("hold", lambda w: inside, self.spacing, waited(self.hold), touches)
        yield Phase("leave", lambda w: before, self.spacing, arrived(0.01, 0.1), touches)

    def _before(self, world: World) -> Pose:
        """Gripper pose in front of the button, the finger tips at the stand-off."""
        distance = self.standoff + world.robot.finger_reach
        return world.frame(self.button.name).advanced(-distance)

    def _closed(self, world: World, target: Pose, elapsed: float) -> bool:
        still = arrived(within=0.004)(world, target, elapsed)
        return still and world.gripper_opening < self.spacing + 0.002

    def _clicked(self, world: World, target: Pose, elapsed: float) -> bool:
        return world.joint(self.button.joint) > self.button.travel + self.beyond / 4
