"""Is it what the environment does? Features, instructions, draws, states and pictures.

Every episode is reset from its seed and given its commands. On the build and machine that recorded
it, everything is the same bit for bit, or the dataset is wrong. On another, rounding may differ:
unless some episode is the same there too, only the amount is reported.
"""

import json
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import batched, chain
from typing import Any

import numpy as np
import pyarrow as pa

from labutopia_lerobot.datasets.declaration import STEP, dataset_features
from labutopia_lerobot.datasets.description import INFO
from labutopia_lerobot.datasets.playback import Playback, Player, outcome_behind
from labutopia_lerobot.datasets.routes import difference
from labutopia_lerobot.datasets.tables import (
    CUT,
    DRAWN,
    MACHINE,
    OUTCOME,
    ROUTES,
    SEGMENTS,
    VOLUMES,
    Row,
    column,
    cut_of,
    episode_setting,
    frames_of_episodes,
)
from labutopia_lerobot.datasets.verification.finding import Fault, Finding, Unchecked
from labutopia_lerobot.datasets.verification.picture_check import PictureCheck
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.foreign_files import printable
from labutopia_lerobot.registry import UnknownTaskError
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.claim import differences
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import SEGMENTATION, Setting
from labutopia_lerobot.sim.segments import segment_names

_LEARNING = ("lerobot", "torch", "torchvision", "diffusers", "transformers", "safetensors")
"""Packages that no episode is played with."""

ALL = -1
"""Number of frames that stands for every frame of an episode."""

_SHARE = 10
"""Episodes that a process plays at a time: it builds their environment once."""


