"""A camera for films: near, from three quarters, with what the task is about in the middle.

The cameras of a task are a policy's: they see all that may happen, from afar. This one is chosen
for each episode from the poses around the task's own camera `front`, so that it looks from the same
side: the one from which most of the things are seen, and then most of the room behind them.
"""

import itertools
import math
from collections.abc import Iterator, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.scenes.views import CameraPose
from labutopia_lerobot.sim.scene import Scene, ancestors
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import COLLISION_GROUP

_ASIDE_DEG = (-35.0, 35.0, -25.0, 25.0, -50.0, 50.0)
"""Turns about the vertical, from the task's camera; the first are three quarters (ours)."""
_DOWN_DEG = (17.0, 24.0)
"""How far it looks down: low enough that one sees the room, and into glasses (ours)."""
_FIELD_DEG = 30.0
"""Vertical field of view: a 45 mm lens on 24 x 36 mm, which is near to how the eye sees."""
_FILLED = 0.85
"""Part of the picture's width and height within which all things are (ours)."""
_LIFTED = 0.22
"""How far above where it stands what is free is kept in view [m]: tasks lift by 0.2."""
_NEAREST = 0.85
"""Distance at least [m]: nearer, the hand would hide what it does."""
_DEEP = 5.0
"""Depth of a room from which more is not better [m]."""
_RAYS = (9, 5)
"""Lines of sight across and down by which the depth of a picture is judged."""
_ALL_SEEN = 0.02
"""Parts of the things by which poses may differ and count as equally good."""


def beauty_camera(
    scene: Scene, data: mujoco.MjData, front: CameraPose, aspect: float
) -> CameraPose:
    """Return the pose of the camera for an episode that has begun.

    Args:
        scene: The scene, compiled.
        data: Where everything stands.
        front: The task's own camera.
        aspect: Width over height of the picture.
    """
    corners = np.vstack([_corners(scene, data, piece.name) for piece in scene.pieces])
    lifted = [_corners(scene, data, each.name) for each in scene.pieces if each.movable]
    subject = np.vstack([corners, *(each + np.array([0.0, 0.0, _LIFTED]) for each in lifted)])
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    away = np.array(front.position_w) - middle
    heading = math.degrees(math.atan2(away[1], away[0]))
    best, best_score = front, (-1.0, -1.0)
    for down, aside in itertools.product(_DOWN_DEG, _ASIDE_DEG):
        pose = _framed(subject, math.radians(heading + aside), math.radians(down), aspect)
        seen = _seen_part(scene, data, pose, corners)
        score = (round(seen / _ALL_SEEN), _depth(scene, data, pose, aspect))
        if score > best_score:
            best, best_score = pose, score
    return best


def _corners(scene: Scene, data: mujoco.MjData, name: str) -> FloatArray:
    """Return the corners of the boxes around what is seen of a piece, shape (n, 3), world frame."""
    model, signs = scene.model, np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    boxes = [
        (model.geom_aabb[geom, :3] + signs * model.geom_aabb[geom, 3:])
        @ data.geom_xmat[geom].reshape(3, 3).T
        + data.geom_xpos[geom]
        for geom in _geoms(model, name)
    ]
    return np.vstack(boxes)


def _geoms(model: mujoco.MjModel, name: str) -> Iterator[int]:
    """Yield what is seen of a piece."""
    body = int(model.body(name).id)
    for geom in range(model.ngeom):
        if model.geom_group[geom] < COLLISION_GROUP and body in ancestors(
            model, model.geom_bodyid[geom]
        ):
            yield geom


def _framed(subject: FloatArray, heading: float, down: float, aspect: float) -> CameraPose:
    """Return a camera that has all points in the picture, as large as can be, and in its middle.

    Args:
        subject: The points, shape (n, 3), world frame.
        heading: Where it stands, seen from them, about the vertical [rad].
        down: How far it looks down [rad].
        aspect: Width over height of the picture.
    """
    level = math.cos(down)
    forward = np.array([-level * math.cos(heading), -level * math.sin(heading), -math.sin(down)])
    right = np.array([-math.sin(heading), math.cos(heading), 0.0])
    up = np.cross(right, forward)
    half = math.tan(math.radians(_FIELD_DEG) / 2) * _FILLED
    middle, distance = subject.mean(axis=0), _NEAREST
    for _ in range(8):  # what is nearer is drawn larger, so the middle depends on the distance
        from_middle = subject - middle
        depth = distance + from_middle @ forward
        across, high = (from_middle @ right) / depth, (from_middle @ up) / depth
        middle = middle + distance * (
            right * (across.min() + across.max()) / 2 + up * (high.min() + high.max()) / 2
        )
        from_middle = subject - middle
        wide = np.maximum(np.abs(from_middle @ right) / aspect, np.abs(from_middle @ up)) / half
        distance = max(_NEAREST, float((wide - from_middle @ forward).max()))
    x, y, z = (middle - distance * forward).tolist()
    return CameraPose((x, y, z), tuple(forward.tolist()), (0.0, 0.0, 1.0), _FIELD_DEG)


def _seen_part(scene: Scene, data: mujoco.MjData, pose: CameraPose, corners: FloatArray) -> float:
    """Return which part of some points no wall, furniture or arm hides from a camera."""
    model, eye = scene.model, np.array(pose.position_w)
    own = {geom for piece in scene.pieces for geom in _geoms(model, piece.name)}
    # From the points to the camera too, as it may stand within a cupboard.
    free = [
        _hit(model, data, eye, corner - eye, own) > 0.98
        and _hit(model, data, corner, eye - corner, own) >= 1.0
        for corner in corners
    ]
    return sum(free) / len(free)


def _hit(
    model: mujoco.MjModel, data: mujoco.MjData, start: FloatArray, along: FloatArray, own: set[int]
) -> float:
    """Return where a line first meets what is not the task's, in its lengths; infinite if not."""
    geom, gone = np.zeros(1, np.int32), 0.0
    while True:
        ahead: float = mujoco.mj_ray(
            model, data, start + gone * along, along, _seen_groups(), True, -1, geom
        )
        if ahead < 0.0:
            return math.inf
        gone += ahead
        if int(geom[0]) not in own:
            return gone
        if gone > 1.0:
            return math.inf
        gone += 1e-3


def _depth(scene: Scene, data: mujoco.MjData, pose: CameraPose, aspect: float) -> float:
    """Return how far one sees on average [m]: a wall across the picture is dull."""
    forward = np.array(pose.direction_w)
    right = np.cross(forward, pose.up_w)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    half = math.tan(math.radians(pose.field_of_view_deg) / 2)
    lines: Sequence[FloatArray] = [
        forward + half * (aspect * across * right + high * up)
        for across in np.linspace(-0.9, 0.9, _RAYS[0])
        for high in np.linspace(-0.9, 0.9, _RAYS[1])
    ]
    geom, eye = np.zeros(1, np.int32), np.array(pose.position_w)
    met = [
        mujoco.mj_ray(scene.model, data, eye, line, _seen_groups(), True, -1, geom)
        for line in lines
    ]
    return float(np.mean([min(far, _DEEP) if far >= 0.0 else _DEEP for far in met]))


def _seen_groups() -> NDArray[np.uint8]:
    """Return the groups of geoms that are drawn, as MuJoCo takes them."""
    return np.array([1, 1, 1, 0, 0, 0], np.uint8)
