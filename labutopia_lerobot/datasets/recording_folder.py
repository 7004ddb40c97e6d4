"""The folder of a recording: new, unfinished, finished or foreign; killed at any moment.

While a recording is unfinished, everything of it is in `<root>/.recording`. Each step from there to
the finished dataset is one rename, and can be done again.
"""

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.description import RECORDING, DamagedDatasetError, read_recording
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.claim import differences, locked, write_whole

_WORK = ".recording"
_DISCARDED = ".recording.discarded"
_MANIFEST = "recording.json"


class RecordingFolderError(UserError):
    """A folder that this recording cannot use; the message says why."""


class FinishedError(RecordingFolderError):
    """A folder that holds this very recording, finished."""


@contextmanager
def claim(root: Path, provenance: dict[str, dict[str, Any]]) -> Iterator[Path]:
    """Make, resume or extend a recording in a folder, which is locked for this process meanwhile.

    Args:
        root: Folder of the dataset.
        provenance: Whatever decides what the dataset holds.

    Yields:
        The folder for everything unfinished.

    Raises:
        RecordingFolderError: If the folder belongs to another recording, to a finished one, to a
            running one or to something else.
    """
    with locked(root, "root", RecordingFolderError):
        yield _work_folder(root, provenance)


def began_with(work: Path) -> dict[str, Any]:
    """Return the provenance of an unfinished recording, as it was when the recording began."""
    provenance: dict[str, Any] = json.loads((work / _MANIFEST).read_text())
    return provenance


def unfinished(root: Path) -> bool:
    """Return whether a recording in a folder has begun, or is extended, and is not over."""
    return (root / _WORK).exists()


def publish(root: Path, assembled: Path) -> None:
    """Move an assembled dataset to its place, and then delete everything unfinished."""
    for part in sorted(assembled.iterdir(), key=lambda path: path.name == "meta"):
        if (root / part.name).exists():  # a part of the same dataset moved before a kill, or of
            shutil.rmtree(root / part.name)  # the shorter one that this one extends
        part.rename(root / part.name)
    (root / _WORK).rename(root / _DISCARDED)
    shutil.rmtree(root / _DISCARDED)


def _work_folder(root: Path, provenance: dict[str, dict[str, Any]]) -> Path:
    work = root / _WORK
    manifest = work / _MANIFEST
    if (root / _DISCARDED).exists():
        shutil.rmtree(root / _DISCARDED)
    if manifest.exists() and any(work.glob("candidate_*")):
        _refuse_other(root, began_with(work), provenance)
        return work
    if manifest.exists():  # such as after a refusal, before anything was played
        shutil.rmtree(work)
    strangers = sorted(path.name for path in root.iterdir() if path != work)
    if (root / RECORDING).exists():
        _extend(root, work, provenance)
    elif strangers:
        raise RecordingFolderError(
            f"{root} holds something that is no recording of ours: {', '.join(strangers[:5])}. "
            "Choose another folder"
        )
    work.mkdir(exist_ok=True)
    write_whole(manifest, provenance)
    return work


def _extend(root: Path, work: Path, provenance: dict[str, dict[str, Any]]) -> None:
    """Take a finished recording apart again, if this one has more episodes and differs in no more.

    The finished dataset stays where it is until the longer one takes its place.
    """
    there = read_recording(root)
    if there is None:
        raise DamagedDatasetError(f"{root} has no {RECORDING}")
    recorded, wanted = there["config"].get("episodes"), provenance["config"]["episodes"]
    shorter = there | {"config": there["config"] | {"episodes": wanted}}
    _refuse_other(root, shorter if recorded < wanted else there, provenance)
    if recorded == wanted:
        raise FinishedError(
            f"{root} already holds this recording, finished. Choose another root=, delete it, or "
            f"extend it with episodes= above {recorded}"
        )
    from labutopia_lerobot.datasets.restoring import restore_candidates

    work.mkdir(exist_ok=True)
    restore_candidates(root, work)


def _refuse_other(
    root: Path, there: dict[str, dict[str, Any]], here: dict[str, dict[str, Any]]
) -> None:
    different = differences(there, here)
    if different:
        raise RecordingFolderError(
            f"{root} holds another recording, or one that other code began:\n"
            + "\n".join(different)
            + "\nChoose another root=, or repeat the command that began it, with the same code"
        )
