"""Are the statistics those of the numbers?

Recomputed with NumPy in double precision, not with LeRobot, whose sums are in single precision:
the tolerances are its rounding. A quantile of an episode is, with LeRobot, somewhere in the bin of
a histogram of 5,000 bins; of the dataset it is the mean of the episodes', weighted by frames.
"""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.tables import (
    EPISODES,
    STATISTICS,
    column,
    frames_of_episodes,
    read_episode_statistics,
    read_json,
)
from labutopia_lerobot.datasets.verification.finding import Fault, Finding, Unchecked
from labutopia_lerobot.datasets.verification.structure import WITHOUT_STATISTICS
from labutopia_lerobot.datasets.verification.subject import Subject
from labutopia_lerobot.runtime.video import QUANTILES

_COUNTERS = ("index", "frame_index", "episode_index", "task_index", "timestamp")
"""Nobody normalizes by these, and LeRobot's delete leaves theirs as they were."""

_BINS = 5000
_ROUNDING = 2e-5
"""Of sums in single precision, as a share of the largest number; of short episodes."""

_ADDITION = 2.0**-25
"""By how much of a sum every addition to it may round in single precision. LeRobot adds up frame
by frame, so that an episode of 1,200 may be off by 4e-5, and its mean square less the square of its
mean by three times as much."""

_EDGE = 1e-9
"""By how much the histograms reach beyond the numbers."""

Statistics = dict[str, NDArray[np.float64]]
"""`min`, `max`, `mean`, `std` and, of each quantile, `low` and `high` -> shape (elements,)."""


def check_statistics(subject: Subject) -> Iterator[Finding]:
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
    computed: dict[str, list[Statistics]] = {key: [] for key in numbers}
    for number, (row, frames) in enumerate(
        frames_of_episodes(subject.root, subject.info, subject.episodes)
    ):
        for key in numbers:
            computed[key].append(statistics_of(column(frames, key).astype(float)))
            if key not in missing:
                of_episode = {
                    name.rpartition("/")[2]: values[number]
                    for name, values in stored.items()
                    if name.rpartition("/")[0] == key
                }
                for wrong in wrong_statistics(of_episode, computed[key][-1], row["length"]):
                    where = f"{EPISODES}: episode {row['episode_index']}"
                    yield Fault(f"{where}: {wrong} of {key} is not that of its frames")
    yield from _check_dataset(subject, computed, stored)


def _check_dataset(
    subject: Subject,
    computed: Mapping[str, list[Statistics]],
    stored: Mapping[str, NDArray[np.float64]],
) -> Iterator[Finding]:
    lengths = np.array([row["length"] for row in subject.episodes], dtype=float)
    longest = int(lengths.max())
    told = read_json(subject.root, STATISTICS)
    for key, episodes in computed.items():
        for wrong in wrong_statistics(
            _flat(told.get(key, {})), _together(episodes, lengths), longest
        ):
            yield Fault(f"{STATISTICS}: {wrong} of {key} is not that of the frames")
    for key in subject.cameras:
        episodes = [
            {name: stored[f"{key}/{name}"][number] for name in ("min", "max", "mean", "std")}
            | _quantiles_of(stored, key, number)
            for number in range(len(lengths))
            if f"{key}/mean" in stored
        ]
        if not episodes:
            yield Unchecked(f"{EPISODES} has no colour statistics of {key} for every episode")
            continue
        for wrong in wrong_statistics(
            _flat(told.get(key, {})), _together(episodes, lengths), longest
        ):
            yield Fault(f"{STATISTICS}: {wrong} of {key} is not that of its episodes")


def _quantiles_of(stored: Mapping[str, NDArray[np.float64]], key: str, number: int) -> Statistics:
    """Return the quantiles that are stored of an episode, each its own `low` and `high`."""
    found = {f"q{round(100 * q):02d}" for q in QUANTILES}
    return {
        f"{side}_{name}": stored[f"{key}/{name}"][number]
        for name in found
        for side in ("low", "high")
    }


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


def _together(episodes: list[Statistics], lengths: NDArray[np.float64]) -> Statistics:
    """Return the statistics of all frames from those of the episodes, as LeRobot does."""
    share = (lengths / lengths.sum())[:, None]
    stacked = {name: np.stack([episode[name] for episode in episodes]) for name in episodes[0]}
    mean = (share * stacked["mean"]).sum(axis=0)
    variance = (share * (stacked["std"] ** 2 + (stacked["mean"] - mean) ** 2)).sum(axis=0)
    together = {name: (share * values).sum(axis=0) for name, values in stacked.items()}
    return together | {
        "min": stacked["min"].min(axis=0),
        "max": stacked["max"].max(axis=0),
        "mean": mean,
        "std": np.sqrt(variance),
    }


def wrong_statistics(
    stored: Mapping[str, NDArray[np.float64]], computed: Statistics, frames: int
) -> Iterator[str]:
    """Yield the names of the stored statistics that are not the computed ones.

    Args:
        stored: What LeRobot has added up.
        computed: What the numbers say.
        frames: Of the longest episode.
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
            slack = rounding * largest + _EDGE
            if ((values < low - slack) | (values > high + slack)).any():
                yield name
        elif name == "std":
            square = np.abs(values**2 - computed["std"] ** 2)
            if (square > rounding_of_squares * largest**2).any():
                yield name
        elif (np.abs(values - computed[name]) > rounding * largest).any():
            yield name


def _flat(statistics: Mapping[str, object]) -> Statistics:
    return {name: np.array(values, dtype=float).reshape(-1) for name, values in statistics.items()}
