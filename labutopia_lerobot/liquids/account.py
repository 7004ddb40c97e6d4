"""Where the liquid is, in particles: the counts add up to all of it, exactly."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.bodies import Glass, into
from labutopia_lerobot.liquids.compilation import kernel
from labutopia_lerobot.liquids.walls import holds


@kernel
def whereabouts(
    positions: NDArray[np.float64], glass: Glass, inner: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return which vessel each particle is in, shape (n,); -1 outside of all.

    Args:
        positions: Shape (n, 3), metres, world frame.
        glass: The vessels.
        inner: Number of edges of each vessel's cavity, shape (vessels,).
    """
    places = np.full(len(positions), -1, np.int64)
    local = np.empty(3)
    for v in range(len(inner)):
        edges = glass.edges[glass.starts[v] : glass.starts[v + 1]]
        for a in range(len(positions)):
            if places[a] < 0:
                into(glass.now, v, positions[a], local)
                if holds(edges, inner[v], local[0], local[1], local[2]):
                    places[a] = v
    return places
