"""The laboratory as a MuJoCo spec: bench, pedestal, lights and the two fixed cameras."""

from collections.abc import Callable

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.scenes.building.surfaces_model import add_floor_material
from labutopia_lerobot.scenes.room import PEDESTAL, Room
from labutopia_lerobot.scenes.textures import PATTERNS, SIZE, texture
from labutopia_lerobot.scenes.views import CameraPose, View
from labutopia_lerobot.world import BENCH, ROOM
from labutopia_lerobot.world.model import SOLIMP, SOLREF

_BOX = mujoco.mjtGeom.mjGEOM_BOX
_BENCH_FRICTION = (0.5, 0.005, 0.0001)
"""Sliding friction of glass on a phenolic resin top; glass on glass is 0.4 to 0.9 (greasy to dry,
CRC Handbook, "Coefficients of friction")."""

_WHITE = (0.90, 0.91, 0.92, 1.0)
_GREY = (0.60, 0.63, 0.66, 1.0)
_STEEL = (0.42, 0.45, 0.49, 1.0)
_TOP = (0.35, 0.39, 0.44, 1.0)
KEY_LAMP = "key"
"""Name of the brighter lamp."""
_TILES_PER_M = 2.5
"""Repetitions of a texture of the bench top [1/m]."""


def laboratory(
    room: Room, view: View, surround: Callable[[mujoco.MjSpec], None] | None = None
) -> mujoco.MjSpec:
    """Return the room, with bench, robot pedestal, lights and the cameras `front` and `top`.

    Args:
        room: Where bench and robot are in it.
        view: Where the cameras are.
        surround: Adds the body `world.ROOM`; a plain one with four walls by default.
    """
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.modelname = "laboratory"
    # All that does not say otherwise is as hard as glass: MuJoCo takes the mean of the two.
    spec.default.geom.solref[:] = SOLREF
    spec.default.geom.solimp[:] = SOLIMP
    _materials(spec)
    (surround or _walls)(spec)
    _bench(spec, room)
    add_lights(spec)
    if not view.on_base:
        add_cameras(spec.worldbody, view)
    return spec


def _materials(spec: mujoco.MjSpec) -> None:
    for name, rgba in (("wall", _WHITE), ("cabinet", _GREY), ("steel", _STEEL)):
        spec.add_material(name=name, rgba=rgba, specular=0.1, shininess=0.1)
    spec.add_material(  # plain: a texture on so large a face costs a tenth of the picture
        name="bench_top",
        rgba=_TOP,
        specular=0.25,
        shininess=0.3,
        texuniform=True,
        texrepeat=[_TILES_PER_M] * 2,
    )
    for name in PATTERNS:  # what an episode may give the bench top (sim/appearance.py)
        kind = mujoco.mjtTexture.mjTEXTURE_2D
        drawn = spec.add_texture(name=name, type=kind, width=SIZE, height=SIZE, nchannel=3)
        drawn.data = texture(name).tobytes()


def _walls(spec: mujoco.MjSpec) -> None:
    add_floor_material(spec, "grey vinyl")
    room = spec.worldbody.add_body(name=ROOM)
    room.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[3.0, 3.0, 0.1],
        material="floor",
    )
    room.add_geom(
        name="ceiling",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        pos=[0.0, 0.0, 3.0],
        quat=[0.0, 1.0, 0.0, 0.0],  # downwards; MuJoCo lets one look through from above
        size=[3.0, 3.0, 0.1],
        material="wall",
        contype=0,
        conaffinity=0,
    )
    walls = {
        "wall_back": ([-1.5, 0.0, 1.5], [0.05, 3.0, 1.5]),
        "wall_front": ([2.55, 0.0, 1.5], [0.05, 3.0, 1.5]),
        "wall_left": ([0.5, 2.5, 1.5], [2.0, 0.05, 1.5]),
        "wall_right": ([0.5, -2.5, 1.5], [2.0, 0.05, 1.5]),
    }
    for name, (position, size) in walls.items():
        room.add_geom(name=name, type=_BOX, pos=position, size=size, material="wall")
    for index, y in enumerate((-1.2, 0.0, 1.2)):
        room.add_geom(
            name=f"wall_cabinet_{index}",
            type=_BOX,
            pos=[-1.3, y, 1.9],
            size=[0.15, 0.56, 0.35],
            material="cabinet",
            contype=0,
            conaffinity=0,
        )


def _bench(spec: mujoco.MjSpec, room: Room) -> None:
    """Add the bench and the pedestal that carries the robot."""
    (x_min, x_max), (y_min, y_max) = room.bench.x, room.bench.y
    middle = [(x_min + x_max) / 2, (y_min + y_max) / 2, room.bench.height]
    half_x, half_y = (x_max - x_min) / 2, (y_max - y_min) / 2
    bench = spec.worldbody.add_body(name=BENCH, pos=middle)
    bench.add_geom(
        name="bench_top",
        type=_BOX,
        pos=[0.0, 0.0, -0.015],
        size=[half_x, half_y, 0.015],
        material="bench_top",
        friction=_BENCH_FRICTION,
    )
    bench.add_geom(
        name="bench_body",
        type=_BOX,
        pos=[0.02, 0.0, -0.03 - 0.37],
        size=[half_x - 0.06, half_y - 0.04, 0.37],
        material="cabinet",
    )
    x, y, z = room.robot_stand
    spec.worldbody.add_body(name=PEDESTAL, pos=[x, y, 0.0]).add_geom(
        name="pedestal",
        type=_BOX,
        pos=[-0.03, 0.0, z / 2],
        size=[0.15, 0.15, z / 2],
        material="steel",
    )


def add_lights(spec: mujoco.MjSpec) -> None:
    """Two unequal directional lights and a weak headlight: every face of a box shades differently.

    No light casts a shadow: shadow maps cost two to five times the whole image on a CPU.
    """
    spec.visual.headlight.ambient = [0.48, 0.48, 0.49]
    spec.visual.headlight.diffuse = [0.10, 0.10, 0.10]
    spec.visual.headlight.specular = [0.15, 0.15, 0.15]
    for name, direction, diffuse in (
        (KEY_LAMP, [-0.45, 0.55, -0.9], 0.42),
        ("fill", [0.7, -0.6, -0.5], 0.18),
    ):
        spec.worldbody.add_light(
            name=name,
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            dir=direction,
            diffuse=[diffuse] * 3,
            ambient=[0.0] * 3,
            specular=[0.4 * diffuse] * 3,
            castshadow=False,
        )


def add_cameras(body: mujoco.MjsBody, view: View) -> None:
    """Add the cameras `front` and `top` to the body in whose frame they are."""
    _add_camera(body, "front", view.front)
    _add_camera(body, "top", view.top)


def _add_camera(body: mujoco.MjsBody, name: str, pose: CameraPose) -> None:
    """Add a camera: its -z axis along the direction, its y axis towards what is up."""
    back = -np.array(pose.direction_w) / np.linalg.norm(pose.direction_w)
    right = np.cross(pose.up_w, back)
    right /= np.linalg.norm(right)
    axes = np.column_stack([right, np.cross(back, right), back])
    body.add_camera(
        name=name,
        pos=pose.position_w,
        quat=Rotation.from_matrix(axes).as_quat(scalar_first=True),
        fovy=pose.field_of_view_deg,  # in degrees, whatever the compiler's unit
    )
