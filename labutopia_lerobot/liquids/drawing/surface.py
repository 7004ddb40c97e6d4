"""The surface of a liquid made of particles, as a mesh to be drawn."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.liquids.drawing.open_space import (
    PlacedSpace,
    above_plane,
    inside_vessel,
    look_up,
)
from labutopia_lerobot.liquids.drawing.particle_field import (
    INSET,
    add_bodies,
    add_drops,
    outside_bodies,
    take_away,
)
from labutopia_lerobot.liquids.drawing.strands import FALL, LINK, strands
from labutopia_lerobot.liquids.drawing.surface_nets import (
    BLOCK,
    Field,
    Grid,
    grid_around,
    surface_of,
)

CELL, REACH = 0.75, 2.0
"""Bodies of liquid: distance between the nodes of their grid and reach of their kernel, in particle
spacings. A shorter reach shows the single particles of a level surface."""

DROP_CELL, DROP_REACH = 0.5, 1.25
"""The same of drops: balls that merge when they are closer than about 1.7 spacings."""


class VesselPose(NamedTuple):
    """A vessel of revolution and where it is.

    Attributes:
        profile: Its glass.
        position_w: The middle of its base [m], world frame, shape (3,).
        rotation_wb: Its axes in the world frame, as columns, shape (3, 3).
    """

    profile: Profile
    position_w: NDArray[np.float64]
    rotation_wb: NDArray[np.float64]


class LiquidSurface(NamedTuple):
    """A closed mesh.

    Attributes:
        vertices_w: Metres, world frame, shape (v, 3).
        normals_w: Unit vectors out of the liquid, shape (v, 3).
        quads: Numbers of the vertices of every face, counterclockwise from outside, shape (q, 4).
    """

    vertices_w: NDArray[np.float32]
    normals_w: NDArray[np.float32]
    quads: NDArray[np.int32]


def liquid_surface(
    positions_w: NDArray[np.float64],
    spacing: float,
    vessels: Sequence[VesselPose],
    bench_height: float,
) -> LiquidSurface:
    """Return the surface of one liquid: of its bodies, and of the drops outside them.

    Args:
        positions_w: The particles, shape (n, 3), metres, world frame.
        spacing: Edge of the cube that has a particle's volume [m].
        vessels: All that may hold some of it.
        bench_height: Height of the plane on which it may lie [m], world frame.
    """
    reach, drop_reach = REACH * spacing, DROP_REACH * spacing
    parts = list(_parts(positions_w, vessels, bench_height, reach))
    grid, bodies = _empty(positions_w, reach, CELL * spacing)
    for space, members in parts:
        add_bodies(bodies, grid, positions_w[members], space, reach, spacing)
    body = LiquidSurface(*surface_of(grid, bodies, -reach))
    for space, _ in parts:
        _keep_inside(body.vertices_w, space)
    loose = outside_bodies(bodies, grid, positions_w, spacing)
    if not loose.any():
        return body
    # Threads span gaps between particles, and so must the grid.
    room = drop_reach + 0.5 * FALL * LINK * spacing
    drop_grid, drops = _empty(positions_w[loose > 0], drop_reach, DROP_CELL * spacing, room)
    for space, members in parts:
        these = members[loose[members] > 0]
        if len(these):
            places, weights = strands(positions_w[these], loose[these], spacing)
            add_drops(drops, drop_grid, places, weights, space, drop_reach, spacing)
    take_away(drops, drop_grid, bodies, grid)
    return together([body, LiquidSurface(*surface_of(drop_grid, drops, -drop_reach))])


def together(surfaces: Sequence[LiquidSurface]) -> LiquidSurface:
    """Return several surfaces as one; their quads keep their order."""
    firsts = np.cumsum([0, *(len(surface.vertices_w) for surface in surfaces)])[:-1]
    shifted = [s.quads + np.int32(first) for s, first in zip(surfaces, firsts, strict=True)]
    return LiquidSurface(
        np.concatenate([surface.vertices_w for surface in surfaces]),
        np.concatenate([surface.normals_w for surface in surfaces]),
        np.concatenate(shifted),
    )


def _empty(
    positions_w: NDArray[np.float64], reach: float, cell: float, room: float | None = None
) -> tuple[Grid, Field]:
    """Return a grid with room around every particle, by default a kernel's, without liquid."""
    # Two cells more: the surface then never comes to the last nodes, and is closed.
    grid = grid_around(positions_w, (reach if room is None else room) + 2 * cell, cell)
    return grid, np.full((len(grid.blocks), BLOCK, BLOCK, BLOCK), -reach, np.float32)


def _parts(
    positions_w: NDArray[np.float64],
    vessels: Sequence[VesselPose],
    bench_height: float,
    reach: float,
) -> Iterator[tuple[PlacedSpace, NDArray[np.intp]]]:
    """Yield every space with liquid and the numbers of the particles in it.

    What is close over the mouth of a vessel belongs to the vessel and to the free space, so that a
    stream is drawn in one piece.
    """
    free = np.ones(len(positions_w), np.bool_)
    for profile, position_w, rotation_wb in vessels:
        space = PlacedSpace(inside_vessel(profile, reach), position_w, rotation_wb)
        inside, over = _held(positions_w, space, reach)
        if inside.any():
            free &= ~inside
            yield space, np.flatnonzero(inside | over)
    if free.any():
        bench = np.array([0.0, 0.0, bench_height])
        yield PlacedSpace(above_plane(reach), bench, np.eye(3)), np.flatnonzero(free)


@kernel
def _held(
    positions_w: NDArray[np.float64], placed: PlacedSpace, reach: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which particles are in a vessel, and which less than `reach` above its mouth."""
    inside = np.zeros(len(positions_w), np.bool_)
    over = np.zeros(len(positions_w), np.bool_)
    origin = placed.position_w
    widest = placed.space.step * len(placed.space.depth)
    far = widest**2 + (placed.space.rim + reach) ** 2
    for p in range(len(positions_w)):
        x, y, z = positions_w[p]
        if (x - origin[0]) ** 2 + (y - origin[1]) ** 2 + (z - origin[2]) ** 2 < far:
            height, depth, _ = look_up(placed, x, y, z)
            inside[p] = depth > 0.0 and height <= placed.space.rim
            over[p] = 0.0 < height - placed.space.rim < reach
    return inside, over


@kernel
def _keep_inside(vertices_w: NDArray[np.float32], space: PlacedSpace) -> None:
    """Move the vertices with which the grid cuts through the glass back to its inside.

    Where the cavity narrows or widens abruptly, a straight cut is up to half a millimetre too deep.

    Args:
        vertices_w: Changed in place, shape (v, 3), metres.
        space: The vessel.
    """
    step = 0.5 * INSET
    point, away = np.empty(3), np.empty(3)
    for v in range(len(vertices_w)):
        point[:] = vertices_w[v]
        _, depth, _ = look_up(space, point[0], point[1], point[2])
        if not -5 * INSET < depth < 0.5 * INSET:
            continue
        for axis in range(3):
            here = point[axis]
            point[axis] = here + step
            _, more, _ = look_up(space, point[0], point[1], point[2])
            point[axis] = here - step
            _, less, _ = look_up(space, point[0], point[1], point[2])
            point[axis], away[axis] = here, more - less
        size = np.sqrt(np.sum(away**2))
        if size > 0.0:
            vertices_w[v] = point + (INSET - depth) / size * away
