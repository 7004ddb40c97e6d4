"""An experiment: studies that share a folder, parsed and checked once."""

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, get_origin

from omegaconf import OmegaConf
from omegaconf.errors import OmegaConfBaseException
from yaml import YAMLError

from labutopia_lerobot.errors import did_you_mean
from labutopia_lerobot.evaluation.condition import REFERENCES
from labutopia_lerobot.experiments.part_launcher import LAUNCHERS
from labutopia_lerobot.experiments.study import (
    ExperimentOptionError,
    Study,
    StudyConfig,
    study_of,
)
from labutopia_lerobot.runtime.shipped import shipped
from labutopia_lerobot.setting import option, options_of, require_choices

STUDIES = "studies"
"""Key of a file's list of studies."""


@dataclass
class ExperimentConfig(StudyConfig):
    """Options of `labutopia-experiment`: those of its studies, and of the run."""

    experiment: str | None = option(
        None, "A file of `configs/experiment`, by its name, or one of your own, by its path."
    )
    only: tuple[str, ...] = option((), "Of all tasks, these only: repeats one line of a table.")
    workers: int = field(
        default_factory=lambda: len(os.sched_getaffinity(0)),
        metadata={"help": "Processes that play; no result depends on it."},
    )
    launcher: str = option(
        "local",
        "`local`, or `ray`: parts that do not need each other run at the same time, all over the "
        "cluster at RAY_ADDRESS, whose machines share `out`.",
    )
    device: str | None = option(None, "Device of torch for trainings and evaluations.")
    videos: int = option(1, "How many successes and how many failures of each to film.")
    plan: bool = option(False, "Print what would be done and what it costs, and do nothing.")
    kit: str | None = option(
        None,
        "A folder to fill with all that the trainings need on another machine, one with a GPU and "
        "without a network; records and verifies, and leaves the rest.",
    )
    warm_up: bool = option(
        True, "Whether rates that no earlier part has measured are measured first, in small."
    )
    again: bool = option(
        False, "Whether parts whose inputs have changed are deleted and made anew, not refused."
    )
    out: str = option("", "Folder of everything; `outputs/experiments/NAME` when empty.")


_OF_THE_STUDIES = {each.name for each in fields(StudyConfig)}


@dataclass(frozen=True)
class Experiment:
    """An experiment.

    Attributes:
        name: What it is called.
        studies: Its studies, in order.
        out: Folder of everything.
        only: Of all tasks those that are done, or none for all.
        workers: Processes that play.
        launcher: Where the programs run: `local` or `ray`.
        device: Device of torch, or None for the recipe's, and for CUDA where there is one.
        videos: How many successes and failures of each evaluation are filmed.
        plan: Whether nothing is done.
        kit: Folder for a kit of the trainings, which are then left to another machine, or None.
        warm_up: Whether unknown rates are measured first.
        again: Whether parts whose inputs have changed are made anew.
    """

    name: str
    studies: tuple[Study, ...]
    out: Path
    only: tuple[str, ...]
    workers: int
    launcher: str
    device: str | None
    videos: int
    plan: bool
    kit: Path | None
    warm_up: bool
    again: bool


def experiment_files() -> dict[str, Path]:
    """Return the experiments that come with the package, by name."""
    files = sorted((shipped("configs") / "experiment").glob("*.yaml"))
    return {file.stem: file for file in files}


