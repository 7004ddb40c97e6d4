"""Poses of the two fixed cameras of a scene."""

from dataclasses import dataclass

Vector = tuple[float, float, float]

FIXED_CAMERAS = ("front", "top")
"""Those of a `View`."""

WIDEST_PICTURE = 2.0
"""Width over height up to which rooms leave out what the fixed cameras cannot see."""

MOST_DISPLACED = 0.08
"""Greatest displacement of the fixed cameras by the axis `camera` [m]."""


@dataclass(frozen=True)
class CameraPose:
    """A fixed camera.

    Attributes:
        position_w: Where it is [m], world frame.
        direction_w: Where it looks, world frame; need not be of unit length.
        up_w: Direction that is up in its picture, world frame.
        field_of_view_deg: Vertical field of view [deg].
    """

    position_w: Vector
    direction_w: Vector
    up_w: Vector
    field_of_view_deg: float


@dataclass(frozen=True)
class View:
    """The cameras `front` and `top` of a task.

    Attributes:
        front: One of them.
        top: The other.
        on_base: Whether they ride on a mobile base: their poses are then in its frame.
    """

    front: CameraPose
    top: CameraPose
    on_base: bool = False


_UP = (0.0, 0.0, 1.0)
_FORWARD = (1.0, 0.0, 0.0)

VESSEL_VIEW = View(
    front=CameraPose((2.0, 0.0, 2.0), (-0.866, 0.0, -0.5), _UP, 20.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 26.0),
)
"""Facing the robot and overhead, as in the original's vessel tasks, whose focal length of 6 gives
20 degrees; the overhead camera is widened so that the whole region is in view."""

WIDE_VESSEL_VIEW = View(
    front=CameraPose((2.0, 0.0, 2.0), (-0.866, 0.0, -0.5), _UP, 24.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 31.0),
)
"""The same from a focal length of 5, as in the original's tasks with two things side by side."""

WIDEST_VESSEL_VIEW = View(
    front=CameraPose((2.0, 0.0, 2.0), (-0.866, 0.0, -0.45), _UP, 29.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 38.0),
)
"""The same from a focal length of about 4, as in the original's stirring tasks; the camera in front
looks 2 degrees higher, for the hand of a lifted rod."""

DOOR_VIEW = View(
    front=CameraPose((-0.7, 1.4, 1.4), (0.548, -0.807, -0.222), _UP, 55.3),
    top=CameraPose((-1.0, -0.1, 3.6), (0.423, 0.0, -0.906), _FORWARD, 29.3),
)
"""Over the robot's left shoulder, and from above and behind: a camera that faces the robot would
see the back of an instrument. As in the original's door and drawer tasks."""

DRAWER_VIEW = View(
    front=CameraPose((-0.7, 1.4, 1.4), (0.61, -0.762, -0.17), _UP, 33.0),
    top=CameraPose((-1.0, -0.1, 3.6), (0.423, 0.0, -0.906), _FORWARD, 29.3),
)
"""Like `DOOR_VIEW`, but nearer in front: the other has room for a door that swings open."""

FURNACE_VIEW = View(
    front=CameraPose((-0.7, 1.4, 1.4), (0.577, -0.787, -0.292), _UP, 47.0),
    top=DOOR_VIEW.top,
)
"""Like `DOOR_VIEW`, but nearer in front and lower, for the vessels and plates before a furnace."""

OVEN_VIEW = View(
    front=CameraPose((-0.7, -1.3, 1.7), (0.548, 0.72, -0.38), _UP, 41.0),
    top=CameraPose((-1.0, -0.1, 3.6), (0.423, 0.0, -0.906), _FORWARD, 29.3),
)
"""Over the robot's right shoulder, where the open door does not hide the chamber, near enough for
the beakers before the oven; and from above and behind, as `DOOR_VIEW`."""

PRESS_VIEW = View(
    front=CameraPose((-0.1, 1.8, 1.5), (0.233, -0.943, -0.2), _UP, 13.5),
    top=CameraPose((0.15, -0.08, 3.012), (0.0, 0.0, -1.0), _FORWARD, 23.7),
)
"""Over the robot's left shoulder, where the buttons and the finger that presses are in view, so
near that a button fills 24 of 256 pixels, and overhead. The original looks from the far right of
the robot, through what is a wall here, along the panel."""

KNOB_VIEW = View(
    front=CameraPose((-0.15, 1.25, 1.5), (0.574, -1.10, -0.26), _UP, 20.0),
    top=DOOR_VIEW.top,
)
"""Over the robot's left shoulder, where the knob and the display of an instrument on a stand are
in view; and as `DOOR_VIEW`."""

CENTRIFUGE_VIEW = View(
    front=CameraPose((-0.7, 1.4, 1.4), (0.60, -0.757, -0.245), _UP, 30.0),
    top=DOOR_VIEW.top,
)
"""Like `DOOR_VIEW`, but so near in front that one sees which key of an instrument is pressed."""

TUBES_VIEW = View(
    front=CameraPose((-0.7, 1.4, 1.4), (0.478, -0.827, -0.294), _UP, 32.0),
    top=WIDE_VESSEL_VIEW.top,
)
"""Like `CENTRIFUGE_VIEW`, with a rack beside a small centrifuge in view."""

BURETTE_VIEW = View(
    front=CameraPose((0.62, 1.25, 1.42), (-0.26, -1.25, -0.14), _UP, 50.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 31.0),
)
"""From the left, past the arm, where a burette is in view from its mouth to the flask below it; and
overhead."""

TITRATION_VIEW = View(
    front=CameraPose((-0.20, 0.95, 1.85), (0.66, -1.03, -0.93), _UP, 27.0),
    top=CameraPose((0.42, 0.0, 2.3), (0.0, 0.0, -1.0), _FORWARD, 25.0),
)
"""Over the hand at a burette's wing, near enough for the display of the pH meter behind it; and
overhead."""

PIPETTE_VIEW = View(
    front=CameraPose((1.10, -0.75, 1.45), (-0.88, 0.80, -0.50), _UP, 27.0),
    top=CameraPose((0.1, 0.0, 2.5), (0.0, 0.0, -1.0), _FORWARD, 31.0),
)
"""From the right of the bench, near enough for a pipette's tip in a beaker; and overhead."""

DISSOLVING_VIEW = View(
    front=CameraPose((0.62, -0.85, 1.20), (-0.40, 0.84, -0.37), _UP, 37.0),
    top=CameraPose((1.10, 0.0, 2.10), (-0.85, 0.0, -1.20), _UP, 38.0),
)
"""From the right end of the bench, so near to a beaker there that one sees what lies on its bottom,
the rack behind it; and from above and in front."""

DRIVING_VIEW = View(
    front=CameraPose((0.05, -0.25, 1.75), (0.80, 0.10, -0.60), _UP, 70.0),
    top=CameraPose((0.45, 0.0, 2.75), (0.0, 0.0, -1.0), _FORWARD, 75.0),
    on_base=True,
)
"""On a mast of a robot that drives, where it looks ahead over its arm to the floor and the benches
before it; and from above it, under the ceiling, which goes with it. Ours: the paper has none."""
