"""Are the statistics those of the numbers?

Recomputed with NumPy in double precision, not with LeRobot, whose sums are in single precision:
the tolerances are its rounding. A quantile of an episode is, with LeRobot, somewhere in the bin of
a histogram of 5,000 bins; of the dataset it is the mean of the episodes', weighted by frames.
Those of a dataset's states may be wider (`scaling`).
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.description import STATISTICS, read_statistics
from labutopia_lerobot.datasets.scaling import SCALED, least_spans
from labutopia_lerobot.datasets.tables import (
    EPISODES,
    column,
    frames_of_episodes,
    read_episode_statistics,
)
from labutopia_lerobot.datasets.verification.finding import Fault, Finding, Unchecked
from labutopia_lerobot.datasets.verification.structure import WITHOUT_STATISTICS
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.runtime.video import QUANTILES

_COUNTERS = ("index", "frame_index", "episode_index", "task_index", "timestamp")
"""Nobody normalizes by these, and LeRobot's delete leaves theirs as they were."""

_BINS = 5000
_ROUNDING = 2e-5
"""Rounding of sums in single precision, as a share of the largest number; for short episodes."""

_ADDITION = 2.0**-25
"""Share of a sum by which every addition to it may round in single precision. LeRobot adds up frame
by frame, so that an episode of 1,200 may be wrong by 4e-5, and its mean square less the square of
its mean by three times as much."""

_EDGE = 1e-9
"""Margin of the histograms beyond the numbers."""

Statistics = dict[str, NDArray[np.float64]]
"""`min`, `max`, `mean`, `std` and, of each quantile, `low` and `high` -> shape (elements,)."""


