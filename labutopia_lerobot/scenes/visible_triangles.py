"""Triangles that a fixed camera can see."""

import math

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.scenes.views import MOST_DISPLACED, WIDEST_PICTURE, CameraPose

_MARGIN = MOST_DISPLACED + 0.02
"""Margin by which a thing may be nearer to the picture than it is [m]."""


def visible_triangles(mesh: Shell, camera: CameraPose) -> NDArray[np.bool_]:
    """Return for each triangle whether a camera, or one that is displaced, may see its front.

    What stands before what is not asked.

    Args:
        mesh: In the world's frame.
        camera: The camera.

    Returns:
        Shape (triangles,).
    """
    vertices, _, faces = mesh
    ahead = np.array(camera.direction_w) / np.linalg.norm(camera.direction_w)
    right = np.cross(ahead, camera.up_w)
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    away = vertices - np.array(camera.position_w)
    depth = away @ ahead
    high = math.tan(math.radians(camera.field_of_view_deg) / 2)
    wide = high * WIDEST_PICTURE
    inside = (depth > -_MARGIN)[faces].any(axis=1)
    for axis, slope in ((right, wide), (up, high)):
        lateral, margin = away @ axis, _MARGIN * math.hypot(1.0, slope)
        for side in (-1.0, 1.0):
            inside &= (side * lateral < slope * depth + margin)[faces].any(axis=1)
    first, second, third = np.moveaxis(away[faces], 1, 0)
    normal = np.cross(second - first, third - first)
    length = np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    faces_it = -np.einsum("ij,ij->i", first, normal) / length > -_MARGIN
    return np.asarray(inside & faces_it)
