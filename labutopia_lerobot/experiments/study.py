"""What a study is: policies that learn tasks from demonstrations, and how they are judged."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import SINGLE, STAGED
from labutopia_lerobot.evaluation.config import BOTH
from labutopia_lerobot.registry import choose_tasks, listed
from labutopia_lerobot.setting import (
    SPLITS,
    Setting,
    SettingOptions,
    canonical_axes,
    option,
    require_choices,
)


class ExperimentOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@dataclass
class StudyConfig(SettingOptions):
    """Options of a study, beside those of every program that plays."""

    policy: Any = option(None, "A recipe of `policies/`, `expert`, `random`, or a list of these.")
    task: Any = option(None, "Task id, the bare name of a task of the level, or a list of these.")
    level: Any = option(None, "1 to 5, a list of these, or `all`: the paper's tasks.")
    demonstrations: Any = option(
        100, "How many demonstrations are learned from; a list gives a learning curve."
    )
    pace: float = option(
        1.0, "How fast the hand moves in the demonstrations, as a share of the expert's speeds."
    )
    label: str | None = option(
        None, "What tables call the policy; its recipe's name when null. Keeps trainings apart."
    )
    control: str | None = option(
        None,
        "What tables call the policy of another study that differs from this one in one thing: "
        "both are compared on common seeds.",
    )
    steps: int | None = option(None, "Steps of a training; the recipe's when null.")
    epochs: int | None = option(None, "How often every frame is seen, instead of `steps`.")
    batch_size: int | None = option(None, "Frames per step; the recipe's when null.")
    trainings: int = option(
        1,
        "How often it is trained, from one seed to the next: the recipe's first. Each training is "
        "evaluated, and tables say how far they differ.",
    )
    training: Any = option(
        None, "Options of `lerobot-train` beside the recipe's, such as {policy.chunk_size: 20}."
    )
    evaluate_at: Any = option(
        (), "Steps of the training at which it is evaluated too: success over steps."
    )
    split: Any = option("id", "What is evaluated: `id`, `train`, `ood`, or a list.")
    shifts: Any = option(
        (), "Axes that are shifted one by one, each in an evaluation of its own (`split=ood`)."
    )
    play: str = option(
        SINGLE,
        "`single`: one policy plays all steps of a task. `staged`: one policy per step. Or `both`.",
    )
    episodes: int = option(120, "Episodes per evaluation.")


@dataclass(frozen=True)
class Budget:
    """What a training may use.

    Attributes:
        steps: Steps, or None for the recipe's.
        epochs: How often every frame is seen, or None.
        batch_size: Frames per step, or None for the recipe's.
        arguments: Further arguments for `lerobot-train`.
    """

    steps: int | None = None
    epochs: int | None = None
    batch_size: int | None = None
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class Shift:
    """Draws of an evaluation.

    Attributes:
        split: `id`, `train` or `ood`.
        axes: Axes that vary, or with `ood` are shifted, beside the task's own.
    """

    split: str
    axes: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name of its folder."""
        return "-".join([self.split, *self.axes])


@dataclass(frozen=True)
class Study:
    """A study, checked.

    Attributes:
        policies: Recipes, and reference policies such as `expert`.
        label: What tables call the policy, or None for its recipe's name.
        control: What they call that of the study which it is compared with, or None.
        tasks: Task ids.
        demonstrations: Numbers of demonstrations that are learned from, in increasing order.
        pace: How fast the hand moves in them, as a share of the expert's speeds.
        budget: What each training may use.
        trainings: How many there are, which differ in their seed alone.
        evaluate_at: Steps at which a training is evaluated too, in increasing order.
        shifts: What the evaluations draw.
        plays: `single`, `staged`, or both.
        episodes: Episodes per evaluation.
        obs: `pixels` or `state`.
        options: Other options of `Setting` that are not at their defaults, by name.
    """

    policies: tuple[str, ...]
    label: str | None
    control: str | None
    tasks: tuple[str, ...]
    demonstrations: tuple[int, ...]
    pace: float
    budget: Budget
    trainings: int
    evaluate_at: tuple[int, ...]
    shifts: tuple[Shift, ...]
    plays: tuple[str, ...]
    episodes: int
    obs: str
    options: tuple[tuple[str, Any], ...]

    def label_of(self, policy: str) -> str:
        """Return what tables and folders call a policy of it."""
        return self.label or policy