def make_experiment(chosen: Mapping[str, Any]) -> Experiment:
    """Return the experiment of a command line.

    What the command line says holds for all studies, what the file says beside its studies for
    those that do not say it themselves.

    Args:
        chosen: Options of `ExperimentConfig` that were chosen, by name.

    Raises:
        UserError: If a value is impossible; the message says which are possible.
    """
    file = _file(chosen.get("experiment"))
    name = "experiment" if file is None else file.stem
    content = {} if file is None else _read(file)
    studies = content.pop(STUDIES, [{}])
    if not isinstance(studies, list) or not all(isinstance(each, dict) for each in studies):
        raise ExperimentOptionError(f"{file}: `{STUDIES}` is no list of maps")
    of_studies = {name: value for name, value in chosen.items() if name in _OF_THE_STUDIES}
    config = _merged(ExperimentConfig, file, content, chosen)
    shared = {name: value for name, value in content.items() if name in _OF_THE_STUDIES}
    made = tuple(study_of(_merged(StudyConfig, file, shared, s, of_studies)) for s in studies)
    _require_controls(made)
    tasks = {task for study in made for task in study.tasks}
    for task in config.only:
        if task not in tasks:
            raise ExperimentOptionError(
                f"only={task} is no task of {name}. Tasks: {', '.join(sorted(tasks))}"
            )
    require_choices("launcher", [config.launcher], LAUNCHERS)
    if config.device is not None and not _DEVICE.fullmatch(config.device):
        raise ExperimentOptionError(
            f"device={config.device} is none of torch: choose cpu, cuda, cuda:1, mps or xpu"
        )
    for option_name, least in {"workers": 1, "videos": 0}.items():
        if getattr(config, option_name) < least:
            raise ExperimentOptionError(
                f"{option_name}={getattr(config, option_name)} is too small: at least {least}"
            )
    if config.kit is not None and all(set(study.policies) <= set(REFERENCES) for study in made):
        raise ExperimentOptionError(
            f"kit={config.kit} is for trainings, and no policy of {name} is trained. Leave kit= out"
        )
    return Experiment(
        name=name,
        studies=made,
        out=Path(config.out or f"outputs/experiments/{name}"),
        only=tuple(config.only),
        workers=config.workers,
        launcher=config.launcher,
        device=config.device,
        videos=config.videos,
        plan=config.plan,
        kit=None if config.kit is None else Path(config.kit),
        warm_up=config.warm_up,
        again=config.again,
    )


_DEVICE = re.compile(r"cpu|mps|(cuda|xpu)(:\d+)?")


def _require_controls(studies: Sequence[Study]) -> None:
    """Make sure that what studies are compared with plays the same tasks."""
    for study in studies:
        for task in study.tasks if study.control is not None else ():
            others = {
                each.label_of(policy)
                for each in studies
                for policy in each.policies
                if each != study and task in each.tasks
            }
            if study.control not in others:
                raise ExperimentOptionError(
                    f"control={study.control} is no other policy of {task} here. There are: "
                    f"{', '.join(sorted(others)) or 'none'}"
                )


def _file(named: str | None) -> Path | None:
    files = experiment_files()
    if named is None or named in files:
        return files.get(named or "")
    if Path(named).is_file():
        return Path(named)
    raise ExperimentOptionError(
        f"experiment={named} is neither a file nor one of: {', '.join(files)}."
        + did_you_mean(named, files)
    )


def _read(file: Path) -> dict[str, Any]:
    try:
        content = OmegaConf.to_container(OmegaConf.load(file))
    except (OmegaConfBaseException, YAMLError, UnicodeDecodeError, OSError) as error:
        reason = str(error).splitlines()[0]
        raise ExperimentOptionError(f"{file} cannot be read: {reason}") from None
    if not isinstance(content, dict):
        raise ExperimentOptionError(f"{file} is no map of options")
    return {str(name): value for name, value in content.items()}


def _merged[Options](kind: type[Options], file: Path | None, *layers: Mapping[str, Any]) -> Options:
    """Return options of several layers, of which the last wins."""
    _require_known(kind, file, layers)
    lists = {each.name for each in options_of(kind) if get_origin(each.type) is tuple}
    listed = (
        {name: [v] if name in lists and isinstance(v, str) else v for name, v in layer.items()}
        for layer in layers
    )
    try:
        merged = OmegaConf.merge(OmegaConf.structured(kind), *listed)
        made: Options = OmegaConf.to_object(merged)  # type: ignore[assignment]
    except OmegaConfBaseException as error:
        reason = str(error).strip().splitlines()[0]
        raise ExperimentOptionError(
            ": ".join(str(word) for word in (file, error.full_key, reason) if word)
        ) from None
    return made


def _require_known(kind: type, file: Path | None, layers: Iterable[Mapping[str, Any]]) -> None:
    known = [each.name for each in fields(kind)]
    for name in (name for layer in layers for name in layer):
        if name not in known:
            raise ExperimentOptionError(
                f"{file}: '{name}' is no option.{did_you_mean(name, known)} "
                f"Options: {', '.join(known)}"
            )
