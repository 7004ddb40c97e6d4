"""Replaying a recording: same seeds, same actions; are the states the same, bit for bit?"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import state_keys
from labutopia_lerobot.datasets.tables import (
    RECORDING,
    SEED,
    column,
    read_episodes,
    read_frames,
    read_json,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import SUCCESS


class ForeignDatasetError(UserError):
    """A dataset that `labutopia-record` did not make: its seeds are unknown."""


@dataclass(frozen=True)
class Replay:
    """How the replay of an episode went.

    Attributes:
        episode: Index of the episode.
        seed: What the environment was reset with.
        outcome: Outcome in the environment, "running" if the actions ended before the episode.
        first_difference: First frame whose state differs from the recorded one, or None.
    """

    episode: int
    seed: int
    outcome: str
    first_difference: int | None

    @property
    def faithful(self) -> bool:
        """Whether it succeeded again, through the very same states."""
        return self.outcome == SUCCESS and self.first_difference is None


def replay(root: Path, episodes: int | None = None) -> Iterator[Replay]:
    """Replay the first episodes of a dataset, or all; draws no pictures.

    Raises:
        ForeignDatasetError: If the dataset is none of ours.
        DamagedDatasetError: If a file is missing or cannot be read.
        UnknownTaskError: If its task is no longer there.
    """
    if not (root / RECORDING).exists():
        raise ForeignDatasetError(f"{root} has no {RECORDING}: labutopia-record did not make it")
    config = read_json(root, RECORDING)["config"]
    env = LabEnv(recorded_setting(config, obs="state"))
    table = read_frames(root)
    actions = column(table, ACTION)
    keys = state_keys(config["obs"])
    states = np.hstack([column(table, key) for key in keys.values()])
    for row in read_episodes(root)[:episodes]:
        frames = slice(row["dataset_from_index"], row["dataset_to_index"])
        outcome, seen = _play(env, row[SEED], actions[frames], list(keys))
        different = np.flatnonzero((seen != states[frames][: len(seen)]).any(axis=1))
        first = int(different[0]) if different.size else None
        if first is None and len(seen) < row["length"]:
            first = len(seen)
        yield Replay(row["episode_index"], row[SEED], outcome, first)


def recorded_setting(config: Mapping[str, Any], **chosen: Any) -> Setting:
    """Return the setting that a dataset was recorded in; options that were not there are defaults.

    Args:
        config: Options of the recording.
        **chosen: Fields that take other values.
    """
    known = {
        option.name: config[option.name] for option in fields(Setting) if option.name in config
    }
    return Setting(**(known | chosen))


def _play(
    env: LabEnv, seed: int, actions: NDArray[np.float32], observed: list[str]
) -> tuple[str, NDArray[np.float32]]:
    """Return the outcome and the states before each action, shape (frames, elements)."""
    observation, info = env.reset(seed=seed)
    seen = []
    for action in actions:
        seen.append(np.concatenate([observation[path] for path in observed]))
        observation, _, terminated, truncated, info = env.step(action)
        if terminated or truncated:
            break
    return str(info["outcome"]), np.array(seen)
