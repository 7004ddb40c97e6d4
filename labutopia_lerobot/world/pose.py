"""Positions and orientations of frames in the world."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Position and orientation of a frame in the world.

    `Pose(position_w, rotation_w)` makes one. `a @ b` is the pose in the world of what is at `b` in
    the frame `a`.

    Attributes:
        position_w: Origin of the frame, shape (3,), metres, world frame.
        rotation_w: Axes of the frame as columns, shape (3, 3), world frame.
    """

    position_w: FloatArray
    rotation_w: FloatArray

    @property
    def quat_wxyz(self) -> FloatArray:
        """Orientation as a scalar-first unit quaternion, shape (4,)."""
        from scipy.spatial.transform import Rotation  # here: names of robots must come at once

        quat_wxyz: FloatArray = Rotation.from_matrix(self.rotation_w).as_quat(scalar_first=True)
        return quat_wxyz

    @property
    def x_axis(self) -> FloatArray:
        """First axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 0]

    @property
    def y_axis(self) -> FloatArray:
        """Second axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 1]

    @property
    def z_axis(self) -> FloatArray:
        """Third axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 2]

    @property
    def tilt(self) -> float:
        """Angle between the frame's z axis and the vertical [rad]."""
        return math.acos(min(1.0, max(-1.0, self.rotation_w[2, 2])))

    def __matmul__(self, other: "Pose") -> "Pose":
        """Express a pose given in this frame in the world."""
        return Pose(
            self.position_w + self.rotation_w @ other.position_w,
            self.rotation_w @ other.rotation_w,
        )

    def inverse(self) -> "Pose":
        """Return the pose of the world in this frame."""
        return Pose(-self.rotation_w.T @ self.position_w, self.rotation_w.T)

    def local(self, point_w: FloatArray) -> FloatArray:
        """Return where a point of the world is in this frame, shape (3,) [m]."""
        point: FloatArray = self.rotation_w.T @ (point_w - self.position_w)
        return point

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Pose":
        """Return the same orientation, displaced along the world's axes [m]."""
        return Pose(self.position_w + np.array([x, y, z]), self.rotation_w)

    def advanced(self, distance: float) -> "Pose":
        """Return the same orientation, displaced along the frame's own z axis [m]."""
        return Pose(self.position_w + distance * self.z_axis, self.rotation_w)

    def turned(self, angle: float) -> "Pose":
        """Return the same origin, turned about the frame's own z axis [rad]."""
        turn = Rotation.from_euler("z", angle).as_matrix()
        return Pose(self.position_w, self.rotation_w @ turn)

    def distance_to(self, other: "Pose") -> float:
        """Return the distance between the two origins [m]."""
        offset = other.position_w - self.position_w
        return math.sqrt(offset @ offset)

    def angle_to(self, other: "Pose") -> float:
        """Return the angle of the rotation between the two frames [rad]."""
        cosine = 0.5 * (np.trace(self.rotation_w.T @ other.rotation_w) - 1.0)
        return float(np.arccos(np.clip(cosine, -1.0, 1.0)))
