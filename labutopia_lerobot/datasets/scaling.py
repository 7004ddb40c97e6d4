"""Statistics by which a policy can scale a state, also where it hardly ever varies.

LeRobot's policies divide a state by its range or standard deviation in the demonstrations. What
stands still in all of them has next to none: a drop that stays in a beaker, or a hot plate that was
pushed by a tenth of a millimetre, is then thousands, and the arm leaps or stops. So a dataset's
statistics are at least as wide as those of a number that is anywhere within a least span, equally
often. The original code of Diffusion Policy has a like guard (`LinearNormalizer`, `range_eps`).
Statistics of episodes, which LeRobot's tools put together, are left as they are.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import ENVIRONMENT_STATE, STATE
from labutopia_lerobot.scenario.privileged_state import least_span

SCALED = (STATE, ENVIRONMENT_STATE)
"""Keys of what is widened; an action is played as it was scaled, and so is not."""

_BOUNDS = (("min", "max", 1.0), ("q01", "q99", 0.98), ("q10", "q90", 0.8))
"""Statistics that bound a share of the frames from both sides."""


def least_spans(names: Sequence[str]) -> NDArray[np.float64]:
    """Return the `least_span` of elements of a state, shape (elements,)."""
    return np.array([least_span(name) for name in names])


def widened(
    statistics: Mapping[str, NDArray[np.float64]], names: Sequence[str]
) -> dict[str, NDArray[np.float64]]:
    """Return statistics that are at least as wide as those of `least_span`.

    What is widened already stays as it is.

    Args:
        statistics: Such as `min`, `q90` or `std` -> numbers, shape (elements,).
        names: Names of the elements.
    """
    spans, wide = least_spans(names), dict(statistics)
    for low, high, share in _BOUNDS:
        if low in wide and high in wide:
            middle, half = (wide[low] + wide[high]) / 2, share * spans / 2
            wide[low] = np.minimum(wide[low], middle - half)
            wide[high] = np.maximum(wide[high], middle + half)
    if "std" in wide:
        wide["std"] = np.maximum(wide["std"], spans / np.sqrt(12))
    return wide
