"""How many episodes a wanted precision costs."""

from bisect import bisect_left
from collections.abc import Callable

from scipy.stats import norm

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence

_MOST = 1_000_000
"""Episodes beyond which nobody plays."""


class PrecisionError(UserError, ValueError):
    """A half width that no interval of a rate can have, or nobody can pay for."""


def episodes_for(half_width: float, rate: float = 0.5, confidence: float = 0.95) -> int:
    """Return after how many episodes the Wilson interval is narrow enough, if so many succeed.

    Args:
        half_width: Half of the width of the interval that is wanted, such as 0.05.
        rate: Share of the successes; 0.5 needs the most episodes.
        confidence: Of the interval.

    Raises:
        PrecisionError: If the half width is impossible.
    """
    z = float(norm.ppf((1 + confidence) / 2))

    def narrow(n: int) -> bool:
        spread = rate * (1 - rate) / n + z**2 / (4 * n**2)
        return bool(z * spread**0.5 / (1 + z**2 / n) <= half_width)

    return _fewest(narrow, half_width)


def anytime_episodes_for(half_width: float, rate: float = 0.5, confidence: float = 0.95) -> int:
    """Return after how many episodes the confidence sequence is narrow enough (see `anytime`).

    Args and errors: those of `episodes_for`.
    """

    def narrow(n: int) -> bool:
        low, high = confidence_sequence(rate * n, n, confidence)
        return float(high - low) / 2 <= half_width

    return _fewest(narrow, half_width)


def require_precision(half_width: float) -> None:
    """Make sure that an interval of a rate can be as narrow as wanted.

    Raises:
        PrecisionError: If it cannot, or only after more than a million episodes.
    """
    if not 0.001 <= half_width < 0.5:
        raise PrecisionError(
            f"{half_width:g} is no half width of an interval of a rate: choose one from 0.001 up "
            "to 0.5, such as 0.05 for plus or minus five percentage points"
        )


def _fewest(narrow: Callable[[int], bool], half_width: float) -> int:
    require_precision(half_width)
    return 1 + bisect_left(range(1, _MOST), True, key=narrow)
