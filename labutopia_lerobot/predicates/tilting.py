"""Facts about tilting a vessel."""

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World


def tilted(thing: Thing, *, beyond_deg: float) -> Predicate:
    """Axis of the thing leans more than `beyond_deg` degrees from the vertical."""
    limit = np.radians(beyond_deg)
    return Predicate(
        f"{thing.name} tilted beyond {beyond_deg:g} deg",
        lambda world: world.pose(thing).tilt > limit,
    )


def lip_over(vessel: OpenVessel, target: OpenVessel, *, below: float) -> Predicate:
    """Lowest point of the lip is over the target's mouth, less than `below` metres above it."""

    def holds(world: World) -> bool:
        x, y, z = _lip(world, vessel) - world.frame(target.rim).position_w
        return bool(np.hypot(x, y) < target.mouth_radius and 0.0 < z < below)

    return Predicate(f"{vessel.name} lip less than {below:g} m over {target.name}", holds)


def _lip(world: World, vessel: OpenVessel) -> FloatArray:
    """Lowest point of the vessel's lip, shape (3,), metres, world frame."""
    rim = world.frame(vessel.rim)
    # The part of "down" that lies in the plane of the rim.
    slope: FloatArray = rim.z_axis * rim.z_axis[2] - (0.0, 0.0, 1.0)
    lip: FloatArray = slope * vessel.mouth_radius / max(float(np.linalg.norm(slope)), 1e-9)
    return rim.position_w + lip
