"""Two policies on common seeds: the same episodes, so that only where they differ counts."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from labutopia_lerobot.evaluation.uncertainty.intervals import Interval, deviations


@dataclass(frozen=True)
class PairedOutcomes:
    """Common episodes of two policies, by who succeeded.

    Attributes:
        both: Episodes in which both did.
        first: Episodes in which only the first did.
        second: Episodes in which only the second did.
        neither: Episodes in which neither did.
    """

    both: int
    first: int
    second: int
    neither: int

    @classmethod
    def of(cls, outcomes: Iterable[tuple[bool, bool]]) -> "PairedOutcomes":
        """Count pairs of successes, of the first policy and of the second."""
        pairs = list(outcomes)
        return cls(*(pairs.count(kind) for kind in _KINDS))

    def __add__(self, other: "PairedOutcomes") -> "PairedOutcomes":
        """Return the counts of both, as for several tasks pooled."""
        return PairedOutcomes(
            self.both + other.both,
            self.first + other.first,
            self.second + other.second,
            self.neither + other.neither,
        )

    @property
    def n(self) -> int:
        """Common episodes."""
        return self.both + self.first + self.second + self.neither

    @property
    def difference(self) -> float:
        """Rate of the first policy less that of the second."""
        return (self.first - self.second) / self.n

    @property
    def p_value(self) -> float:
        """Two-sided probability of this or more under equal rates (exact McNemar test).

        Of the episodes in which only one succeeded, each is then a fair coin.
        """
        from scipy.stats import binomtest  # here: it takes half a second

        discordant = self.first + self.second
        return float(binomtest(self.first, discordant).pvalue) if discordant else 1.0

    def interval(self, confidence: float = 0.95) -> Interval:
        """Return the confidence interval of the difference (score interval of Tango 1998)."""
        from scipy.optimize import brentq  # here: likewise

        z, difference = deviations(confidence), self.difference
        low = -1.0 if difference == -1.0 else brentq(lambda d: self._score(d) - z, -1.0, difference)
        high = 1.0 if difference == 1.0 else brentq(lambda d: self._score(d) + z, difference, 1.0)
        return float(low), float(high)

    def _score(self, difference: float) -> float:
        """Return Tango's statistic for a true difference: standard normal if that is the true one.

        The nuisance parameter, how often only the second succeeds, is the most likely one for this
        difference (Tango 1998, equations 9 to 12).
        """
        n, first, second = self.n, self.first, self.second
        b = -first - second + (2 * n - first + second) * difference
        c = -second * difference * (1 - difference)
        only_second = (sqrt(max(0.0, b * b - 8 * n * c)) - b) / (4 * n)
        variance = n * (2 * only_second + difference * (1 - difference))
        excess = first - second - n * difference
        if variance <= 0:
            return 0.0 if excess == 0 else float("inf") * excess
        return excess / sqrt(variance)


_KINDS = ((True, True), (True, False), (False, True), (False, False))


def holm(p_values: Sequence[float]) -> list[float]:
    """Return p-values adjusted for how many there are (Holm 1979).

    Those below a level then contain a false one at most with that probability, whatever the tests
    have to do with each other. The smallest is multiplied by the number of them, the next by one
    less and so on, and none becomes smaller than the one before.
    """
    order = np.argsort(p_values)
    factors = np.arange(len(order), 0, -1)
    adjusted = np.empty(len(order))
    adjusted[order] = np.minimum(1.0, np.maximum.accumulate(np.asarray(p_values)[order] * factors))
    return [float(p) for p in adjusted]
