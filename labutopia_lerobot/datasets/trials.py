"""Candidates of a task that are still to be played."""

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import count

from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.errors import UserError

_PATIENCE = 20
"""Give up once failures outnumber successes by this many."""


class HopelessExpertError(UserError):
    """The expert fails so often that recording on is pointless; the message lists the causes."""


class Trials:
    """The candidates of one task: played, in play, and still to be tried.

    They are tried in index order, and never more than could all be needed. Therefore exactly those
    up to the last success are played, whatever the number of workers.

    Args:
        task: Id of the task.
        wanted: How many successes are wanted.
        played: Candidates of a previous run.
    """

    def __init__(self, task: str, wanted: int, played: Iterable[Candidate]) -> None:
        self.task = task
        self._wanted = wanted
        self._played = {candidate.index: candidate for candidate in played}
        self._in_play = 0
        self._untried = (index for index in count() if index not in self._played)
        self._require_hope()

    @property
    def played(self) -> list[Candidate]:
        """The candidates that were played, in index order."""
        return [self._played[index] for index in sorted(self._played)]

    @property
    def settled(self) -> Iterator[Candidate]:
        """Those that were played before the first one that was not, in index order."""
        for index in count():
            if index not in self._played:
                return
            yield self._played[index]

    @property
    def missing(self) -> int:
        """Number of missing successes."""
        return self._wanted - sum(candidate.success for candidate in self._played.values())

    def next(self) -> int | None:
        """Return the next candidate to play, None while those in play could suffice."""
        if self._in_play >= self.missing:
            return None
        self._in_play += 1
        return next(self._untried)

    def note(self, candidate: Candidate) -> None:
        """Take note of a candidate that has been played.

        Raises:
            HopelessExpertError: If the expert fails absurdly often.
        """
        self._in_play -= 1
        self._played[candidate.index] = candidate
        self._require_hope()

    def _require_hope(self) -> None:
        failures = [candidate for candidate in self._played.values() if not candidate.success]
        successes = len(self._played) - len(failures)
        if len(failures) > successes + _PATIENCE:
            causes = Counter(failure.cause for failure in failures)
            raise HopelessExpertError(
                f"Gave up: the expert of {self.task} failed {len(failures)} times in "
                f"{len(self._played)} episodes, mostly by: {causes.most_common(1)[0][0]}"
            )
