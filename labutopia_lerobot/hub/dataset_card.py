"""The card of a dataset: what stands in it, how it was made and how to use it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import MISSING
from typing import Any

import numpy as np
from huggingface_hub import DatasetCardData

from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.evaluation.condition import EXPERT
from labutopia_lerobot.evaluation.rows import EvaluationSummary
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson
from labutopia_lerobot.hub.card import TAGS, dataset_card, rate, summary_row
from labutopia_lerobot.hub.dataset_facts import DatasetFacts
from labutopia_lerobot.hub.feature_meanings import meaning
from labutopia_lerobot.setting import DEFAULT_ROOM, MOBILE_ROBOT, options_of, robot_of_level
from labutopia_lerobot.task import SUCCESS

LOCAL = "local/"
"""Owner of datasets that are on no Hub."""

LICENCE = "apache-2.0"

_GENERATED = ("timestamp", "frame_index", "episode_index", "index", "task_index")
"""Features that LeRobot counts out itself; their statistics say nothing."""

_NOT_TYPED = ("task", "repo_id", "root", "workers")
"""Options that the command of a card names otherwise, or on which the dataset does not depend."""


def card_of_dataset(
    facts: DatasetFacts,
    repo_id: str,
    results: Sequence[EvaluationSummary] = (),
    strip: str | None = None,
) -> str:
    """Return the card of a dataset, in Markdown.

    Args:
        facts: What the dataset is.
        repo_id: Its name on the Hub, or one that begins with `local/`.
        results: Evaluations; the expert's rates in the task of the dataset are shown.
        strip: Address of its strip of pictures, or None.
    """
    config, info = facts.config, facts.info
    successes = sum(row["outcome"] == SUCCESS for row in facts.episodes)
    attempts = successes + len(facts.recording["failures"])
    several = len(facts.tasks) > 1
    of_expert = [
        line for line in results if line.policy == EXPERT and line.condition.task in facts.tasks
    ]
    title = f"LabUtopia, {len(facts.tasks)} tasks" if several else f"LabUtopia {facts.tasks[0]}"
    seeds = [row["seed"] for row in facts.episodes]
    return dataset_card(
        "dataset.md.jinja",
        DatasetCardData(
            license=LICENCE,
            language=["en"],
            pretty_name=f"{title}, {info['total_episodes']} demonstrations",
            task_categories=["robotics"],
            annotations_creators=["machine-generated"],
            size_categories=[size_category(info["total_frames"])],
            source_datasets=["original"],
            tags=[*TAGS, info["robot_type"]],
            configs=[{"config_name": "default", "data_files": "data/*/*.parquet"}],
        ),
        title=title,
        repo_id=repo_id,
        released=not repo_id.startswith(LOCAL),
        root=f"outputs/datasets/{'together' if several else facts.tasks[0]}",
        strip=strip,
        tasks=facts.tasks,
        columns=facts.columns,
        instructions=sorted({task for row in facts.episodes for task in row["tasks"]}),
        config=config,
        room=_room(facts),
        info=info,
        minutes=info["total_frames"] / info["fps"] / 60,
        megabytes=facts.size_bytes / 1e6,
        longest=max(row["frames"] for row in facts.episodes) / info["fps"],
        seeds=f"{min(seeds)} to {max(seeds)}",
        cameras=[key for key, feature in info["features"].items() if feature["dtype"] == "video"],
        features=list(_feature_rows(info["features"])),
        statistics=list(_statistics_rows(facts)),
        successes=successes,
        attempts=rate(successes, attempts, wilson(successes, attempts)),
        failures=facts.recording["failures"],
        expert=[summary_row(line) for line in of_expert],
        sequential=any(line.sequential for line in of_expert),
        code=facts.recording["code"],
        versions={name: v for name, v in facts.recording["versions"].items() if v is not None},
        renderers=facts.recording["renderers"],
        commands=_commands(facts),
    )


def size_category(frames: int) -> str:
    """Return the Hub's name for a number of examples, such as `10K<n<100K`."""
    if frames < 1000:
        return "n<1K"
    names = ("1K", "10K", "100K", "1M", "10M", "100M", "1B", "10B", "100B", "1T")
    power = min(int(math.log10(frames)) - 3, len(names) - 2)
    return f"{names[power]}<n<{names[power + 1]}"


def _room(facts: DatasetFacts) -> str:
    """Return where the episodes were played, in Markdown."""
    room = facts.config["room"]
    drawn = room == DEFAULT_ROOM and robot_of_level(facts.tasks[0]) == MOBILE_ROBOT
    return "drawn for each episode" if drawn else f"`{room}`"


def _commands(facts: DatasetFacts) -> list[str]:
    """Return what makes the dataset again: every option that is not the default."""
    config = dict(facts.config)
    step = config.pop("step", None) if config.get("cut") else None
    defaults = {
        option.name: option.default
        for option in options_of(RecordingConfig)
        if option.default is not MISSING and option.name not in _NOT_TYPED
    }
    if config.get("robot") == robot_of_level(facts.tasks[0]):  # earlier versions wrote it so
        del defaults["robot"]
    chosen = [
        f"{name}={_typed(config[name])}"
        for name, default in defaults.items()
        if name in config and _typed(config[name]) != _typed(default)
    ]
    task = facts.tasks if len(facts.tasks) > 1 else facts.tasks[0]
    recorded = " ".join([f"labutopia-record task={_typed(task)}", *chosen])
    cut = f"labutopia-cut outputs/datasets/{task} --step={step}"
    return [recorded, *([] if step is None else [cut])]


def _typed(value: Any) -> str:
    """Return an option as it is typed on the command line."""
    return f"[{','.join(value)}]" if isinstance(value, list | tuple) else str(value)


def _feature_rows(features: dict[str, dict[str, Any]]) -> Iterator[dict[str, str]]:
    for key, feature in features.items():
        feature_meaning = meaning(key)
        yield {
            "key": key,
            "dtype": feature["dtype"],
            "shape": " x ".join(str(size) for size in feature["shape"]),
            "unit": feature_meaning.unit if feature_meaning else "",
            "text": feature_meaning.text if feature_meaning else "",
        }


def _statistics_rows(facts: DatasetFacts) -> Iterator[dict[str, str]]:
    for key, feature in facts.info["features"].items():
        if key in _GENERATED or key not in facts.statistics:
            continue
        values = {
            name: np.array(numbers, dtype=float).ravel()
            for name, numbers in facts.statistics[key].items()
        }
        picture = feature["dtype"] == "video"
        names = ("red", "green", "blue") if picture else feature["names"]
        for index, name in enumerate(names or ("",)):
            yield {
                "key": key,
                "element": name,
                **{kind: f"{elements[index]:.4g}" for kind, elements in values.items()},
            }
