"""The exact command that plays an entry, or one episode of it, again."""

import shlex
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields
from typing import Any

from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.reporting.entry import Entry
from labutopia_lerobot.evaluation.row import SINGLE, Row

_PROGRAM = ("python", "eval/run.py")
_OF_THE_ROW = ("task", "level", "split", "play", "policy", "seed", "episodes", "axes", "obs")
"""Options that the rows tell, and those that they make needless."""

_OF_THE_RUN = ("out", "workers", "videos", "until", "versus", "episodes_for")
"""Options on which no row depends, or whose work the number of episodes does."""


def command(entry: Entry) -> str:
    """Return the command that plays exactly the rows of an entry."""
    seeds = [row.seed for row in entry.rows]
    return _command(entry, seeds[0], seeds[-1] - seeds[0] + 1)


def episode_command(entry: Entry, row: Row) -> str:
    """Return the command that plays one episode, and films it."""
    return _command(entry, row.seed, 1)


def _command(entry: Entry, seed: int, episodes: int) -> str:
    row = entry.rows[0]
    config = entry.result.provenance.get("config", {})
    words = {
        "task": row.task,
        "policy": row.policy,
        **{f"policy.{name}": config.get("policy", {}).get(name) for name in ("path", "device")},
        "split": row.split,
        "play": None if row.play == SINGLE else row.play,
        "axes": row.axes or None,
        "obs": row.obs,
        "seed": seed,
        "episodes": episodes,
        **dict(_unusual(config)),
    }
    told = [f"{name}={_value(value)}" for name, value in words.items() if value is not None]
    return shlex.join([*_PROGRAM, *told])


def _unusual(config: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the other options that were not left at their defaults."""
    for option in fields(EvaluationConfig):
        if option.name in config and option.name not in (*_OF_THE_ROW, *_OF_THE_RUN):
            value = config[option.name]
            usual = None if option.default is MISSING else option.default
            if _value(value) != _value(usual):
                yield option.name, value


def _value(value: object) -> str:
    """Return a value as Hydra reads it."""
    if isinstance(value, list | tuple):
        return f"[{','.join(map(str, value))}]"
    return str(value)
