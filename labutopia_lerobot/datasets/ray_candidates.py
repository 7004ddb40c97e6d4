"""Candidates on the machines of a Ray cluster: what is played there comes back as files.

No folder needs to be shared. A candidate is a pure function of its seed, so that Ray may play it
again elsewhere when a machine is lost, and the dataset is the same.
"""

import os
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from pathlib import Path

from labutopia_lerobot.datasets.candidate import (
    UNFINISHED,
    Candidate,
    candidate_folder,
    play_into,
    read_candidate,
)
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.claim import differences
from labutopia_lerobot.runtime.ray_cluster import RayError, joined_cluster

Played = dict[str, bytes]
"""The files of a candidate's folder, by name."""


@contextmanager
def ray_cluster(
    config: RecordingConfig, work: Path
) -> Iterator[tuple[int, Callable[[str, int], Future[Candidate]]]]:
    """Join the cluster at `RAY_ADDRESS`, or start one of this machine.

    Args:
        config: Options of the recording.
        work: Folder of the candidates.

    Yields:
        How many candidates are played at once, and what plays one (task, index).

    Raises:
        RayError: If Ray is not installed, or no cluster answers.
    """
    with joined_cluster() as ray:
        remote = ray.remote(num_cpus=1, max_retries=-1)(_play_there)
        expected = _build(config)

        def play(task: str, index: int) -> Future[Candidate]:
            there: Future[Played] = remote.remote(config, expected, task, index).future()
            here: Future[Candidate] = Future()
            there.add_done_callback(
                lambda done: _settle(done, here, candidate_folder(work, task, index))
            )
            return here

        yield int(ray.cluster_resources().get("CPU", 1)), play


def _play_there(
    config: RecordingConfig, expected: dict[str, dict[str, object]], task: str, index: int
) -> Played:
    """Play a candidate on whatever machine this is.

    Raises:
        RayError: If the machine has other code or versions than the one that records.
    """
    os.environ.setdefault("LP_NUM_THREADS", "1")  # Mesa's software renderer: a process per core
    different = differences(expected, _build(config))
    if different:
        raise RayError(
            f"The machine {os.uname().nodename} would record something else:\n"
            + "\n".join(different)
            + "\nInstall the same there"
        )
    with tempfile.TemporaryDirectory() as folder:
        play_into(Path(folder), config, task, index)
        return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def _build(config: RecordingConfig) -> dict[str, dict[str, object]]:
    """Return what must be the same everywhere; where git has the sources from does not matter."""
    there = config.provenance
    code = {name: there["code"][name] for name in ("sources", "tasks")}
    return {"code": code, "versions": there["versions"]}


def _settle(done: Future[Played], settled: Future[Candidate], folder: Path) -> None:
    """Put the files of a candidate into its folder, which appears whole or not at all."""
    try:
        files = done.result()
        unfinished = Path(tempfile.mkdtemp(dir=folder.parent, suffix=UNFINISHED))
        for name, content in files.items():
            (unfinished / name).write_bytes(content)
        unfinished.rename(folder)
        settled.set_result(read_candidate(folder))
    except BaseException as error:
        cause = getattr(error, "cause", None)
        settled.set_exception(cause if isinstance(cause, UserError) else error)