def check_statistics(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with the statistics of episodes and dataset."""
    stored = read_episode_statistics(subject.root)
    numbers = [
        key
        for key, feature in subject.features.items()
        if feature["dtype"] not in ("video", "image", *WITHOUT_STATISTICS) and key not in _COUNTERS
    ]
    missing = [key for key in numbers if f"{key}/mean" not in stored]
    if missing:
        yield Unchecked(f"{EPISODES} has no statistics of {', '.join(missing)} for every episode")
    together = {key: _Together() for key in numbers}
    for number, (row, frames) in enumerate(frames_of_episodes(subject.root, subject.episodes)):
        for key in numbers:
            computed = statistics_of(column(frames, key).astype(float))
            together[key].add(computed, row["length"])
            if key not in missing:
                of_episode = {
                    name.rpartition("/")[2]: values[number]
                    for name, values in stored.items()
                    if name.rpartition("/")[0] == key
                }
                for wrong in wrong_statistics(of_episode, computed, row["length"]):
                    where = f"{EPISODES}: episode {row['episode_index']}"
                    yield Fault(f"{where}: {wrong} of {key} is not that of its frames")
    yield from _check_dataset(subject, together, stored)


def _check_dataset(
    subject: VerifiedDataset,
    computed: Mapping[str, "_Together"],
    stored: Mapping[str, NDArray[np.float64]],
) -> Iterator[Finding]:
    lengths = [row["length"] for row in subject.episodes]
    recorded = read_statistics(subject.root)
    for key, together in computed.items():
        said, longest = _flat(recorded.get(key, {})), max(lengths)
        spans = _spans(subject.features[key]) if key in SCALED else 0.0
        for wrong in wrong_statistics(said, together.all, longest, spans):
            yield Fault(f"{STATISTICS}: {wrong} of {key} is not that of the frames")
    for key in subject.cameras:
        if f"{key}/mean" not in stored:
            yield Unchecked(f"{EPISODES} has no colour statistics of {key} for every episode")
            continue
        together = _Together()
        for number, length in enumerate(lengths):
            together.add(_stored_of(stored, key, number), length)
        for wrong in wrong_statistics(_flat(recorded.get(key, {})), together.all, max(lengths)):
            yield Fault(f"{STATISTICS}: {wrong} of {key} is not that of its episodes")


def _spans(feature: Mapping[str, Any]) -> NDArray[np.float64] | float:
    """Return what the statistics of a state may be widened to; not where others named it."""
    names = feature["names"]
    named = isinstance(names, list) and [len(names)] == list(feature["shape"])
    return least_spans(names) if named else 0.0


def _stored_of(stored: Mapping[str, NDArray[np.float64]], key: str, number: int) -> Statistics:
    """Return what is stored of an episode, each quantile its own `low` and `high`."""
    plain = {name: stored[f"{key}/{name}"][number] for name in ("min", "max", "mean", "std")}
    quantiles = {
        f"{side}_{name}": stored[f"{key}/{name}"][number]
        for name in (f"q{round(100 * q):02d}" for q in QUANTILES)
        for side in ("low", "high")
    }
    return plain | quantiles


def statistics_of(values: NDArray[np.float64]) -> Statistics:
    """Return the statistics of numbers, shape (frames, elements), and what quantiles may be."""
    ordered = np.sort(values, axis=0)
    width = (ordered[-1] - ordered[0]) / _BINS
    statistics = {
        "min": ordered[0],
        "max": ordered[-1],
        "mean": values.mean(axis=0),
        "std": values.std(axis=0),
    }
    for q in QUANTILES:
        name, place = f"q{round(100 * q):02d}", q * len(values)
        low, high = np.clip([np.ceil(place) - 2, np.floor(place) + 1], 0, len(values) - 1).astype(
            int
        )
        statistics[f"low_{name}"] = ordered[low] - 2 * width
        statistics[f"high_{name}"] = ordered[high] + 2 * width
    return statistics


class _Together:
    """The statistics of all frames from those of the episodes, as LeRobot does, one after another.

    Mean and variance by Chan, Golub and LeVeque (1983), "Algorithms for computing the sample
    variance"; quantiles are the mean of the episodes', weighted by frames.
    """

    def __init__(self) -> None:
        self._frames = 0
        self._all: Statistics = {}

    def add(self, episode: Statistics, frames: int) -> None:
        """Add an episode of so many frames."""
        before = self._all or episode
        self._frames += frames
        share = frames / self._frames
        apart = share * (1 - share) * (episode["mean"] - before["mean"]) ** 2
        within = before["std"] ** 2 + share * (episode["std"] ** 2 - before["std"] ** 2)
        weighted = {name: before[name] + share * (episode[name] - before[name]) for name in episode}
        self._all = weighted | {
            "min": np.minimum(before["min"], episode["min"]),
            "max": np.maximum(before["max"], episode["max"]),
            "std": np.sqrt(within + apart),
        }

    @property
    def all(self) -> Statistics:
        """Statistics of all episodes so far."""
        return self._all


def wrong_statistics(
    stored: Mapping[str, NDArray[np.float64]],
    computed: Statistics,
    frames: int,
    spans: NDArray[np.float64] | float = 0.0,
) -> Iterator[str]:
    """Yield the names of the stored statistics that are not the computed ones.

    Args:
        stored: What LeRobot has added up.
        computed: What the numbers say.
        frames: Of the longest episode.
        spans: What the statistics may be widened to, shape (elements,). How far they are depends on
            whether LeRobot has made them anew, or has added episodes.
    """
    rounding = max(_ROUNDING, frames * _ADDITION)
    rounding_of_squares = max(_ROUNDING, 3 * frames * _ADDITION)
    largest = np.maximum(np.abs(computed["min"]), np.abs(computed["max"])) + 1e-9
    for name, values in stored.items():
        if name == "count":
            continue
        if values.shape != computed["mean"].shape:
            yield f"{name} (shape {values.shape})"
        elif name.startswith("q"):
            low, high = computed[f"low_{name}"], computed[f"high_{name}"]
            slack = rounding * largest + _EDGE + spans / 2
            if ((values < low - slack) | (values > high + slack)).any():
                yield name
        elif name == "std":
            slack = rounding_of_squares * largest**2
            wider = values**2 - computed["std"] ** 2
            if ((wider < -slack) | (wider > slack + spans**2 / 12)).any():
                yield name
        else:
            down, up = (spans / 2 if name == bound else 0.0 for bound in ("min", "max"))
            slack, apart = rounding * largest, values - computed[name]
            if ((apart < -slack - down) | (apart > slack + up)).any():
                yield name


def _flat(statistics: Mapping[str, object]) -> Statistics:
    return {name: np.array(values, dtype=float).reshape(-1) for name, values in statistics.items()}
