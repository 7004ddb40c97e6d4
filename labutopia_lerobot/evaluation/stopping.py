"""When a run has seen enough: its interval is narrow, or it is told apart from another result."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import count, takewhile

import numpy as np

from labutopia_lerobot.evaluation.row import Row, Series
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence, log_evidence
from labutopia_lerobot.evaluation.uncertainty.planning import require_precision


@dataclass(frozen=True)
class StoppingRule:
    """Tells after how many episodes enough is known, whatever comes after them.

    It looks after every episode and may, since it uses what is valid at all times together (see
    `uncertainty.anytime`). It looks at episodes in the order of their seeds, so that the answer
    does not depend on which of them were finished first.

    Attributes:
        half_width: Half of the width of the confidence sequence of the rate that is enough.
        confidence: Of the sequence, and of telling two policies apart.

    Raises:
        PrecisionError: If no interval can be that narrow.
    """

    half_width: float
    confidence: float = 0.95

    def __post_init__(self) -> None:
        require_precision(self.half_width)

    def enough(self, successes: Sequence[bool], rival: Sequence[bool] = ()) -> int | None:
        """Return after how many episodes it is enough, or None if more have to be played.

        Args:
            successes: Whether the episodes succeeded, in the order of their seeds, without a gap.
            rival: The same of another policy, from the same seed on; may be shorter.
        """
        won = np.asarray(successes, dtype=bool)
        low, high = confidence_sequence(won.cumsum(), np.arange(1, len(won) + 1), self.confidence)
        done = (high - low) / 2 <= self.half_width
        shared = min(len(won), len(rival))
        other = np.asarray(rival[:shared], dtype=bool)
        better, worse = won[:shared] & ~other, ~won[:shared] & other
        evidence = log_evidence(better.cumsum(), worse.cumsum())
        done[:shared] |= evidence >= -np.log1p(-self.confidence)
        return int(done.argmax()) + 1 if done.any() else None


class Seen:
    """What a run has seen, and whether that is enough, series by series.

    Args:
        rule: When it is enough; None if every episode is to be played.
        seed: Of the first episode.
        rival: Rows of the result that the policy is to be told apart from.
    """

    def __init__(self, rule: StoppingRule | None, seed: int, rival: Iterable[Row] = ()) -> None:
        self._rule, self._seed = rule, seed
        self._won: dict[tuple[Series, int], bool] = {}
        self._rival = {(row.series, row.seed): row.success for row in rival}
        self._needed: dict[Series, int | None] = {}

    def note(self, row: Row) -> None:
        """Take note of an episode, in whatever order they are finished."""
        of = row.series
        self._won[of, row.seed] = row.success
        if self._rule is not None and self._needed.get(of) is None:
            run, rival = self._run(self._won, of), self._run(self._rival, of)
            self._needed[of] = self._rule.enough(run, rival)

    def enough(self, series: Series) -> bool:
        """Tell whether no more episodes are needed of a series."""
        return self._needed.get(series) is not None

    def counts(self, row: Row) -> bool:
        """Tell whether an episode belongs to the result, or was begun before it was enough."""
        needed = self._needed.get(row.series)
        return needed is None or row.seed - self._seed < needed

    def _run(self, won: dict[tuple[Series, int], bool], series: Series) -> list[bool]:
        """Return the successes from the first seed on, up to the first that is not there."""
        keys = ((series, seed) for seed in count(self._seed))
        return [won[key] for key in takewhile(won.__contains__, keys)]
