"""A furnished room as a picture needs it: all that stands there as a few still meshes.

A geom costs 50 microseconds a picture, a triangle in view 0.2, one out of view 0.04 (Mesa llvmpipe,
one core). So what is opaque becomes one mesh for each kind of gloss, whose colours come from a
palette, and what the fixed cameras cannot see stays out of their pictures.
"""

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from labutopia_lerobot.labware.parts import shell
from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.scenes.building.masonry import masonry
from labutopia_lerobot.scenes.plan import Placed, PlacedWare, Plan
from labutopia_lerobot.scenes.plan_model import add_openings, add_pieces, facing
from labutopia_lerobot.scenes.still_ware import StillPart, still_ware
from labutopia_lerobot.scenes.within_reach import real_names
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import COLLISION_GROUP

type Color = tuple[float, float, float, float]

_CLEAR = 0.7
"""Opacity from which a thing is drawn as if nothing were seen through it."""
_SHINES = 0.45
"""Specular from which a thing is of the shiny kind."""
_CELL = 0.1
"""Cell of the grid by which things are assigned to rooms [m]."""


class SceneryMesh(NamedTuple):
    """The parts of a room that are drawn alike.

    Attributes:
        look: `matt`, `shiny` or `clear`.
        mesh: In the room's frame.
        colors: Red, green, blue, alpha of every triangle, 0 to 1, shape (m, 4).
    """

    look: str
    mesh: Shell
    colors: FloatArray


@cache
def scenery(plan: Plan) -> tuple[SceneryMesh, ...]:
    """Return what is seen from the first work place, but floor, walls and what is real."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    carriers = {piece.name: piece for piece in _in_sight(plan)}
    pictured = [piece for name, piece in carriers.items() if name not in real_names(plan)]
    with shell.coarse():
        add_openings(spec, plan, masonry(plan))
        add_pieces(spec, pictured)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    parts_of: dict[str, list[tuple[Shell, Color]]] = {}
    for geom in range(model.ngeom):
        if model.geom_group[geom] < COLLISION_GROUP:
            color, specular = _finish(model, geom)
            mesh = _placed(model, data, geom)
            parts_of.setdefault(_look(color, specular), []).append((mesh, color))
    for ware in plan.ware:
        carrier = carriers.get(ware.on)
        if carrier and ware.name not in real_names(plan):
            for mesh, color, specular in _still(ware, carrier):
                parts_of.setdefault(_look(color, specular), []).append((mesh, color))
    return tuple(
        SceneryMesh(
            look,
            shell.joined([mesh for mesh, _ in parts]),
            np.repeat([color for _, color in parts], [len(mesh[2]) for mesh, _ in parts], axis=0),
        )
        for look, parts in sorted(parts_of.items())
    )


def _look(color: Color, specular: float) -> str:
    """Return how what has a colour and highlights is drawn."""
    return "clear" if color[3] < _CLEAR else "shiny" if specular > _SHINES else "matt"


def _still(ware: PlacedWare, carrier: Placed) -> Iterator[StillPart]:
    """Yield what is seen of some ware, room frame."""
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, np.array(facing(carrier.heading)))
    axes, at = turn.reshape(3, 3), np.array([ware.x, ware.y, ware.height])
    parts = still_ware(ware.kind, ware.size, ware.closed, ware.contents, ware.level)
    for (vertices, normals, faces), color, specular in parts:
        yield (vertices @ axes.T + at, normals @ axes.T, faces), color, specular


def _in_sight(plan: Plan) -> Iterator[Placed]:
    """Yield the pieces that no wall or shut door hides from the robot at the first work place."""
    place = plan.work_places[0]
    wide, deep, _ = plan.size
    masonry_at = np.zeros((int(wide / _CELL) + 1, int(deep / _CELL) + 1), bool)
    for wall in masonry(plan):
        if wall.inside == 0 and not any(hole.kind == "window" for hole in wall.openings):
            spans = (wall.length, wall.across) if wall.along == 0 else (wall.across, wall.length)
            (x, far_x), (y, far_y) = (
                (max(0, int(low / _CELL)), int(np.ceil(high / _CELL)) + 1) for low, high in spans
            )
            masonry_at[x:far_x, y:far_y] = True
    regions, _ = ndimage.label(~masonry_at)

    def region(x: float, y: float) -> int:
        return int(
            regions[min(int(x / _CELL), len(regions) - 1), int(y / _CELL) % regions.shape[1]]
        )

    here = region(place.x, place.y)
    for piece in plan.pieces:
        if piece.name != place.bench and region(piece.x, piece.y) in (0, here):
            yield piece


def _finish(model: mujoco.MjModel, geom: int) -> tuple[Color, float]:
    """Return the colour of a geom, and how bright its highlights are."""
    material = int(model.geom_matid[geom])
    if material < 0:
        red, green, blue, alpha = model.geom_rgba[geom].tolist()
        return (red, green, blue, alpha), 0.5
    red, green, blue, alpha = model.mat_rgba[material].tolist()
    texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
    if texture >= 0:
        start, channels = int(model.tex_adr[texture]), int(model.tex_nchannel[texture])
        pixels = int(model.tex_height[texture]) * int(model.tex_width[texture])
        picture = model.tex_data[start : start + channels * pixels].reshape(-1, channels)
        mean = picture.mean(axis=0) / 255
        red, green, blue = (mean[:3] * (red, green, blue)).tolist()
        alpha *= float(mean[3]) if channels == 4 else 1.0
    return (red, green, blue, alpha), float(model.mat_specular[material])


def _placed(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Shell:
    """Return what is seen of a geom, in the world's frame."""
    turn, pos = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    vertices, normals, faces = _drawn(model, geom)
    return vertices @ turn.T + pos, normals @ turn.T, faces


