"""A furnished room around the bench of a task: solid within reach, beyond that a picture."""

import math
from functools import cache, partial

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.scenes.building.masonry import masonry
from labutopia_lerobot.scenes.building.surfaces_model import (
    add_surface_materials,
    add_surfaces,
    add_wall_looks,
    add_wall_solids,
)
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.laboratory_model import laboratory
from labutopia_lerobot.scenes.plan import Plan, WorkPlace
from labutopia_lerobot.scenes.room import Room
from labutopia_lerobot.scenes.scenery import scenery
from labutopia_lerobot.scenes.space.claims import claims_of_piece
from labutopia_lerobot.scenes.views import View
from labutopia_lerobot.scenes.visible_triangles import visible_triangles
from labutopia_lerobot.world import ROOM, FloatArray
from labutopia_lerobot.world.model import BEYOND_GROUP, COLLISION_GROUP, VISUAL_GROUP

_SOLID_WITHIN = 1.25
"""Distance from the robot's base up to which things are solid [m]: the longest arm's 0.90, its hand
and what that holds."""
_FARTHEST_PIECE = 3.5
"""Whose middle is farther from the robot is not within its reach with any part [m]."""
_PALETTE = 16
"""Colours along a side of the palette."""
_CELL = 8
"""Pixels along a side of a colour, so that none bleeds into another."""
_SHINE = {"matt": (0.15, 0.2), "shiny": (0.6, 0.6), "clear": (0.9, 0.9)}
"""Specular and shininess of the looks of `scenery`."""
_CLEAR = 0.3
"""Opacity of all that is clear."""


def work_place(plan: Plan, room: Room, view: View) -> mujoco.MjSpec:
    """Return bench, robot's stand, floor, cameras, lights, and what is solid within reach."""
    return laboratory(room, view, partial(_surround, plan))


def decorate(plan: Plan, spec: mujoco.MjSpec, view: View) -> None:
    """Add what is seen and never touched to the body `world.ROOM`."""
    body = spec.body(ROOM)
    add_wall_looks(spec, body, masonry(plan))
    turn, pos = _frame(plan.work_places[0])
    _add_palette(spec, plan)
    for number, surface in enumerate(scenery(plan)):
        vertices, normals, faces = surface.mesh
        there = vertices @ turn.as_matrix().T + pos, normals, faces
        visible = visible_triangles(there, view.front) | visible_triangles(there, view.top)
        colors = _palette(plan)[1][number]
        for suffix, chosen, group in (
            ("", visible, VISUAL_GROUP),
            ("_beyond", ~visible, BEYOND_GROUP),
        ):
            if chosen.any():
                name, part = f"scenery_{surface.look}{suffix}", (vertices, normals, faces[chosen])
                _add_mesh(spec, body, name, f"scenery_{surface.look}", part, colors[chosen], group)


def _surround(plan: Plan, spec: mujoco.MjSpec) -> None:
    """Add the room with its floor and what is solid within reach."""
    add_surface_materials(spec, plan)
    place = plan.work_places[0]
    turn, pos = _frame(place)
    room = spec.worldbody.add_body(name=ROOM, pos=pos, quat=turn.as_quat(scalar_first=True))
    add_surfaces(room, plan)
    stand = np.array([place.x, place.y, LABORATORY.robot_stand[2]])
    walls = (box for wall in masonry(plan) for box in wall.boxes())
    add_wall_solids(room, (box for box in walls if _near(stand, *np.array(box).T)))
    number = 0
    for piece in plan.pieces:
        away = math.hypot(piece.x - place.x, piece.y - place.y)
        if piece.name != place.bench and away < _FARTHEST_PIECE:
            for low, high in zip(*next(claims_of_piece(piece)).room, strict=True):
                if _near(stand, low, high):
                    room.add_geom(
                        name=f"solid_{number}",
                        type=mujoco.mjtGeom.mjGEOM_BOX,
                        pos=(low + high) / 2,
                        size=(high - low) / 2,
                        group=COLLISION_GROUP,
                    )
                    number += 1


def _frame(place: WorkPlace) -> tuple[Rotation, FloatArray]:
    """Return how the room is turned, and where its origin is, so that its robot is in its place."""
    turn = Rotation.from_euler("z", -place.heading, degrees=True)
    x, y, _ = LABORATORY.robot_stand
    pos = np.array([x, y, 0.0]) - turn.apply((place.x, place.y, 0.0))
    return turn, pos


def _near(point: FloatArray, low: FloatArray, high: FloatArray) -> bool:
    """Return whether a box is within reach of a point."""
    return bool(np.linalg.norm(np.clip(point, low, high) - point) < _SOLID_WITHIN)


def _add_palette(spec: mujoco.MjSpec, plan: Plan) -> None:
    """Add the materials of the scenery, which share a texture that has every colour of it."""
    colors, _ = _palette(plan)
    squares = np.zeros((_PALETTE**2, 3), np.uint8)
    squares[: len(colors)] = colors
    picture = squares.reshape(_PALETTE, _PALETTE, 3).repeat(_CELL, axis=0).repeat(_CELL, axis=1)
    side, flat = _PALETTE * _CELL, mujoco.mjtTexture.mjTEXTURE_2D
    palette = spec.add_texture(name="scenery", type=flat, width=side, height=side, nchannel=3)
    palette.data = picture.tobytes()
    for look, (specular, shininess) in _SHINE.items():
        material = spec.add_material(name=f"scenery_{look}", specular=specular, shininess=shininess)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "scenery"
        if look == "clear":
            material.rgba = (1.0, 1.0, 1.0, _CLEAR)


@cache
def _palette(plan: Plan) -> tuple[NDArray[np.uint8], tuple[NDArray[np.intp], ...]]:
    """Return the colours of the scenery, shape (n, 3), and which the triangles of surfaces have.

    Colours that differ by less than the eye sees are one where there are too many.
    """
    surfaces = scenery(plan)
    wanted = np.vstack([surface.colors[:, :3] for surface in surfaces])
    for steps in (255, 64, 32, 16, 8):
        colors, number = np.unique(np.round(wanted * steps), axis=0, return_inverse=True)
        if len(colors) <= _PALETTE**2:
            break
    ends = np.cumsum([len(surface.colors) for surface in surfaces])[:-1]
    drawn = np.round(255 / steps * colors).astype(np.uint8)
    return drawn, tuple(np.split(number.ravel(), ends))


def _add_mesh(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    name: str,
    material: str,
    mesh: Shell,
    colors: NDArray[np.intp],
    group: int,
) -> None:
    """Add triangles, each with a colour of the palette."""
    vertices, normals, faces = mesh
    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    numbers = np.arange(_PALETTE**2)
    middles = np.column_stack([numbers % _PALETTE, numbers // _PALETTE]) / _PALETTE + 0.5 / _PALETTE
    spec.add_mesh(
        name=name,
        uservert=vertices[used].ravel(),
        usernormal=normals[used].ravel(),
        usertexcoord=middles.ravel(),
        userface=faces.ravel(),
        userfacenormal=faces.ravel(),
        userfacetexcoord=colors.repeat(3),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
    )
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_MESH,
        meshname=name,
        material=material,
        group=group,
        contype=0,
        conaffinity=0,
    )
