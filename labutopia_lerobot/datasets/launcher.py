"""Launchers of candidates: in processes of this machine, or all over a Ray cluster."""

import multiprocessing
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from labutopia_lerobot.datasets.candidate import Candidate, play_candidate, start_worker
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.runtime.termination import interrupts_held


@dataclass(frozen=True)
class Launcher:
    """Plays candidates.

    Attributes:
        at_once: How many it plays at the same time.
        play: Begins to play a candidate (task, index), whose folder is there when it is done.
    """

    at_once: int
    play: Callable[[str, int], Future[Candidate]]


@contextmanager
def launcher(config: RecordingConfig, work: Path) -> Iterator[Launcher]:
    """Start what `config.launcher` names, and end it again.

    Args:
        config: Options of the recording.
        work: Folder of the candidates.

    Raises:
        UserError: If it cannot be started.
    """
    if config.launcher == "ray":
        from labutopia_lerobot.datasets.ray_candidates import ray_cluster  # needs the extra `ray`

        with ray_cluster(config, work) as started:
            yield Launcher(*started)
        return
    pool = ProcessPoolExecutor(
        config.workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=start_worker,
    )
    with pool:
        yield Launcher(config.workers, partial(_submit, pool, config, work))


def _submit(
    pool: ProcessPoolExecutor, config: RecordingConfig, work: Path, task: str, index: int
) -> Future[Candidate]:
    with interrupts_held():  # it starts processes
        return pool.submit(play_candidate, config, work, task, index)
