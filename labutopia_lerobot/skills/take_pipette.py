"""Take a pipette by its grips from the hook that it hangs on."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.pipette_in_hand import HOLD, Workable, bodies
from labutopia_lerobot.skills.posture import pointing
from labutopia_lerobot.skills.skill import Phase, arrived, at, waited
from labutopia_lerobot.world import Pose, Thing, World


@dataclass(frozen=True)
class TakePipette:
    """Go before it, reach, close lightly, unhook, draw back and raise it.

    Attributes:
        pipette: What to take; x of its frame points away from the column of the stand.
        stand: What it hangs on.
        carousel: What of that carries the hooks.
        standoff: Distance from which the hand approaches, and to which it draws back [m].
        unhook: How far it is lifted off the prongs [m].
        lift: How much higher than it hung it is held at the end [m]: the hand then clears the
            top of the stand.
    """

    pipette: Workable
    stand: Thing
    carousel: Thing
    standoff: float = 0.12
    unhook: float = 0.012
    lift: float = 0.14

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield before, reach, settle, close, unhook, draw back and raise."""
        pipette, own = self.pipette, bodies(self.pipette)
        wide, shut = world.robot.max_opening, self.pipette.grip_width - HOLD
        away, there = arrived(within=0.015, within_rad=0.1), arrived(within=0.003, within_rad=0.03)
        grasp = self._grasp(world)
        yield Phase("before", at(grasp.advanced(-self.standoff)), wide, away, timeout_s=8.0)
        yield Phase("reach", at(grasp), wide, there, own, speed=0.15)
        yield Phase("settle", at(grasp), wide, waited(0.2), own)
        yield Phase("close", at(grasp), shut, waited(1.2), own)
        on_hook = own | {self.stand.name, self.carousel.name}
        free = grasp.moved(z=self.unhook)
        yield Phase("unhook", at(free), shut, there, on_hook, pipette, speed=0.05)
        back = free.advanced(-self.standoff)
        yield Phase("draw back", at(back), shut, away, on_hook, pipette, speed=0.15)
        raised = back.moved(z=self.lift)
        yield Phase("raise", at(raised), shut, away, own, pipette, speed=0.15)

    def _grasp(self, world: World) -> Pose:
        """Return the gripper pose around the grips, from outside."""
        here = world.pose(self.pipette)
        inward = -here.x_axis
        point = here.position_w + self.pipette.grip_height * here.z_axis
        yaw = math.atan2(inward[1], inward[0])
        return pointing(point, yaw, world.robot.vessel_approach.pitch)
