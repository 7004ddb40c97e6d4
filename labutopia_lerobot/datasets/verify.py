"""The one judge of a dataset: is every file whole, and is it what the environment does?"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from labutopia_lerobot.datasets.tables import (
    EPISODES,
    OUTCOME,
    RECORDING,
    SEED,
    SETTING,
    DamagedDatasetError,
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
from labutopia_lerobot.datasets.verification.subject import Subject
from labutopia_lerobot.task import SUCCESS

PICTURES = 4
"""Frames of each episode that are drawn again by default."""


@dataclass(frozen=True)
class Verdict:
    """What is known of a dataset.

    Attributes:
        faults: What is wrong with it.
        unchecked: What could not be checked, and why.
    """

    faults: list[str]
    unchecked: list[str]


def verify(root: Path, pictures: int = PICTURES) -> Verdict:
    """Check everything about a dataset that can be checked.

    Args:
        root: Its folder.
        pictures: How many frames of each episode to draw again, `environment.ALL` for every frame.
    """
    return _verdict(
        root,
        [
            *_CHEAP,
            check_statistics,
            check_features,
            lambda subject: check_replay(subject, pictures),
        ],
    )


def find_problems(root: Path) -> list[str]:
    """Return what is wrong with the files of a dataset, without playing anything again."""
    return _verdict(root, _CHEAP).faults


def require_intact(root: Path) -> None:
    """Check the files of a dataset, without playing anything again.

    Raises:
        DamagedDatasetError: If anything is wrong with it; the message lists every problem.
    """
    problems = find_problems(root)
    if problems:
        raise DamagedDatasetError(f"{root} is damaged:\n" + "\n".join(f"  {p}" for p in problems))


def _verdict(root: Path, checks: list[Callable[[Subject], Iterator[Finding]]]) -> Verdict:
    findings: list[Finding] = []
    try:
        subject = Subject.of(root)
        for check in checks:
            findings += check(subject)
    except DamagedDatasetError as error:
        findings.append(Fault(str(error)))
    return Verdict(
        faults=[finding.text for finding in findings if isinstance(finding, Fault)],
        unchecked=[finding.text for finding in findings if isinstance(finding, Unchecked)],
    )


def _check_recording(subject: Subject) -> Iterator[Finding]:
    """Yield what is wrong with what the recording tells of itself."""
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
    seeded = [row for row in subject.episodes if row.get(SEED) is not None]
    seeds = [(row.get(SETTING), row[SEED]) for row in seeded]
    if len(set(seeds)) < len(seeds):
        yield Fault(f"{EPISODES}: a seed occurs twice in {SEED}")


_CHEAP: list[Callable[[Subject], Iterator[Finding]]] = [
    check_info,
    check_episodes,
    check_frames,
    check_videos,
    _check_recording,
]
