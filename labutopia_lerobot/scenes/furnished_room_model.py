"""A furnished room around the bench of a task: real within reach, beyond that a picture."""

from functools import cache, partial

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.shell import Shell, rounded_box
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
from labutopia_lerobot.scenes.plan_model import facing
from labutopia_lerobot.scenes.room import Room
from labutopia_lerobot.scenes.scenery import scenery
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_piece
from labutopia_lerobot.scenes.space.ware_room import box_of
from labutopia_lerobot.scenes.views import View
from labutopia_lerobot.scenes.visible_triangles import visible_triangles
from labutopia_lerobot.scenes.within_reach import PREFIX, RealPiece, near, real_names, real_pieces
from labutopia_lerobot.world import ROOM, FloatArray
from labutopia_lerobot.world.model import BEYOND_GROUP, COLLISION_GROUP, VISUAL_GROUP

_PALETTE = 16
"""Colours along a side of the palette."""
_CELL = 8
"""Pixels along a side of a colour, so that none bleeds into another."""
_SHINE = {"matt": (0.15, 0.2), "shiny": (0.6, 0.6), "clear": (0.9, 0.9)}
"""Specular and shininess of the looks of `scenery`."""
_CLEAR = 0.3
"""Opacity of all that is clear."""


def work_place(plan: Plan, room: Room, view: View) -> mujoco.MjSpec:
    """Return bench, robot's stand, floor, cameras, lights, and what is real within reach."""
    return laboratory(room, view, partial(_surround, plan, view))


def decorate(plan: Plan, spec: mujoco.MjSpec, view: View) -> None:
    """Add what is seen and never touched to the body `world.ROOM`."""
    body = spec.body(ROOM)
    add_wall_looks(spec, body, masonry(plan))
    turn, pos = _frame(plan.work_places[0])
    _add_palette(spec, plan)
    for number, surface in enumerate(scenery(plan)):
        vertices, normals, faces = surface.mesh
        there = vertices @ turn.as_matrix().T + pos, normals, faces
        visible = _visible(there, view)
        colors = _palette(plan)[1][number]
        for suffix, chosen, group in (
            ("", visible, VISUAL_GROUP),
            ("_beyond", ~visible, BEYOND_GROUP),
        ):
            if chosen.any():
                name, part = f"scenery_{surface.look}{suffix}", (vertices, normals, faces[chosen])
                _add_mesh(spec, body, name, f"scenery_{surface.look}", part, colors[chosen], group)


def make_solid(plan: Plan, spec: mujoco.MjSpec) -> None:
    """Add boxes for what is a picture otherwise: a robot that drives gets everywhere.

    They are those of the map (`scenes.room_map`): bodies called `room_` and the piece's name, for
    furniture and instruments with their ware, and `world.ROOM` for walls.
    """
    body, place = spec.body(ROOM), plan.work_places[0]
    stand = np.array([place.x, place.y, LABORATORY.robot_stand[2]])
    walls = (box for wall in masonry(plan) for box in wall.boxes())
    far = [box for box in walls if not near(stand, boxes(box))]
    add_wall_solids(body, far, "far_wall")
    pictured = [
        piece
        for piece in plan.pieces
        if piece.name not in real_names(plan) and piece.name != place.bench
    ]
    standing: dict[str, list[Boxes]] = {
        piece.name: [next(claims_of_piece(piece)).room] for piece in pictured
    }
    for ware in plan.ware:
        if ware.on in standing and ware.name not in real_names(plan):
            standing[ware.on].append(box_of(ware))
    for name, parts in standing.items():
        owner = body.add_body(name=f"{PREFIX}{name}")
        for number, (low, high) in enumerate(zip(*joined(*parts), strict=True)):
            if (high > low).all():
                owner.add_geom(
                    name=f"{PREFIX}{name}_solid_{number}",
                    type=mujoco.mjtGeom.mjGEOM_BOX,
                    pos=(low + high) / 2,
                    size=(high - low) / 2,
                    group=COLLISION_GROUP,
                )


def _surround(plan: Plan, view: View, spec: mujoco.MjSpec) -> None:
    """Add the room with its floor, and what is real within reach."""
    add_surface_materials(spec, plan)
    place = plan.work_places[0]
    turn, pos = _frame(place)
    room = spec.worldbody.add_body(name=ROOM, pos=pos, quat=turn.as_quat(scalar_first=True))
    add_surfaces(room, plan)
    stand = np.array([place.x, place.y, LABORATORY.robot_stand[2]])
    walls = (box for wall in masonry(plan) for box in wall.boxes())
    add_wall_solids(room, (box for box in walls if near(stand, boxes(box))))
    for real in real_pieces(plan):
        _add_real(spec, real, view, turn, pos)


def _add_real(
    spec: mujoco.MjSpec, real: RealPiece, view: View, turn: Rotation, pos: FloatArray
) -> None:
    """Add a piece of the room that is built whole, free where it is not fixed.

    Args:
        spec: Where to.
        real: The piece.
        view: Fixed cameras, in whose pictures it is not drawn if it cannot get into them.
        turn: How the room is turned.
        pos: Where its origin is [m], world frame.
    """
    body = real.piece.add_to(spec, spec.worldbody)
    body.pos = turn.apply(real.at) + pos
    front = Rotation.from_quat(facing(real.heading), scalar_first=True)
    body.quat = (turn * front).as_quat(scalar_first=True)
    if real.piece.movable:
        body.add_freejoint(name=f"{real.piece.name}_free")
        return
    hull = real.room.hull
    corners, normals, faces = rounded_box((hull.high - hull.low)[0], 0.0)
    around = turn.apply(corners + (hull.high + hull.low)[0] / 2) + pos, normals, faces
    if not _visible(around, view).any():
        for geom in body.find_all(mujoco.mjtObj.mjOBJ_GEOM):
            if geom.group == VISUAL_GROUP:
                geom.group = BEYOND_GROUP


def _visible(mesh: Shell, view: View) -> NDArray[np.bool_]:
    """Return which triangles get into the pictures of the fixed cameras; all if those ride."""
    if view.on_base:
        return np.ones(len(mesh[2]), bool)
    return visible_triangles(mesh, view.front) | visible_triangles(mesh, view.top)


def _frame(place: WorkPlace) -> tuple[Rotation, FloatArray]:
    """Return how the room is turned, and where its origin is, so that its robot is in its place."""
    turn = Rotation.from_euler("z", -place.heading, degrees=True)
    x, y, _ = LABORATORY.robot_stand
    pos = np.array([x, y, 0.0]) - turn.apply((place.x, place.y, 0.0))
    return turn, pos


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
    used = np.append(used, used[: max(0, 4 - len(used))])  # MuJoCo has no mesh of one triangle
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
