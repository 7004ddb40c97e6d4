"""Surface nets on a sparse grid: where a field of space changes its sign, as quadrilaterals.

Gibson (1998), "Constrained Elastic Surface Nets": every cell of the grid whose corners differ in
sign gets one vertex, the mean of the crossings on its edges, and every edge that the surface
crosses one quadrilateral between the four cells around it. Beside marching cubes it needs no table
of cases, and half the triangles. Only blocks of the grid near the liquid exist.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel

BLOCK = 8
"""Nodes along the edge of a block: as many float32 as an AVX register holds."""

_SHIFT = 3
_MASK = BLOCK - 1

type Field = NDArray[np.float32]
"""Shape (blocks, BLOCK, BLOCK, BLOCK): a number at every node."""


class Grid(NamedTuple):
    """The existing blocks of an unbounded grid of nodes; node (i, j, k) is at (i, j, k) * cell.

    Attributes:
        cell: Distance between nodes [m].
        blocks: Where the blocks are, in blocks, shape (blocks, 3).
        slots: Hash table from place to number of block, -1 where empty; its length is a power of 2.
    """

    cell: float
    blocks: NDArray[np.int32]
    slots: NDArray[np.int32]


@kernel
def _hash(i: int, j: int, k: int, mask: int) -> int:
    # Large primes, as in Teschner et al. (2003), "Optimized Spatial Hashing", section 3.
    return ((i * 73856093) ^ (j * 19349663) ^ (k * 83492791)) & mask


@kernel
def block_at(grid: Grid, i: int, j: int, k: int) -> int:
    """Return the number of the block at a place, given in blocks; -1 if it does not exist."""
    mask = len(grid.slots) - 1
    slot = _hash(i, j, k, mask)
    while grid.slots[slot] >= 0:
        block = grid.slots[slot]
        if grid.blocks[block, 0] == i and grid.blocks[block, 1] == j and grid.blocks[block, 2] == k:
            return int(block)
        slot = (slot + 1) & mask
    return -1


@kernel
def interpolate(field: Field, grid: Grid, x: float, y: float, z: float) -> float:
    """Return a field's value at a point [m], trilinearly; it counts as 0 where no block is."""
    a, b, c = x / grid.cell, y / grid.cell, z / grid.cell
    i, j, k = int(np.floor(a)), int(np.floor(b)), int(np.floor(c))
    a, b, c = a - i, b - j, c - k
    total = 0.0
    for step in range(8):
        di, dj, dk = step >> 2, (step >> 1) & 1, step & 1
        ni, nj, nk = i + di, j + dj, k + dk
        block = block_at(grid, ni >> _SHIFT, nj >> _SHIFT, nk >> _SHIFT)
        if block >= 0:
            weight = (a if di else 1 - a) * (b if dj else 1 - b) * (c if dk else 1 - c)
            total += weight * field[block, ni & _MASK, nj & _MASK, nk & _MASK]
    return total


@kernel
def grid_around(positions: NDArray[np.float64], reach: float, cell: float) -> Grid:
    """Return the grid of all blocks with a node within `reach` of a point, box by box.

    Args:
        positions: Shape (n, 3), metres.
        reach: Half the edge of the box around every point [m].
        cell: Distance between nodes [m].
    """
    room = 64
    blocks: NDArray[np.int32] = np.empty((room, 3), np.int32)
    count = 0
    slots = np.full(4 * room, -1, np.int32)
    low, high = np.empty(3, np.int64), np.empty(3, np.int64)
    for p in range(len(positions)):
        for axis in range(3):
            low[axis] = int(np.ceil((positions[p, axis] - reach) / cell)) >> _SHIFT
            high[axis] = int(np.floor((positions[p, axis] + reach) / cell)) >> _SHIFT
        for i in range(low[0], high[0] + 1):
            for j in range(low[1], high[1] + 1):
                for k in range(low[2], high[2] + 1):
                    if block_at(Grid(cell, blocks, slots), i, j, k) >= 0:
                        continue
                    if count == room:
                        room *= 2
                        blocks = np.concatenate((blocks, np.empty_like(blocks)))
                        slots = np.full(4 * room, -1, np.int32)
                        for block in range(count):
                            _enter(slots, blocks, block)
                    blocks[count] = i, j, k
                    _enter(slots, blocks, count)
                    count += 1
    return Grid(cell, blocks[:count], slots)


