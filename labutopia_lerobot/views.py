"""Where the two fixed cameras of a scene are."""

from dataclasses import dataclass

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class CameraPose:
    """A fixed camera.

    Attributes:
        position_w: Where it is [m], world frame.
        direction_w: Where it looks, world frame; need not be of unit length.
        up_w: What is up in its picture, world frame.
        field_of_view_deg: Vertical field of view [deg].
    """

    position_w: Vector
    direction_w: Vector
    up_w: Vector
    field_of_view_deg: float


@dataclass(frozen=True)
class View:
    """The cameras `front` and `top` of a task."""

    front: CameraPose
    top: CameraPose


_UP = (0.0, 0.0, 1.0)
_FORWARD = (1.0, 0.0, 0.0)

VESSEL_VIEW = View(
    front=CameraPose((2.0, 0.0, 2.0), (-0.866, 0.0, -0.5), _UP, 20.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 26.0),
)
"""Facing the robot and overhead, as in the original's vessel tasks, whose focal length of 6 gives
20 degrees; the overhead camera is widened so that the whole region is in view."""
