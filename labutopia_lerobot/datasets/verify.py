"""The one judge of a dataset: is every file whole, and is it what the environment does?"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from labutopia_lerobot.datasets.description import RECORDING, DamagedDatasetError
from labutopia_lerobot.datasets.tables import (
    EPISODES,
    OUTCOME,
    SEED,
    SETTING,
    column,
    frames_of_episodes,
)
from labutopia_lerobot.datasets.verification.environment import check_features, check_replay
from labutopia_lerobot.datasets.verification.finding import Fault, Finding, Unchecked
from labutopia_lerobot.datasets.verification.statistics import check_statistics
from labutopia_lerobot.datasets.verification.structure import (
    check_episodes,
    check_frames,
    check_info,
    check_videos,
)
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.scenario.own_files import NO_FILES, OwnFiles
from labutopia_lerobot.task import SUCCESS

PICTURES = 4
"""Frames of each episode that are drawn again by default."""


type Check = Callable[[VerifiedDataset], Iterator[Finding]]

_DAMAGE = (ArithmeticError, LookupError, MemoryError, TypeError, ValueError)
"""Exceptions raised when computing with numbers and texts of the wrong kind."""


@dataclass(frozen=True)
class Verdict:
    """Verdict on a dataset.

    Attributes:
        faults: Its faults, one line each.
        unchecked: What could not be checked, and why.
    """

    faults: list[str]
    unchecked: list[str]


def verify(
    root: Path,
    pictures: int = PICTURES,
    tasks_dir: str | None = None,
    workers: int = 1,
    own_files: OwnFiles = NO_FILES,
) -> Verdict:
    """Check everything about a dataset that can be checked.

    Args:
        root: Its folder.
        pictures: How many frames of each episode to draw again, `environment.ALL` for every frame.
        tasks_dir: A further folder of tasks, which the user trusts: its files run.
        workers: Processes that play episodes again.
        own_files: Those of its room and of the answers that decided what reacts, if any.

    Raises:
        UserError: If one cannot be read, is no room to work in, or holds no answers.
    """
    own_files.read()
    return _verdict(
        root,
        tasks_dir,
        [
            *_CHEAP,
            _whatever_comes(check_statistics),
            check_features,
            lambda subject: check_replay(subject, pictures, workers),
        ],
        own_files,
    )


def find_problems(root: Path) -> list[str]:
    """Return what is wrong with the files of a dataset, without playing anything again."""
    return _verdict(root, None, _CHEAP).faults


def require_intact(root: Path) -> None:
    """Check the files of a dataset, without playing anything again.

    Raises:
        DamagedDatasetError: If anything is wrong with it; the message lists every problem.
    """
    problems = find_problems(root)
    if problems:
        raise DamagedDatasetError(f"{root} is damaged:\n" + "\n".join(f"  {p}" for p in problems))


def _verdict(
    root: Path, tasks_dir: str | None, checks: list[Check], own_files: OwnFiles = NO_FILES
) -> Verdict:
    findings: list[Finding] = []
    try:
        subject = VerifiedDataset.of(root, tasks_dir, own_files)
        for check in checks:
            findings += check(subject)
    except DamagedDatasetError as error:
        findings.append(Fault(str(error)))
    return Verdict(
        faults=[finding.text for finding in findings if isinstance(finding, Fault)],
        unchecked=[finding.text for finding in findings if isinstance(finding, Unchecked)],
    )


def _check_recording(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with the recording's own description."""
    if subject.edited is not None:
        yield Unchecked(f"whether the recording is complete: {subject.edited}")
    elif subject.recording is not None:
        config = subject.recording["config"]
        successes = sum(row[OUTCOME] == SUCCESS for row in subject.episodes)
        tasks = config["task"] if isinstance(config["task"], list) else [config["task"]]
        if successes != len(tasks) * config["episodes"]:
            yield Fault(
                f"{EPISODES}: {successes} successes, but {RECORDING} has {config['episodes']} of "
                f"each of {len(tasks)} tasks"
            )
        if successes < len(subject.episodes) and config["keep"] != "failures":
            yield Fault(f"{EPISODES}: failures, but {RECORDING} keeps successes only")


def _check_seeds(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield where an episode stands there twice.

    Recordings that were merged may have seeds in common, where they differ in code or machine.
    """
    rows = subject.episodes
    seeds = Counter((row.get(SETTING), row[SEED]) for row in rows if row.get(SEED) is not None)
    again = {seed for seed, count in seeds.items() if count > 1}
    before: dict[object, int] = {}
    if not again:
        return
    for row, frames in frames_of_episodes(subject.root, rows):
        seed = (row.get(SETTING), row.get(SEED))
        if seed not in again:
            continue
        same = seed if subject.edited is None else (seed, column(frames, ACTION).tobytes())
        first = before.setdefault(same, row["episode_index"])
        if first != row["episode_index"]:
            yield Fault(
                f"{EPISODES}: episode {row['episode_index']} is episode {first} again: a seed "
                f"occurs twice in {SEED}"
            )


def _whatever_comes(check: Check) -> Check:
    """Return a check of files that calls every oddity a fault.

    Tables of numbers and texts can be wrong in more ways than are listed one by one.
    """

    def careful(subject: VerifiedDataset) -> Iterator[Finding]:
        try:
            yield from check(subject)
        except _DAMAGE as error:
            yield Fault(f"{subject.root} cannot be read: {type(error).__name__}: {error}")

    return careful


_CHEAP: list[Check] = [
    _whatever_comes(check)
    for check in (
        check_info,
        check_episodes,
        check_frames,
        check_videos,
        _check_recording,
        _check_seeds,
    )
]