@kernel
def _enter(slots: NDArray[np.int32], blocks: NDArray[np.int32], block: int) -> None:
    mask = len(slots) - 1
    slot = _hash(blocks[block, 0], blocks[block, 1], blocks[block, 2], mask)
    while slots[slot] >= 0:
        slot = (slot + 1) & mask
    slots[slot] = block


@kernel
def surface_of(
    grid: Grid, field: Field, outside: float
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.int32]]:
    """Return the surface between positive (inside) and negative values of a field.

    Args:
        grid: Which blocks exist.
        field: The values.
        outside: The value, negative, where there is no block.

    Returns:
        Vertices, shape (v, 3), metres; their unit normals, shape (v, 3), down the field; and quads,
        shape (q, 4), of vertex numbers, counterclockwise as seen from outside.
    """
    count = len(grid.blocks)
    ahead = _blocks_ahead(grid)
    crossed = _crossed(field, ahead, outside)
    room = 1024
    vertices: NDArray[np.float32] = np.empty((room, 3), np.float32)
    normals: NDArray[np.float32] = np.empty((room, 3), np.float32)
    cells: NDArray[np.int32] = np.empty(
        (room, 2), np.int32
    )  # block, and place in the block and signs as one number
    vertex_of = np.empty((count, BLOCK, BLOCK, BLOCK), np.int32)
    corners = np.empty((BLOCK + 1, BLOCK + 1, BLOCK + 1), np.float32)
    vertex = 0
    for b in range(count):
        if not crossed[b]:
            continue
        _gather(corners, field, ahead[b], outside)
        if vertex + BLOCK**3 > room:
            room *= 2
            vertices = np.concatenate((vertices, np.empty_like(vertices)))
            normals = np.concatenate((normals, np.empty_like(normals)))
            cells = np.concatenate((cells, np.empty_like(cells)))
        for i in range(BLOCK):
            for j in range(BLOCK):
                for k in range(BLOCK):
                    signs = 0
                    for c in range(8):
                        if corners[i + (c >> 2), j + ((c >> 1) & 1), k + (c & 1)] > 0.0:
                            signs |= 1 << c
                    if signs in (0, 255):
                        continue
                    _place(corners, i, j, k, vertices[vertex], normals[vertex])
                    for axis in range(3):
                        first = BLOCK * grid.blocks[b, axis]
                        vertices[vertex, axis] = (vertices[vertex, axis] + first) * grid.cell
                    vertex_of[b, i, j, k] = vertex
                    cells[vertex] = b, (((i << _SHIFT) | j) << _SHIFT | k) << 8 | signs
                    vertex += 1
    return vertices[:vertex], normals[:vertex], _quads(cells[:vertex], vertex_of, ahead)


@kernel
def _blocks_ahead(grid: Grid) -> NDArray[np.int32]:
    """Return the blocks at (0 or 1, 0 or 1, 0 or 1) from each, shape (blocks, 8); -1 for none."""
    ahead = np.empty((len(grid.blocks), 8), np.int32)
    for b in range(len(grid.blocks)):
        i, j, k = grid.blocks[b]
        for step in range(8):
            ahead[b, step] = block_at(grid, i + (step >> 2), j + ((step >> 1) & 1), k + (step & 1))
    return ahead


@kernel
def _crossed(field: Field, ahead: NDArray[np.int32], outside: float) -> NDArray[np.bool_]:
    """Return which blocks, with the first layers of those ahead, the surface may go through."""
    count = len(field)
    lowest, highest = np.empty(count, np.float32), np.empty(count, np.float32)
    for b in range(count):
        lowest[b], highest[b] = field[b].min(), field[b].max()
    crossed = np.empty(count, np.bool_)
    for b in range(count):
        low, high = lowest[b], highest[b]
        for step in range(1, 8):
            other = ahead[b, step]
            low = min(low, lowest[other] if other >= 0 else outside)
            high = max(high, highest[other] if other >= 0 else outside)
        crossed[b] = low <= 0.0 < high
    return crossed


