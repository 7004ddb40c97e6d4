"""What is printed on glass: the scale and the label, as one mesh just off the surface."""

from typing import TYPE_CHECKING

import numpy as np

from labutopia_lerobot.labware.parts.mesh import SEGMENTS, Mesh, join, revolve

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.vessel import Vessel

_STEPS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 25, 50, 100, 200, 500, 1000, 2000)
"""Of scales [ml]: the smallest with fewer than ten graduations is taken."""


def printing(vessel: "Vessel") -> Mesh:
    """Return the printing of a vessel: the graduation, and a label at the back."""
    profile = vessel.profile
    if vessel.one_mark is not None:
        strips = [(profile.fill_height(vessel.one_mark), 0.0012, 0.0, 2 * np.pi)]
    else:
        step = next(ml for ml in _STEPS if vessel.capacity < 10 * ml)
        levels = np.arange(step, 0.85 * vessel.capacity, step) * 1e-6
        strips = [(profile.fill_height(level), 0.0012, 0.0, 0.5) for level in levels]
    strips.append((0.3 * vessel.height, 0.16 * vessel.height, np.pi, 0.9))
    patches = []
    for middle, tall, azimuth, wide in strips:
        heights = (middle - tall / 2, middle + tall / 2)
        edge = [(profile.outer_radius(height) + 2e-4, height) for height in heights]
        segments = max(5, round(SEGMENTS * wide / (2 * np.pi)))
        patches.append(revolve(edge, segments, azimuth - wide / 2, wide))
    return join(*patches)
