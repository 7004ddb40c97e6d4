"""When a run has seen enough: its interval is narrow, or it is told apart from another result."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

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
