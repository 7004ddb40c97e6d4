"""Stopping a run: its interval is narrow enough, or it differs clearly from another result."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from labutopia_lerobot.evaluation.compare import (
    NoCommonEpisodesError,
    PlayedEpisodes,
    played_episodes,
    require_same_scene,
)
from labutopia_lerobot.evaluation.condition import Condition
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence, log_evidence
from labutopia_lerobot.evaluation.uncertainty.intervals import require_precision


@dataclass(frozen=True)
class StoppingRule:
    """Decides from counts whether enough is known.

    It may look after every episode, since it uses what is valid at all times together (see
    `uncertainty.anytime`).

    Attributes:
        half_width: Half of the width of the confidence sequence of the rate that is enough.
        confidence: Of the sequence, and of distinguishing two policies.

    Raises:
        PrecisionError: If no interval can be that narrow.
    """

    half_width: float
    confidence: float = 0.95

    def __post_init__(self) -> None:
        require_precision(self.half_width)

    def enough(
        self, successes: ArrayLike, n: ArrayLike, better: ArrayLike = 0, worse: ArrayLike = 0
    ) -> NDArray[np.bool_]:
        """Return whether no more episodes are needed.

        Args:
            successes: Successes so far, any shape.
            n: Episodes so far, the same shape.
            better: Episodes in which only this policy succeeded, and not the rival.
            worse: Episodes in which only the rival did.
        """
        low, high = confidence_sequence(successes, n, self.confidence)
        distinguished = log_evidence(better, worse) >= -np.log1p(-self.confidence)
        done: NDArray[np.bool_] = ((high - low) / 2 <= self.half_width) | distinguished
        return done


@dataclass
class _Sequence:
    """The episodes of a condition, taken in the order of their seeds.

    Attributes:
        seed: Of the next episode that is to be counted.
        waiting: Episodes behind it that were finished before it.
        counts: Successes, episodes, episodes that only this policy won and that only the rival did.
        enough: Whether no more are needed.
    """

    seed: int
    waiting: dict[int, Row] = field(default_factory=dict)
    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(4, np.int64))
    enough: bool = False


class SequentialMonitor:
    """Decides, condition by condition, when a run has seen enough.

    It counts episodes in the order of their seeds, so that its answer does not depend on which of
    them were finished first, and looks at each of them once.

    Args:
        rule: When it is enough; None if every episode is to be played.
        seed: Of the first episode.
        rival: Result that the policy is to be distinguished from, if any.
    """

    def __init__(
        self, rule: StoppingRule | None, seed: int, rival: PlayedEpisodes | None = None
    ) -> None:
        self._rule, self._seed = rule, seed
        self._rival: Mapping[Condition, Mapping[int, Row]] = {} if rival is None else rival.rows
        self._sequences: dict[Condition, _Sequence] = {}

    def note(self, row: Row) -> None:
        """Take note of an episode, in whatever order they are finished.

        Raises:
            NoCommonEpisodesError: If the rival met another scene under the same seed.
        """
        if self._rule is None:
            return
        sequence = self._sequences.setdefault(row.condition.scene, _Sequence(self._seed))
        sequence.waiting[row.seed] = row
        rival = self._rival.get(row.condition.scene, {})
        while not sequence.enough and sequence.seed in sequence.waiting:
            following = sequence.waiting.pop(sequence.seed)
            sequence.counts += _counted(following, rival.get(sequence.seed))
            sequence.enough = bool(self._rule.enough(*sequence.counts))
            sequence.seed += 1

    def enough(self, condition: Condition) -> bool:
        """Return whether no more episodes are needed of a condition."""
        sequence = self._sequences.get(condition.scene)
        return sequence is not None and sequence.enough

    def counts(self, row: Row) -> bool:
        """Return whether an episode belongs to the result, or was begun before it was enough."""
        sequence = self._sequences.get(row.condition.scene)
        return sequence is None or not sequence.enough or row.seed < sequence.seed


def _counted(row: Row, rival: Row | None) -> NDArray[np.int64]:
    """Return what an episode adds to the counts."""
    if rival is None:
        return np.array([row.success, 1, 0, 0])
    require_same_scene(row, rival)
    only_one = row.success != rival.success
    return np.array([row.success, 1, only_one and row.success, only_one and rival.success])


def find_rival(
    place: Path, conditions: Sequence[Condition], seeds: Collection[int]
) -> PlayedEpisodes:
    """Return what another policy played of what is to be played now.

    Args:
        place: Folder of its result.
        conditions: Conditions to play.
        seeds: Which episodes of each.

    Raises:
        NoCommonEpisodesError: If it has no episode of one of the conditions, or there are several
            policies or results of one.
        UnreadableResultError: If there is no result, or it is damaged.
    """
    results = load_results(place)
    rival = played_episodes(results)
    policies = {(row.condition.play, row.policy) for result in results for row in result.rows}
    if len(policies) > len({play for play, _ in policies}):
        listed = ", ".join(sorted({policy for _, policy in policies}))
        raise NoCommonEpisodesError(
            f"versus={place} holds several policies: {listed} ({rival}). Name the folder of one"
        )
    for condition in conditions:
        if not rival.rows.get(condition.scene, {}).keys() & set(seeds):
            raise NoCommonEpisodesError(
                f"versus={place} has no episode of {condition.scene.description}, seeds "
                f"{min(seeds)} to {max(seeds)}, which is to be played. It holds: {rival}. Play "
                "the same tasks, splits, axes, steps and seeds with the same robot, room and liquid"
            )
    return rival
