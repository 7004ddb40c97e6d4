"""Floor, walls and ceiling of a plan as geoms, and the materials of them."""

from collections.abc import Iterable

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.scenes.building.masonry import Box, Masonry, shell_of
from labutopia_lerobot.scenes.building.surfaces import (
    FLOOR_REPEATS,
    SIZE,
    ceiling_texture,
    floor_texture,
)
from labutopia_lerobot.scenes.finishes import FLOOR_FINISHES, WALL_FINISHES, Finish
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

_PLANE = mujoco.mjtGeom.mjGEOM_PLANE
_TEXTURE = mujoco.mjtTexture.mjTEXTURE_2D
_RGB = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)

CEILING_LIGHT = 0.45
"""Share of its colour that the ceiling emits by itself."""
LOOKS = {
    "skirting": Finish((0.38, 0.40, 0.42, 1.0), 0.1, 0.1),
    "cap": Finish((0.30, 0.31, 0.33, 1.0), 0.0, 0.0),
    "sky": Finish((0.80, 0.90, 0.98, 1.0), 0.0, 0.0),
}
"""Finishes of skirting boards, of cut-off walls as seen from above, of the view in windows."""
_SKIRTING = (0.070, 0.004)
"""Height, and how far it stands out [m]."""


def add_surface_materials(spec: mujoco.MjSpec, plan: Plan) -> None:
    """Add the materials `floor`, `wall`, `ceiling`, `skirting`, `cap` and `sky`, or change them."""
    add_floor_material(spec, plan.floor)
    _material(spec, "wall", WALL_FINISHES[plan.wall])
    picture = ceiling_texture(plan.size[0], plan.size[1])
    high, wide, _ = picture.shape
    drawn = spec.add_texture(name="ceiling", type=_TEXTURE, width=wide, height=high, nchannel=3)
    drawn.data = picture.tobytes()
    ceiling = _material(spec, "ceiling", Finish((0.92, 0.93, 0.93, 1.0), 0.0, 0.0))
    ceiling.emission, ceiling.texrepeat = CEILING_LIGHT, [1.0, 1.0]
    ceiling.textures[_RGB] = "ceiling"
    for name, finish in LOOKS.items():
        _material(spec, name, finish)
    spec.material("sky").emission = 0.9


def add_floor_material(spec: mujoco.MjSpec, floor: str) -> None:
    """Add the material `floor`, one of `FLOOR_FINISHES`, or change it."""
    kind = floor.rpartition(" ")[2]
    repeats = 2.0 / FLOOR_REPEATS[kind]  # of a plane MuJoCo counts them by its half sizes
    drawn = spec.add_texture(name="flooring", type=_TEXTURE, width=SIZE, height=SIZE, nchannel=3)
    drawn.data = floor_texture(kind).tobytes()
    material = _material(spec, "floor", FLOOR_FINISHES[floor])
    material.texuniform, material.texrepeat = True, [repeats, repeats]
    material.textures[_RGB] = "flooring"


def _material(spec: mujoco.MjSpec, name: str, finish: Finish) -> mujoco.MjsMaterial:
    material = spec.material(name) or spec.add_material(name=name)
    material.rgba = finish.rgba
    material.specular, material.shininess = finish.specular, finish.shininess
    return material


def add_surfaces(room: mujoco.MjsBody, plan: Plan) -> None:
    """Add the planes `floor` and `ceiling` to a body whose frame is the room's."""
    width, depth, height = plan.size
    half = [width / 2, depth / 2, 0.1]
    middle = [width / 2, depth / 2]
    room.add_geom(name="floor", type=_PLANE, pos=[*middle, 0.0], size=half, material="floor")
    room.add_geom(
        name="ceiling",
        type=_PLANE,
        pos=[*middle, height],
        quat=[0.0, 1.0, 0.0, 0.0],  # downwards; the renderer takes it off for who is above it
        size=half,
        material="ceiling",
        contype=0,
        conaffinity=0,
    )


def add_wall_solids(room: mujoco.MjsBody, boxes: Iterable[Box], name: str = "wall") -> None:
    """Add what is touched of walls, geoms of a name with numbers."""
    for number, spans in enumerate(boxes):
        low, high = np.array(spans).T
        room.add_geom(
            name=f"{name}_{number}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=(low + high) / 2,
            size=(high - low) / 2,
            group=COLLISION_GROUP,
        )


def add_wall_looks(spec: mujoco.MjSpec, room: mujoco.MjsBody, walls: list[Masonry]) -> None:
    """Add what is seen of walls: one mesh a material."""
    faces_of = {
        "wall": [face for wall in walls for face in wall.faces()],
        "cap": [face for wall in walls for face in wall.caps()],
        "skirting": [face for wall in walls for face in wall.skirting(*_SKIRTING)],
        "sky": [face for wall in walls for face in wall.panes()],
    }
    for name, faces in faces_of.items():
        if faces:
            _add_mesh(spec, room, name, shell_of(faces))


def _add_mesh(spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, mesh: Shell) -> None:
    vertices, normals, faces = mesh
    spec.add_mesh(
        name=name,
        uservert=vertices.ravel(),
        usernormal=normals.ravel(),
        userface=faces.ravel(),
        userfacenormal=faces.ravel(),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
    )
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_MESH,
        meshname=name,
        material=name,
        group=VISUAL_GROUP,
        contype=0,
        conaffinity=0,
    )
