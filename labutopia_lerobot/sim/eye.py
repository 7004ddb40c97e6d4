"""Where a picture is taken from: an eye that stands at a camera or anywhere else, and its turns."""

import math

import mujoco
import numpy as np

from labutopia_lerobot.scenes.views import CameraPose
from labutopia_lerobot.world import FloatArray

_PARTS = (
    *("pos", "forward", "up", "orthographic", "frustum_center", "frustum_width"),
    *("frustum_bottom", "frustum_top", "frustum_near", "frustum_far"),
)
"""All that an eye is."""


def eye_of_camera(model: mujoco.MjModel, data: mujoco.MjData, camera: str) -> mujoco.MjvGLCamera:
    """Return the eye of a camera of the model, where it is now."""
    named = mujoco.MjvCamera()
    named.type, named.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, model.camera(camera).id
    return mujoco.mjv_camera2GLCamera(model, data, named)


def eye_at(model: mujoco.MjModel, pose: CameraPose) -> mujoco.MjvGLCamera:
    """Return an eye that is at no camera of the model."""
    eye = mujoco.MjvGLCamera()
    forward = _unit(np.array(pose.direction_w))
    right = _unit(np.cross(forward, np.array(pose.up_w)))
    eye.pos, eye.forward, eye.up = pose.position_w, forward, np.cross(right, forward)
    eye.frustum_near = model.vis.map.znear * model.stat.extent
    eye.frustum_far = model.vis.map.zfar * model.stat.extent
    eye.frustum_top = eye.frustum_near * math.tan(math.radians(pose.field_of_view_deg) / 2)
    eye.frustum_bottom = -eye.frustum_top
    return eye


def copy_eye(eye: mujoco.MjvGLCamera, to: mujoco.MjvGLCamera) -> None:
    """Make another eye see what one sees."""
    for name in _PARTS:
        setattr(to, name, getattr(eye, name))


def turned_by_pixels(
    eye: mujoco.MjvGLCamera, right: float, up: float, height: int
) -> mujoco.MjvGLCamera:
    """Return an eye that looks further right and up by parts of a pixel of the picture's middle.

    Args:
        eye: The eye; it stays as it is.
        right: How far to the right [pixels].
        up: How far up [pixels].
        height: Height of the picture [pixels].
    """
    pixel = (eye.frustum_top - eye.frustum_bottom) / height / eye.frustum_near  # [rad]
    forward, upward = np.array(eye.forward, float), np.array(eye.up, float)
    aside = np.cross(forward, upward)
    other = mujoco.MjvGLCamera()
    copy_eye(eye, other)
    other.forward = _unit(forward + pixel * (right * aside + up * upward))
    other.up = _unit(np.cross(aside, other.forward))
    return other


def _unit(vector: FloatArray) -> FloatArray:
    length: FloatArray = vector / np.linalg.norm(vector)
    return length