def check_features(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield where the features are not those that the environment declares."""
    settings = {}
    for row in subject.episodes:
        try:
            setting = episode_setting(row, subject.tasks_dir)
        except UnknownTaskError as error:
            yield Unchecked(f"features, replay and pictures of some episodes: {error}")
            return
        if setting is not None:
            settings[setting] = row["episode_index"]
    for setting, episode in settings.items():
        for key, declared in dataset_features(setting).items():
            if key not in subject.features:
                lacking = f"{INFO}: no feature {key}, which {setting.task} has"
                yield Unchecked(lacking) if subject.edited else Fault(lacking)
                continue
            there = subject.features[key]
            recorded = there | (there.get("info") or {})
            declared = declared | declared.pop("info", {})
            for part, here in declared.items():
                if _plain(recorded.get(part)) != _plain(here):
                    yield Fault(
                        f"{INFO}: {part} of {key} is {recorded.get(part)}, but the environment of "
                        f"episode {episode} has {here}"
                    )
    yield from _check_segments(subject, settings)


def _check_segments(subject: VerifiedDataset, settings: Iterable[Setting]) -> Iterator[Finding]:
    """Yield where the numbers of a segmentation are said to mean something else."""
    segmented = [setting for setting in settings if SEGMENTATION in setting.extras]
    meant = {setting: list(segment_names(canonical_task(setting))) for setting in segmented}
    for row in subject.episodes:
        here = meant.get(setting) if (setting := episode_setting(row, subject.tasks_dir)) else None
        if here is not None and json.loads(row.get(SEGMENTS) or "null") != here:
            yield Fault(
                f"{SEGMENTS} of episode {row['episode_index']} is {row.get(SEGMENTS)}, but the "
                f"environment has {here}"
            )


def check_replay(subject: VerifiedDataset, pictures: int, workers: int = 1) -> Iterator[Finding]:
    """Yield where an episode, played again from its seed and commands, is another one.

    Args:
        subject: The dataset.
        pictures: How many frames of each episode to draw again; `ALL` for every frame.
        workers: Processes that play.
    """
    wrong: dict[int, list[str]] = {}
    played = unknown = 0
    try:
        for episode, texts in _replayed(subject, pictures, workers):
            if texts is None:
                unknown += 1
                continue
            played += 1
            if texts:
                wrong[episode] = texts
    except UnknownTaskError as error:
        yield Unchecked(f"replay: {error}")
        return
    if unknown:
        yield Unchecked(f"replay, draws and pictures of {unknown} episodes: {subject.edited}")
    other = _other_build(subject)
    if wrong and len(wrong) == played and other:
        episode, texts = min(wrong.items())
        yield Unchecked(
            f"bit-identical replay: this is another build than the one that recorded ({other}). "
            f"Here {len(wrong)} of {played} episodes differ; episode {episode}: {'; '.join(texts)}"
        )
        return
    for episode, texts in sorted(wrong.items()):
        for text in texts:
            yield Fault(f"episode {episode}: {text}")


_Replayed = list[tuple[int, list[str] | None]]
"""Episodes, each with what differs in it; None where its seed or setting is not known."""


def _replayed(
    subject: VerifiedDataset, pictures: int, workers: int
) -> Iterable[tuple[int, list[str] | None]]:
    """Play all episodes again, share by share."""
    if workers == 1 or len(subject.episodes) <= _SHARE:
        return _replay(subject, pictures)
    shares = (replace(subject, episodes=list(rows)) for rows in batched(subject.episodes, _SHARE))
    return chain.from_iterable(
        in_processes(_replay, ((share, pictures) for share in shares), workers)
    )


def _replay(subject: VerifiedDataset, pictures: int) -> _Replayed:
    subject.own_files.read()
    player, replayed = Player(subject.tasks_dir), _Replayed()
    try:
        for row, frames in frames_of_episodes(subject.root, subject.episodes):
            every = np.arange(row["length"])
            rng = np.random.default_rng(0)  # whatever process plays it, the same frames
            wanted = every if pictures == ALL else rng.permutation(every)[:pictures]
            check = PictureCheck(subject, row, wanted.tolist())
            playback = player.play(row, frames, check.look)
            texts = None
            if playback is not None:
                texts = [*_compare(row, playback), *_compare_pictures(check)]
                texts += _check_step(row, frames)
            replayed.append((row["episode_index"], texts))
    finally:
        player.close()
    return replayed


def _compare(row: Row, playback: Playback) -> Iterator[str]:
    if row["tasks"] != [playback.instruction]:
        instruction = playback.instruction
        yield f"its instruction is {row['tasks']}, but the environment says {instruction!r}"
    for says, key, here in (
        ("drew", DRAWN, playback.drawn),
        ("ends with the volumes", VOLUMES, playback.volumes),
    ):
        there = json.loads(row[key]) if row.get(key) is not None else here
        if there != here:
            yield f"{key} is {there}, but the environment {says} {here}"
    planned = json.loads(row[ROUTES]) if row.get(ROUTES) is not None else playback.routes
    if other := difference(planned, playback.routes):
        yield f"{ROUTES}: {other}"
    if playback.outcome != outcome_behind(row):
        yield f"{OUTCOME} is {row.get(OUTCOME)}, but replayed it is {playback.outcome}"
    if playback.difference is not None:
        first = playback.difference
        yield (
            f"replayed it differs from frame {first.frame} on, first in {first.key}; by at most "
            f"{first.largest:.3g} in all"
        )


def _check_step(row: Row, frames: pa.Table) -> Iterator[str]:
    """Yield where an episode that was cut begins with another step than it says."""
    cut = cut_of(row)
    first = column(frames.slice(0, 1), STEP)[0] if cut is not None else ""
    if cut is not None and first != cut["step"]:
        yield f"{CUT} says {printable(cut['step'])}, but its first frame is of {first}"


def _compare_pictures(check: PictureCheck) -> Iterator[str]:
    for key, deviation in check.worst.items():
        if deviation.by > deviation.allowed:
            yield f"frame {deviation.frame} of {key} is not what the camera sees: {deviation.text}"


def _other_build(subject: VerifiedDataset) -> str | None:
    """Return in what this build differs from the one that recorded, None if in nothing."""
    if subject.recording is None:
        return "which one is not known"
    there = {name: subject.recording.get(name, {}) for name in ("code", "versions")}
    here: dict[str, Any] = {"code": provenance.code([]), "versions": provenance.versions()}
    for build in (there, here):
        build["code"] = {"sources": build["code"].get("sources")}
        build["versions"] = {
            name: version for name, version in build["versions"].items() if name not in _LEARNING
        }
    different = [line.strip() for line in differences(there, here)]
    machines = {row.get(MACHINE) for row in subject.episodes} - {None, provenance.machine()}
    different += [f"machine: {machine}" for machine in sorted(map(str, machines))]
    return "; ".join(different) or None


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple | list) else value
