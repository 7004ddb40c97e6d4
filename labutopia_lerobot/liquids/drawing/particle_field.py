"""A field from particles, on a grid, that is positive in the liquid and falls along its surface.

A body of liquid is where the particles, smoothed, fill more than half of space: for anything larger
than the kernel that is just where their volume ends. Near glass the sum is divided by the share of
the kernel that is in the open, as if the liquid went on behind the glass, and the field then cut at
the glass, so that a level surface is level up to the wall. What is too thin for that, drops and
threads, is made of balls of a particle's volume, which a narrower kernel blends where they touch.
"""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.drawing.open_space import (
    KERNEL_SLOPE,
    KERNEL_VOLUME,
    PlacedSpace,
    look_up,
)
from labutopia_lerobot.liquids.drawing.surface_nets import BLOCK, Field, Grid, block_at, interpolate

type Vectors = NDArray[np.float64]
"""Shape (n, 3)."""

type Weights = NDArray[np.float32]
"""Shape (n,)."""

BODY_DEPTH = 0.3
"""Depth of a body of liquid, in particle spacings, that swallows particles next to it; shallower
bodies do it in part, so that drops do not vanish at once."""

DROP_RADIUS = 0.74
"""Radius of the ball around a single particle, in particle spacings. A ball of its volume has 0.62,
but the grid cuts off the caps of a ball this small: measured, test_liquid_surface.py."""

INSET = 2e-4
"""The surface stays this far from the glass [m]."""
_LEAST_SHARE = 0.15  # in the sharpest corner of a vessel a quarter of the kernel is in the open


@kernel
def add_bodies(
    field: Field,
    grid: Grid,
    positions_w: Vectors,
    space: PlacedSpace,
    reach: float,
    spacing: float,
) -> None:
    """Raise a field to the depth below the surface of the bodies of liquid in one space [m].

    Args:
        field: Changed in place.
        grid: Of the field; it has all blocks within `reach` of a particle.
        positions_w: The particles in that space, shape (n, 3), metres.
        space: The space.
        reach: Of the kernel [m].
        spacing: Edge of the cube that has a particle's volume [m].
    """
    unit = spacing**3 / (KERNEL_VOLUME * reach**3)
    sums = np.zeros_like(field)
    _spread(sums, grid, positions_w, np.ones(len(positions_w), np.float32), reach)
    for block in range(len(grid.blocks)):
        for i in range(BLOCK):
            x = (grid.blocks[block, 0] * BLOCK + i) * grid.cell
            for j in range(BLOCK):
                y = (grid.blocks[block, 1] * BLOCK + j) * grid.cell
                for k in range(BLOCK):
                    if sums[block, i, j, k] <= 0.0:
                        continue
                    z = (grid.blocks[block, 2] * BLOCK + k) * grid.cell
                    _, depth, share = look_up(space, x, y, z)
                    liquid = unit * sums[block, i, j, k] / max(share, _LEAST_SHARE)
                    value = min((liquid - 0.5) * reach / KERNEL_SLOPE, depth - INSET)
                    field[block, i, j, k] = max(field[block, i, j, k], value)


