"""Medians of measured values, with intervals that suppose nothing of their distribution."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from scipy.stats import quantile_test

from labutopia_lerobot.evaluation.uncertainty.proportion import Interval


@dataclass(frozen=True)
class Median:
    """The median of a sample.

    Attributes:
        value: The median of the sample.
        interval: Confidence interval of the true one, between two values of the sample (binomial:
            Conover 1999, "Practical Nonparametric Statistics", section 3.2); None where the sample
            is too small for any, at 95 % with fewer than six values.
        n: Values.
    """

    value: float
    interval: Interval | None
    n: int

    @classmethod
    def of(cls, values: Sequence[float], confidence: float = 0.95) -> "Median | None":
        """Return the median of values, or None if there are none."""
        if not values:
            return None
        bounds = quantile_test(values, q=values[0], p=0.5).confidence_interval(confidence)
        interval = None if np.isnan([*bounds]).any() else (float(bounds.low), float(bounds.high))
        return cls(float(median(values)), interval, len(values))
