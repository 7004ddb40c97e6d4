"""The vessel of each particle, and the account of it: whole numbers that add up, exactly."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.advance import NOTHING
from labutopia_lerobot.liquids.solver.bodies import Glass, into
from labutopia_lerobot.liquids.solver.walls import holds


@kernel
def whereabouts(
    positions: NDArray[np.float64],
    glass: Glass,
    inner: NDArray[np.int64],
    smallest_first: NDArray[np.int64],
) -> NDArray[np.int64]:
    """Return which vessel each particle is in, shape (n,); -1 outside of all.

    In a vessel that stands in another one, liquid is in the inner vessel.

    Args:
        positions: Shape (n, 3), metres, world frame.
        glass: The vessels.
        inner: Number of edges of each vessel's cavity, shape (vessels,).
        smallest_first: The vessels, by the volume of their cavities, shape (vessels,).
    """
    places = np.full(len(positions), -1, np.int64)
    local = np.empty(3)
    for v in smallest_first:
        edges = glass.edges[glass.starts[v] : glass.starts[v + 1]]
        for a in range(len(positions)):
            if places[a] < 0:
                into(glass.now, v, positions[a], local)
                if holds(edges, inner[v], local[0], local[1], local[2]):
                    places[a] = v
    return places


def tally(
    vessels: int,
    origins: NDArray[np.int64],
    inside: NDArray[np.int64],
    touching: NDArray[np.int64],
    standing: NDArray[np.bool_],
) -> NDArray[np.int64]:
    """Count particles by origin and place, as `LiquidAccount.counts` has them.

    Args:
        vessels: Number of vessels and bottles.
        origins: Where each particle was filled, shape (n,); -1 nowhere.
        inside: Which vessel it is in, shape (n,); -1 none.
        touching: Owner that it touches, shape (n,), or `NOTHING` (see `solver.advance`).
        standing: Which owners stand, shape (owners,) (see `Surroundings.standing`).
    """
    spilled, clinging, in_flight = vessels, vessels + 1, vessels + 2
    outside = np.where(np.append(standing, False)[touching], spilled, clinging)
    outside[touching == NOTHING] = in_flight
    places = np.where(inside >= 0, inside, outside)
    rows, columns = vessels + 1, vessels + 3
    # A row of -1 is the last one: remainders are never negative.
    cells = (origins % rows) * columns + places
    return np.bincount(cells, minlength=rows * columns).reshape(rows, columns)


def transfers(
    vessels: int, held: NDArray[np.int64], inside: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Count particles that have come from one vessel into another, as `LiquidAccount.transfers`.

    Args:
        vessels: Number of vessels and bottles.
        held: Which vessel each particle was in last, shape (n,); -1 none.
        inside: Which vessel it is in, shape (n,); -1 none.
    """
    moves = np.zeros((vessels, vessels), int)
    moved = (inside >= 0) & (held >= 0) & (inside != held)
    np.add.at(moves, (held[moved], inside[moved]), 1)
    return moves


def mean_speeds(
    vessels: int, velocities: NDArray[np.float64], inside: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the mean speed of what is in each vessel [m/s], shape (vessels,).

    Args:
        vessels: Number of vessels and bottles.
        velocities: Shape (n, 3), m/s.
        inside: Which vessel each particle is in, shape (n,); -1 none.
    """
    held = inside >= 0
    speeds = np.linalg.norm(velocities[held], axis=1)
    total = np.bincount(inside[held], speeds, minlength=vessels)
    mean: NDArray[np.float64] = total / np.maximum(np.bincount(inside[held], minlength=vessels), 1)
    return mean


@kernel
def stirring(
    vessels: int, velocities: NDArray[np.float64], inside: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return how fast what is in each vessel moves within it [m/s], shape (vessels,).

    The mean speed, less the way that all of it goes together: being carried stirs nothing.

    Args:
        vessels: Number of vessels and bottles.
        velocities: Shape (n, 3), m/s.
        inside: Which vessel each particle is in, shape (n,); -1 none.
    """
    counts, common = np.zeros(vessels), np.zeros((vessels, 3))
    for a in range(len(inside)):
        if inside[a] >= 0:
            counts[inside[a]] += 1.0
            for k in range(3):
                common[inside[a], k] += velocities[a, k]
    speeds = np.zeros(vessels)
    for a in range(len(inside)):
        v = inside[a]
        if v >= 0:
            x = velocities[a, 0] - common[v, 0] / counts[v]
            y = velocities[a, 1] - common[v, 1] / counts[v]
            z = velocities[a, 2] - common[v, 2] / counts[v]
            speeds[v] += np.sqrt(x * x + y * y + z * z)
    mean: NDArray[np.float64] = speeds / np.maximum(counts, 1.0)
    return mean