def _drawn(model: mujoco.MjModel, geom: int) -> Shell:
    """Return what is seen of a geom, in its own frame."""
    size = model.geom_size[geom]
    match mujoco.mjtGeom(int(model.geom_type[geom])):
        case mujoco.mjtGeom.mjGEOM_MESH:
            return _mesh(model, int(model.geom_dataid[geom]))
        case mujoco.mjtGeom.mjGEOM_BOX:
            return shell.rounded_box(2 * size, 0.0)
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            radius, half = float(size[0]), float(size[1])
            return shell.turned([(0, -half), (radius, -half), (radius, half), (0, half)], 10)
        case _:
            radius = float(size[0])  # a ball, or what is as small
            angles = np.linspace(-np.pi / 2, np.pi / 2, 6)
            arc = [(radius * float(np.cos(a)), radius * float(np.sin(a))) for a in angles]
            return shell.turned(arc, 10)


def _mesh(model: mujoco.MjModel, mesh: int) -> Shell:
    """Return a mesh with a normal for each corner of each triangle."""

    def rows(array: NDArray[np.generic], starts: NDArray[np.int32], counts: NDArray[np.int32]):  # type: ignore[no-untyped-def]
        return array[starts[mesh] : starts[mesh] + counts[mesh]]

    faces = rows(model.mesh_face, model.mesh_faceadr, model.mesh_facenum)
    corners = rows(model.mesh_facenormal, model.mesh_faceadr, model.mesh_facenum)
    vertices = rows(model.mesh_vert, model.mesh_vertadr, model.mesh_vertnum)[faces.ravel()]
    normals = rows(model.mesh_normal, model.mesh_normaladr, model.mesh_normalnum)[corners.ravel()]
    pairs = np.column_stack([faces.ravel(), corners.ravel()])
    _, first, again = np.unique(pairs, axis=0, return_index=True, return_inverse=True)
    return (
        vertices[first].astype(float),
        normals[first].astype(float),
        again.reshape(-1, 3).astype(np.int64),
    )
