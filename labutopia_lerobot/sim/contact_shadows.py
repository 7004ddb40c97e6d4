"""Soft dark spots on the bench under what stands on it or hovers over it, in pictures only.

Shadow maps cost two to five times the picture on a CPU; a spot is one transparent square. It
distinguishes what stands from what hovers: with the height it grows and fades. Neither depth
nor segmentation has it.
"""

from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.scenes.room import Surface
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import COLLISION_GROUP

MATERIAL = "contact_shadow"
"""Name of the spots' material and of their texture."""

_SIZE = 64
_DARKEST = 0.24
"""Opacity in the middle of the spot under what stands; MuJoCo blends what is transparent twice."""
_MARGIN = 1.25
"""Half sides of the spot of what stands, in its half widths; the spot has faded there."""
_FADING = 0.10
"""Height at which a spot has faded by a factor e [m]."""
_GROWTH = 0.35
"""Growth of a spot's half sides per height [m/m]: the half angle of light from a lit ceiling."""
_FAINTEST = 0.015
"""Opacity below which a spot is left out."""
_NARROWEST = 1e-3
"""A spot so near the edge of the bench is left out [m]; of size 0 it would be endless."""
_LIFT = 4e-4
"""Height of spots above the bench [m]: they must not fight with its top for the same pixels."""


class Caster(NamedTuple):
    """A body that casts a spot, as a box around what is seen of it when it stands.

    Attributes:
        body: Its number.
        middle: Of the box, in the body's frame [m], shape (3,).
        half: Half sides of the box [m], shape (3,).
    """

    body: int
    middle: FloatArray
    half: FloatArray


def add_material(spec: mujoco.MjSpec) -> None:
    """Add what the spots are drawn in: black, and ever more transparent outwards."""
    at = (np.arange(_SIZE) + 0.5) / _SIZE * 2 - 1
    # Between a disc and a square: both vessels and instruments stand on it.
    away = (np.abs(at[:, None]) ** 2.6 + np.abs(at[None, :]) ** 2.6) ** (1 / 2.6)
    fall = np.clip((1.0 - away) / (1.0 - 0.45), 0.0, 1.0)
    picture = np.zeros((_SIZE, _SIZE, 4), np.uint8)
    picture[..., 3] = np.rint(255 * fall * fall * (3 - 2 * fall))
    texture = spec.add_texture(
        name=MATERIAL,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        nchannel=4,
        width=_SIZE,
        height=_SIZE,
    )
    texture.data = picture.tobytes()
    material = spec.add_material(name=MATERIAL, specular=0.0, shininess=0.0)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = MATERIAL


class ContactShadows:
    """The spots of a model.

    Args:
        model: With the material that `add_material` adds.
        bodies: Names of what casts them; what hangs on a body belongs to it.
        bench: What they fall on.
    """

    def __init__(self, model: mujoco.MjModel, bodies: Sequence[str], bench: Surface) -> None:
        self._material = model.material(MATERIAL).id
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        casters = (_caster(model, data, model.body(name).id) for name in bodies)
        self._casters = [caster for caster in casters if caster is not None]
        self._bench = bench

    def draw(self, scene: mujoco.MjvScene, data: mujoco.MjData) -> None:
        """Add the spots to an updated scene."""
        (x_min, x_max), (y_min, y_max) = self._bench.x, self._bench.y
        for body, middle, half in self._casters:
            axes = data.xmat[body].reshape(3, 3)
            x, y, z = data.xpos[body] + axes @ middle
            wide, deep, tall = np.abs(axes) @ half
            height = max(z - tall - self._bench.height, 0.0)
            opacity = _DARKEST * np.exp(-height / _FADING)
            size = [_MARGIN * side + _GROWTH * height for side in (wide, deep)]
            room = min(x - x_min, x_max - x, y - y_min, y_max - y)
            if opacity < _FAINTEST or room < _NARROWEST or z + tall < self._bench.height:
                continue
            geom = scene.geoms[scene.ngeom]
            mujoco.mjv_initGeom(
                geom,
                mujoco.mjtGeom.mjGEOM_PLANE,
                np.array([min(size[0], room), min(size[1], room), 0.1]),
                np.array([x, y, self._bench.height + _LIFT]),
                np.eye(3).ravel(),
                np.array([0.0, 0.0, 0.0, opacity], np.float32),
            )
            geom.matid = self._material
            geom.category = mujoco.mjtCatBit.mjCAT_DECOR
            geom.specular = geom.shininess = geom.reflectance = 0.0
            geom.segid = -1
            scene.ngeom += 1


def _caster(model: mujoco.MjModel, data: mujoco.MjData, root: int) -> Caster | None:
    """Return the box around what is seen of a body and all that hangs on it; None for what bends.

    Args:
        model: What they are in.
        data: With positions, at which the box is taken.
        root: Number of the body.
    """
    corners: list[NDArray[np.float64]] = []
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        while body not in (0, root):
            body = int(model.body_parentid[body])
        if body == root and model.geom_group[geom] < COLLISION_GROUP:
            centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
            signs = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T
            turn = data.geom_xmat[geom].reshape(3, 3)
            points = (signs * half + centre) @ turn.T + data.geom_xpos[geom]
            corners.append((points - data.xpos[root]) @ data.xmat[root].reshape(3, 3))
    if not corners:
        return None
    cloud = np.vstack(corners)
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    return Caster(root, (low + high) / 2, (high - low) / 2)
