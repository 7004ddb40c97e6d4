"""A camera that turns about a point, as a mouse moves it."""

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from labutopia_lerobot.scenes.views import CameraPose
from labutopia_lerobot.world import FloatArray

_STEEPEST = math.radians(85.0)
_NEAREST, _FARTHEST = 0.25, 6.0
"""Distances of the camera from the point [m]: between a thing's size and a room's."""


@dataclass(frozen=True)
class Orbit:
    """Where a camera is, seen from the point that it looks at.

    Attributes:
        target_w: The point [m], world frame.
        heading: About the vertical, 0 along x [rad].
        height: Angle above the horizontal [rad].
        distance: [m].
        field_of_view_deg: Vertical field of view [deg].
    """

    target_w: tuple[float, float, float]
    heading: float
    height: float
    distance: float
    field_of_view_deg: float

    @classmethod
    def about(cls, target_w: FloatArray, pose: CameraPose) -> Self:
        """Return the orbit that a camera is on, about what of its line of sight is nearest."""
        position, forward = np.array(pose.position_w), np.array(pose.direction_w)
        forward /= np.linalg.norm(forward)
        distance = max(float((target_w - position) @ forward), _NEAREST)
        x, y, z = (position + distance * forward).tolist()
        heading = math.atan2(-forward[1], -forward[0])
        return cls((x, y, z), heading, math.asin(-forward[2]), distance, pose.field_of_view_deg)

    @property
    def pose(self) -> CameraPose:
        """The camera, z up."""
        level = math.cos(self.height)
        forward = (
            -level * math.cos(self.heading),
            -level * math.sin(self.heading),
            -math.sin(self.height),
        )
        x, y, z = (
            at - self.distance * along for at, along in zip(self.target_w, forward, strict=True)
        )
        return CameraPose((x, y, z), forward, (0.0, 0.0, 1.0), self.field_of_view_deg)

    def turned(self, right: float, up: float) -> Self:
        """Return it when the picture was dragged, by parts of its height; half a turn is 1."""
        height = min(max(self.height + math.pi * up, -_STEEPEST / 8), _STEEPEST)
        return replace(self, heading=self.heading - math.pi * right, height=height)

    def moved(self, right: float, up: float) -> Self:
        """Return it when what is in the picture was dragged along, by parts of its height."""
        seen = 2 * self.distance * math.tan(math.radians(self.field_of_view_deg) / 2)
        x, y, z = self.target_w
        x += seen * right * math.sin(self.heading)
        y -= seen * right * math.cos(self.heading)
        return replace(self, target_w=(x, y, max(z - seen * up, 0.0)))

    def nearer(self, by: float) -> Self:
        """Return it when the wheel was turned: nearer by a factor e for 1."""
        distance = min(max(self.distance * math.exp(-by), _NEAREST), _FARTHEST)
        return replace(self, distance=distance)
