"""Replaying a recording: same seeds, same actions; are the states the same, bit for bit?"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from labutopia_lerobot.datasets.playback import Player, outcome_behind
from labutopia_lerobot.datasets.tables import SEED, frames_of_episodes, read_episodes
from labutopia_lerobot.errors import UserError


class ForeignDatasetError(UserError):
    """A dataset whose seeds are unknown; the message says why."""


@dataclass(frozen=True)
class Replay:
    """Result of the replay of an episode.

    Attributes:
        episode: Index of the episode.
        seed: What the environment was reset with.
        outcome: Outcome in the environment, "running" if the actions ended before the episode.
        recorded: What it was when it was recorded.
        first_difference: First frame that differs from the recorded one, or None.
    """

    episode: int
    seed: int
    outcome: str
    recorded: str
    first_difference: int | None

    @property
    def faithful(self) -> bool:
        """Whether it ended as it did, through the very same states."""
        return self.outcome == self.recorded and self.first_difference is None


def replay(
    root: Path, episodes: int | None = None, tasks_dir: str | None = None
) -> Iterator[Replay]:
    """Replay the first episodes of a dataset, or all; draws no pictures.

    Args:
        root: Folder of the dataset.
        episodes: How many; None for all.
        tasks_dir: A further folder of tasks, which the user trusts.

    Raises:
        ForeignDatasetError: If no episode has its seed.
        DamagedDatasetError: If a file is missing or cannot be read.
        UnknownTaskError: If a task is not there.
    """
    rows = read_episodes(root)
    if all(row.get(SEED) is None for row in rows):
        raise ForeignDatasetError(
            f"{root} has no seeds: labutopia-record did not make it, or LeRobot's delete or "
            "split, which drop them, made it of another"
        )
    player = Player(tasks_dir)
    for row, frames in frames_of_episodes(root, rows[:episodes]):
        played = player.play(row, frames)
        if played is not None:
            first = None if played.difference is None else played.difference.frame
            before = outcome_behind(row)
            yield Replay(row["episode_index"], row[SEED], played.outcome, before, first)
