"""Recording: candidates are played until enough have succeeded, and put together meanwhile."""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from pathlib import Path
from typing import Protocol

from labutopia_lerobot.datasets.candidate import Candidate, finished_candidates
from labutopia_lerobot.datasets.dataset_assembly import Assembly
from labutopia_lerobot.datasets.disk_space import require_space
from labutopia_lerobot.datasets.launcher import Launcher, launcher
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import claim, publish
from labutopia_lerobot.datasets.trials import Trials
from labutopia_lerobot.datasets.verify import require_intact


class Watcher(Protocol):
    """Receives the progress of a recording."""

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        """Take note of the candidates that a previous run finished."""
        ...

    def played(self, candidate: Candidate) -> None:
        """Take note of a finished candidate."""
        ...

    def assembled(self, candidate: Candidate) -> None:
        """Take note that a candidate is in the dataset."""
        ...


def record(config: RecordingConfig, watcher: Watcher) -> list[Candidate]:
    """Record a dataset, go on with an unfinished one, or extend a finished one.

    Args:
        config: One of `RecordingConfig.datasets`.
        watcher: Notified of the progress.

    Returns:
        Every candidate that was played, by task and in index order.

    Raises:
        HopelessExpertError: If the expert fails absurdly often.
        NoSpaceError: If the disk is too small.
        RecordingFolderError: If the folder is in other use.
        UserError: If the configuration is impossible.
        OSError: If the disk is full; what is finished stays and can be gone on with.
    """
    config.check()
    with claim(config.folder, config.provenance) as work:
        assembly = Assembly(config, work, watcher.assembled)
        candidates = _play(config, work, assembly, watcher)
        dataset = assembly.finish(candidates)
        require_intact(dataset)
        publish(config.folder, dataset)
    return candidates


def _play(
    config: RecordingConfig, work: Path, assembly: Assembly, watcher: Watcher
) -> list[Candidate]:
    before = finished_candidates(work)
    by_task = {task: [c for c in before if c.task == task] for task in config.tasks}
    trials = {task: Trials(task, config.episodes, by_task[task]) for task in by_task}
    require_space(config, {task: trial.missing for task, trial in trials.items()})
    watcher.resumed(before)
    if any(trial.missing > 0 for trial in trials.values()):
        with launcher(config, work) as started:
            _play_missing(started, trials, assembly, watcher)
    return [candidate for trial in trials.values() for candidate in trial.played]


def _play_missing(
    started: Launcher, trials: Mapping[str, Trials], assembly: Assembly, watcher: Watcher
) -> None:
    running: set[Future[Candidate]] = set()
    while any(trial.missing > 0 for trial in trials.values()):
        for task, trial in trials.items():
            while len(running) < started.at_once and (index := trial.next()) is not None:
                running.add(started.play(task, index))
        assembly.take(_settled(trials))
        finished, running = wait(running, return_when=FIRST_COMPLETED)
        for candidate in (future.result() for future in finished):
            trials[candidate.task].note(candidate)
            watcher.played(candidate)


def _settled(trials: Mapping[str, Trials]) -> Iterator[Candidate]:
    """Yield the candidates whose place is certain, by task and in index order."""
    for trial in trials.values():
        yield from trial.settled
        if trial.missing > 0:
            return
