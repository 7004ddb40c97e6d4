"""Recording: worker processes play candidates until enough have succeeded.

Candidates are submitted in index order, and never more than could all be needed. Therefore exactly
the candidates up to the last stored one are played, whatever the number of workers.
"""

import multiprocessing
import shutil
from collections import Counter
from collections.abc import Collection, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from itertools import count, islice
from pathlib import Path
from typing import Protocol

from labutopia_lerobot.datasets.candidate import (
    Candidate,
    finished_candidates,
    play_candidate,
    start_worker,
)
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import claim, publish
from labutopia_lerobot.datasets.verify import require_intact
from labutopia_lerobot.errors import UserError

_PATIENCE = 20
"""Give up once failures outnumber successes by this many."""


class HopelessExpertError(UserError):
    """The expert fails so often that recording on is pointless; the message lists the causes."""


class Watcher(Protocol):
    """Is told how a recording gets on."""

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        """Take note of the candidates that a previous run finished."""
        ...

    def played(self, candidate: Candidate) -> None:
        """Take note of a finished candidate."""
        ...

    def assembled(self, candidate: Candidate) -> None:
        """Take note that a successful candidate is in the dataset."""
        ...


def record(config: RecordingConfig, watcher: Watcher) -> list[Candidate]:
    """Record a dataset, or go on with an unfinished one.

    Returns:
        Every candidate that was played, in index order.

    Raises:
        HopelessExpertError: If the expert fails absurdly often.
        RecordingFolderError: If the folder is in other use.
        UserError: If the configuration is impossible.
        OSError: If the disk is full; what is finished stays and can be gone on with.
    """
    config.check()
    with claim(config.folder, config.provenance) as work:
        candidates = _play(config, work, watcher)
        dataset = _assemble(config, work, candidates, watcher)
        require_intact(dataset)
        publish(config.folder, dataset)
    return candidates


def _play(config: RecordingConfig, work: Path, watcher: Watcher) -> list[Candidate]:
    before = finished_candidates(work)
    watcher.resumed(before)
    candidates = {candidate.index: candidate for candidate in before}
    pending = (index for index in count() if index not in candidates)
    pool = ProcessPoolExecutor(
        config.workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=start_worker,
        initargs=(config,),
    )
    with pool:
        running: set[Future[Candidate]] = set()
        while (missing := _missing(config, candidates.values())) > 0:
            for index in islice(pending, min(config.workers, missing) - len(running)):
                running.add(pool.submit(play_candidate, config, work, index))
            finished, running = wait(running, return_when=FIRST_COMPLETED)
            for candidate in (future.result() for future in finished):
                candidates[candidate.index] = candidate
                watcher.played(candidate)
    return sorted(candidates.values(), key=lambda candidate: candidate.index)


def _missing(config: RecordingConfig, candidates: Collection[Candidate]) -> int:
    failures = [candidate for candidate in candidates if not candidate.success]
    successes = sum(candidate.success for candidate in candidates)
    if len(failures) > successes + _PATIENCE:
        raise HopelessExpertError(
            f"Gave up: the expert of {config.task} failed {len(failures)} times in "
            f"{len(failures) + successes} episodes, mostly by: {_most_common_cause(failures)}. "
            f"The candidates are in {config.folder}"
        )
    return config.episodes - successes


def _most_common_cause(failures: Sequence[Candidate]) -> str | None:
    return Counter(failure.cause for failure in failures).most_common(1)[0][0]


def _assemble(
    config: RecordingConfig, work: Path, candidates: Sequence[Candidate], watcher: Watcher
) -> Path:
    # Imported late: LeRobot brings torch, which takes seconds and which no worker needs.
    from labutopia_lerobot.datasets.assemble import DatasetAssembler

    dataset = work / "dataset"
    if dataset.exists():  # a previous run was killed while it assembled
        shutil.rmtree(dataset)
    assembler = DatasetAssembler(config, work, dataset)
    for candidate in candidates:
        if candidate.success:
            assembler.add(candidate)
            watcher.assembled(candidate)
    assembler.finish(candidates)
    return dataset
