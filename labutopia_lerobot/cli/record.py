"""`labutopia-record task=level1/pick episodes=100`: demonstrations as LeRobotDatasets."""

import sys
from collections.abc import Sequence

from hydra import compose, initialize
from hydra.core.config_store import ConfigStore
from hydra.errors import HydraException
from omegaconf import OmegaConf
from omegaconf.errors import OmegaConfBaseException
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import ABOUT, overrides, types_of, why_refused
from labutopia_lerobot.cli.option_list import option_list, task_list
from labutopia_lerobot.cli.recording_bars import RecordingBars
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.recorder import record
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import FinishedError
from labutopia_lerobot.errors import UserError


class OverrideError(UserError):
    """A word that is no option, or a value of the wrong type; the message lists the options."""


@clear_errors
def main() -> None:
    """Record what the command line asks for."""
    arguments = sys.argv[1:]
    if {"-h", "--help"} & set(arguments):
        Console(highlight=False, soft_wrap=True).print(_help(), markup=False)
        return
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    datasets = list(parse(arguments).datasets())
    for dataset in datasets:
        dataset.check()
    for dataset in datasets:
        _record(dataset, len(datasets) > 1, console)


def _record(config: RecordingConfig, one_of_several: bool, console: Console) -> None:
    try:
        with RecordingBars(len(config.tasks) * config.episodes, console) as bars:
            candidates = record(config, bars)
    except FinishedError:
        if not one_of_several:
            raise
        console.print(f"{config.folder} is finished", markup=False)
    else:
        console.print(_summary(config, candidates), markup=False)


def parse(words: Sequence[str]) -> RecordingConfig:
    """Return the configuration that a command line describes.

    Raises:
        OverrideError: If a name is unknown, a value has the wrong type, or no task is named.
    """
    chosen = overrides(words, types_of(RecordingConfig), OverrideError)
    ConfigStore.instance().store(name="record", node=RecordingConfig)
    try:
        # The compose API makes neither an output folder nor a log file, as hydra.main would.
        with initialize(version_base=None, config_path=None):
            composed = compose("record", chosen)
        if composed.task is None and composed.level is None:
            raise OverrideError(
                "Name a task, such as task=level1/pick, or a level, such as level=1.\n"
                + task_list()
            )
        config = OmegaConf.to_object(composed)
    except (HydraException, OmegaConfBaseException) as error:
        raise OverrideError(f"{why_refused(error)} (in: {' '.join(words)})") from None
    assert isinstance(config, RecordingConfig)
    return config


def _help() -> str:
    return (
        "Usage: labutopia-record level1/pick [name=value ...]\n"
        "       labutopia-record level=1 [name=value ...]\n\n"
        "Record demonstrations of the tasks' experts, one LeRobotDataset for each task. A\n"
        "recording that was interrupted goes on when the same command is given again; one that is\n"
        "finished is extended by the same command with more episodes.\n\n"
        f"{ABOUT}\nWith their defaults:\n{option_list(RecordingConfig)}\n\n{task_list()}"
    )


def _summary(config: RecordingConfig, candidates: Sequence[Candidate]) -> str:
    failures = [candidate for candidate in candidates if not candidate.success]
    frames = sum(candidate.frames for candidate in candidates if candidate.stored(config.keep))
    failed = "".join(f"\n  {f.task}, seed {f.seed}: {f.cause}" for f in failures)
    stored = "are stored with their causes" if config.keep == "failures" else "are not stored"
    return (
        f"Recorded {config.episodes} demonstration{'s' * (config.episodes > 1)} of "
        f"{'each of ' * (len(config.tasks) > 1)}{' and '.join(config.tasks)} ({frames} frames)"
        f" in {config.folder}; {len(failures)} of {len(candidates)} episodes failed and "
        f"{stored}{':' if failures else '.'}{failed}"
    )


if __name__ == "__main__":
    main()