@kernel
def outside_bodies(field: Field, grid: Grid, positions_w: Vectors, spacing: float) -> Weights:
    """Return how much of a drop every particle is: 1 away from bodies of liquid, 0 in or at one.

    Args:
        field: Depth below the surface of bodies [m].
        grid: Of the field.
        positions_w: Shape (n, 3), metres.
        spacing: Edge of the cube that has a particle's volume [m].
    """
    weights = np.empty(len(positions_w), np.float32)
    for p in range(len(positions_w)):
        i = int(np.rint(positions_w[p, 0] / grid.cell))
        j = int(np.rint(positions_w[p, 1] / grid.cell))
        k = int(np.rint(positions_w[p, 2] / grid.cell))
        block = block_at(grid, i // BLOCK, j // BLOCK, k // BLOCK)
        depth = max(field[block, i % BLOCK, j % BLOCK, k % BLOCK], np.float32(0.0))
        if depth >= BODY_DEPTH * spacing:
            weights[p] = 0.0
            continue
        for ni in range(i - 1, i + 2):
            for nj in range(j - 1, j + 2):
                for nk in range(k - 1, k + 2):
                    block = block_at(grid, ni // BLOCK, nj // BLOCK, nk // BLOCK)
                    depth = max(depth, field[block, ni % BLOCK, nj % BLOCK, nk % BLOCK])
        weights[p] = max(1.0 - depth / (BODY_DEPTH * spacing), 0.0)
    return weights


@kernel
def add_drops(
    field: Field,
    grid: Grid,
    positions_w: Vectors,
    weights: Weights,
    space: PlacedSpace,
    reach: float,
    spacing: float,
) -> None:
    """Raise a field to the depth below the surface of the drops in one space [m].

    Args:
        field: Changed in place.
        grid: Of the field; it has all blocks within `reach` of a particle.
        positions_w: The particles in that space, shape (n, 3), metres.
        weights: 1 for a full drop, less for one that is about to merge with a body, shape (n,).
        space: The space.
        reach: Of the kernel [m].
        spacing: Edge of the cube that has a particle's volume [m].
    """
    sums = np.zeros_like(field)
    _spread(sums, grid, positions_w, weights, reach)
    for block in range(len(grid.blocks)):
        for i in range(BLOCK):
            x = (grid.blocks[block, 0] * BLOCK + i) * grid.cell
            for j in range(BLOCK):
                y = (grid.blocks[block, 1] * BLOCK + j) * grid.cell
                for k in range(BLOCK):
                    if sums[block, i, j, k] <= 0.0:
                        continue
                    z = (grid.blocks[block, 2] * BLOCK + k) * grid.cell
                    _, depth, _ = look_up(space, x, y, z)
                    # The distance at which a single particle would count as much.
                    far = reach * np.sqrt(1.0 - min(sums[block, i, j, k], 1.0) ** (1.0 / 3.0))
                    value = min(DROP_RADIUS * spacing - far, depth - INSET)
                    field[block, i, j, k] = max(field[block, i, j, k], value)


@kernel
def take_away(field: Field, grid: Grid, other: Field, other_grid: Grid) -> None:
    """Lower a field to be negative where another one, on a coarser grid, is positive."""
    for block in range(len(grid.blocks)):
        for i in range(BLOCK):
            x = (grid.blocks[block, 0] * BLOCK + i) * grid.cell
            for j in range(BLOCK):
                y = (grid.blocks[block, 1] * BLOCK + j) * grid.cell
                for k in range(BLOCK):
                    if field[block, i, j, k] > -grid.cell:
                        z = (grid.blocks[block, 2] * BLOCK + k) * grid.cell
                        depth = interpolate(other, other_grid, x, y, z)
                        field[block, i, j, k] = min(field[block, i, j, k], -depth)


@kernel
def _spread(sums: Field, grid: Grid, positions_w: Vectors, weights: Weights, reach: float) -> None:
    """Add the kernel around every particle to a field."""
    nodes = reach / grid.cell
    one, nothing = np.float32(1.0), np.float32(0.0)
    scale = np.float32(1.0 / nodes**2)
    low, high = np.empty(3, np.int64), np.empty(3, np.int64)
    for p in range(len(positions_w)):
        weight = weights[p]
        if weight <= 0.0:
            continue
        x, y, z = positions_w[p] / grid.cell
        for axis in range(3):
            low[axis] = int(np.ceil(positions_w[p, axis] / grid.cell - nodes))
            high[axis] = int(np.floor(positions_w[p, axis] / grid.cell + nodes))
        for bi in range(low[0] // BLOCK, high[0] // BLOCK + 1):
            for bj in range(low[1] // BLOCK, high[1] // BLOCK + 1):
                for bk in range(low[2] // BLOCK, high[2] // BLOCK + 1):
                    block = block_at(grid, bi, bj, bk)
                    x0, y0, z0 = x - bi * BLOCK, y - bj * BLOCK, np.float32(z - bk * BLOCK)
                    first_i, last_i = max(low[0] - bi * BLOCK, 0), min(high[0] - bi * BLOCK, 7)
                    first_j, last_j = max(low[1] - bj * BLOCK, 0), min(high[1] - bj * BLOCK, 7)
                    for i in range(first_i, last_i + 1):
                        for j in range(first_j, last_j + 1):
                            aside = one - np.float32((i - x0) ** 2 + (j - y0) ** 2) * scale
                            if aside <= nothing:
                                continue
                            row = sums[block, i, j]
                            for k in range(BLOCK):  # a whole row: vector instructions
                                dz = np.float32(k) - z0
                                q = max(aside - dz * dz * scale, nothing)
                                row[k] += weight * q * q * q