@kernel
def _gather(
    corners: NDArray[np.float32], field: Field, ahead: NDArray[np.int32], outside: float
) -> None:
    """Copy a block, and the first layers of the blocks after it, to one array."""
    for step in range(8):
        di, dj, dk = step >> 2, (step >> 1) & 1, step & 1
        block = ahead[step]
        for i in range(1 if di else BLOCK):
            for j in range(1 if dj else BLOCK):
                for k in range(1 if dk else BLOCK):
                    value = field[block, i, j, k] if block >= 0 else outside
                    corners[di * BLOCK + i, dj * BLOCK + j, dk * BLOCK + k] = value


@kernel
def _place(
    corners: NDArray[np.float32],
    i: int,
    j: int,
    k: int,
    vertex: NDArray[np.float32],
    normal: NDArray[np.float32],
) -> None:
    """Set the vertex of a cell, in nodes, and its normal: minus the mean slope along the edges."""
    crossings = 0
    x, y, z = 0.0, 0.0, 0.0
    slope_x, slope_y, slope_z = 0.0, 0.0, 0.0
    for c in range(8):
        ci, cj, ck = c >> 2, (c >> 1) & 1, c & 1
        here = corners[i + ci, j + cj, k + ck]
        if not ci:
            there = corners[i + 1, j + cj, k + ck]
            slope_x += there - here
            if (here > 0.0) != (there > 0.0):
                x, y, z, crossings = x + here / (here - there), y + cj, z + ck, crossings + 1
        if not cj:
            there = corners[i + ci, j + 1, k + ck]
            slope_y += there - here
            if (here > 0.0) != (there > 0.0):
                x, y, z, crossings = x + ci, y + here / (here - there), z + ck, crossings + 1
        if not ck:
            there = corners[i + ci, j + cj, k + 1]
            slope_z += there - here
            if (here > 0.0) != (there > 0.0):
                x, y, z, crossings = x + ci, y + cj, z + here / (here - there), crossings + 1
    vertex[0], vertex[1], vertex[2] = i + x / crossings, j + y / crossings, k + z / crossings
    steepness = max(np.sqrt(slope_x**2 + slope_y**2 + slope_z**2), 1e-12)
    normal[0], normal[1], normal[2] = (
        -slope_x / steepness,
        -slope_y / steepness,
        -slope_z / steepness,
    )


@kernel
def _quads(
    cells: NDArray[np.int32], vertex_of: NDArray[np.int32], ahead: NDArray[np.int32]
) -> NDArray[np.int32]:
    """Return one quad for every edge with a crossing, of those that end in a cell's last corner."""
    quads, count = np.empty((3 * len(cells), 4), np.int32), 0
    around = np.empty(4, np.int32)
    for cell in range(len(cells)):
        b, signs = cells[cell, 0], cells[cell, 1] & 255
        i = cells[cell, 1] >> (8 + 2 * _SHIFT)
        j, k = (cells[cell, 1] >> (8 + _SHIFT)) & _MASK, (cells[cell, 1] >> 8) & _MASK
        last = signs >> 7
        for axis in range(3):
            if (signs >> (7 - (4 >> axis))) & 1 == last:
                continue
            # The other two axes, in the order that makes them right-handed with this one.
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for corner in range(4):
                forward_u, forward_v = int(corner in (1, 2)), int(corner >= 2)
                ni = i + (forward_u if u == 0 else 0) + (forward_v if v == 0 else 0)
                nj = j + (forward_u if u == 1 else 0) + (forward_v if v == 1 else 0)
                nk = k + (forward_u if u == 2 else 0) + (forward_v if v == 2 else 0)
                step = (ni >> _SHIFT) << 2 | (nj >> _SHIFT) << 1 | nk >> _SHIFT
                around[corner] = vertex_of[ahead[b, step], ni & _MASK, nj & _MASK, nk & _MASK]
            for corner in range(4):
                # The field falls along the axis if the last corner is outside: the front is there.
                quads[count, corner] = around[3 - corner] if last else around[corner]
            count += 1
    return quads[:count]