def study_of(config: StudyConfig) -> Study:
    """Return the study that options describe.

    Raises:
        ExperimentOptionError: If a number is out of its range, or options contradict each other.
        UnknownOptionError: If a word is not one of its choices.
        UnknownTaskError: If no task is named, or one that does not exist.
    """
    policies = tuple(map(str, _several(config.policy)))
    if not policies:
        raise ExperimentOptionError("Name a policy, such as policy=act")
    if config.label is not None and len(policies) > 1:
        raise ExperimentOptionError(f"label={config.label} names one policy of {len(policies)}")
    if config.steps is not None and config.epochs is not None:
        raise ExperimentOptionError("steps= and epochs= say the same twice: leave one out")
    splits = tuple(map(str, _several(config.split)))
    require_choices("split", splits, SPLITS)
    if not splits and not _several(config.shifts):
        raise ExperimentOptionError("Nothing is evaluated: name a split, such as split=id")
    if not _several(config.demonstrations):
        raise ExperimentOptionError("Nothing is learned from: say demonstrations=100")
    require_choices("play", [config.play], (SINGLE, STAGED, BOTH))
    said = _said(config.training)
    if config.trainings != 1 and any(word.startswith("--seed=") for word in said):
        raise ExperimentOptionError(
            "trainings= and training={seed} both decide the seed: leave one out"
        )
    for name in ("steps", "epochs", "batch_size", "episodes", "trainings"):
        _require_numbers(name, [getattr(config, name)])
    if config.label is not None and not _NAME.fullmatch(config.label):
        raise ExperimentOptionError(
            f"label={config.label!r} is to be a folder's name: letters, digits, blanks and .,_-"
        )
    for name in ("axes", "shifts"):
        if not all(isinstance(axis, str) for axis in _several(getattr(config, name))):
            raise ExperimentOptionError(f"{name}={getattr(config, name)} is no list of names")
    axes = canonical_axes(config.axes)
    return Study(
        policies=policies,
        label=config.label,
        control=config.control,
        tasks=tuple(choose_tasks(config.task, config.level, config.tasks_dir)),
        demonstrations=_increasing("demonstrations", config.demonstrations),
        pace=config.pace,
        budget=Budget(config.steps, config.epochs, config.batch_size, said),
        trainings=config.trainings,
        evaluate_at=_increasing("evaluate_at", config.evaluate_at),
        shifts=(
            *(Shift(split, axes) for split in splits),
            *(Shift("ood", (str(axis),)) for axis in _several(config.shifts)),
        ),
        plays=(SINGLE, STAGED) if config.play == BOTH else (config.play,),
        episodes=config.episodes,
        obs=config.obs,
        options=tuple(_unusual(config)),
    )


_NAME = re.compile(r"\w[\w .,-]*")
"""A label, which is the name of a folder."""

_OF_THE_STUDY = ("task", "obs", "split", "axes")
"""Fields of `Setting` that have a place of their own in a study."""

_HAVE_OPTIONS = {
    "steps": "steps=",
    "batch_size": "batch_size=",
    "output_dir": "out=",
    "dataset.repo_id": "task=",
    "dataset.root": "out=",
    "policy.device": "device=",
    "policy.type": "policy=",
    "config_path": "policy=",
    "resume": "nothing: what is there is gone on with",
}
"""Options of `lerobot-train` that experiments have their own for, or none."""


def _unusual(config: StudyConfig) -> Iterator[tuple[str, Any]]:
    for each in fields(Setting):
        value = getattr(config, each.name)
        value = tuple(value) if isinstance(value, list) else value
        if each.name not in _OF_THE_STUDY and value != each.default:
            yield each.name, value


def _said(training: Any) -> tuple[str, ...]:
    """Return options of `lerobot-train` as its command line has them."""
    if not isinstance(training, dict | None):
        raise ExperimentOptionError(
            f"training={training} is no map of options, such as {{policy.chunk_size: 20}}"
        )
    for name in training or {}:
        if name in _HAVE_OPTIONS:
            raise ExperimentOptionError(
                f"training={{{name}}}: an experiment decides that itself. Say {_HAVE_OPTIONS[name]}"
            )
    return tuple(f"--{name}={json.dumps(value)}" for name, value in (training or {}).items())


def words_of(options: Mapping[str, Any]) -> list[str]:
    """Return options as our programs take them, `name=value`; without those that are None."""
    return [f"{name}={_word(value)}" for name, value in options.items() if value is not None]


def _word(value: object) -> str:
    if isinstance(value, tuple | list):
        return f"[{','.join(map(str, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value)


def _several(value: Any) -> Sequence[Any]:
    return [] if value is None else listed(list(value) if isinstance(value, tuple) else value)


def _increasing(name: str, value: Any) -> tuple[int, ...]:
    numbers = _several(value)
    _require_numbers(name, numbers)
    return tuple(sorted(set(numbers)))


def _require_numbers(name: str, values: Sequence[Any]) -> None:
    for value in values:
        if value is not None and (type(value) is not int or value < 1):
            raise ExperimentOptionError(f"{name}={value!r} is impossible: a whole number from 1")
