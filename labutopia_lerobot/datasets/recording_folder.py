"""The folder of a recording: new, unfinished, finished or foreign; killed at any moment.

While a recording is unfinished, everything of it is in `<root>/.recording`. Each step from there to
the finished dataset is one rename, and can be done again.
"""

import fcntl
import json
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.layout import RECORDING, read_json
from labutopia_lerobot.errors import UserError

_WORK = ".recording"
_DISCARDED = ".recording.discarded"
_MANIFEST = "recording.json"


class RecordingFolderError(UserError):
    """A folder that this recording cannot use; the message says why."""


@contextmanager
def claim(root: Path, provenance: dict[str, dict[str, Any]]) -> Iterator[Path]:
    """Make or resume a recording in a folder, which is locked for this process meanwhile.

    Args:
        root: Folder of the dataset.
        provenance: Whatever decides what the dataset holds.

    Yields:
        The folder for everything unfinished.

    Raises:
        RecordingFolderError: If the folder belongs to another recording, to a finished one, to a
            running one or to something else.
    """
    try:
        root.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(root, os.O_RDONLY)
    except OSError as error:
        raise RecordingFolderError(f"root={root} cannot be used: {error.strerror}") from None
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RecordingFolderError(f"{root} is being recorded by another process") from None
        yield _work_folder(root, provenance)
    finally:
        os.close(descriptor)


def publish(root: Path, assembled: Path) -> None:
    """Move an assembled dataset to its place, and then delete everything unfinished."""
    for part in sorted(assembled.iterdir(), key=lambda path: path.name == "meta"):
        if (root / part.name).exists():  # a part of the same dataset, moved before a kill
            shutil.rmtree(root / part.name)
        part.rename(root / part.name)
    (root / _WORK).rename(root / _DISCARDED)
    shutil.rmtree(root / _DISCARDED)


def _work_folder(root: Path, provenance: dict[str, dict[str, Any]]) -> Path:
    work = root / _WORK
    manifest = work / _MANIFEST
    if (root / _DISCARDED).exists():
        shutil.rmtree(root / _DISCARDED)
    if manifest.exists():
        _refuse_other(root, json.loads(manifest.read_text()), provenance)
        return work
    strangers = sorted(path.name for path in root.iterdir() if path != work)
    if (root / RECORDING).exists():
        _refuse_other(root, read_json(root, RECORDING), provenance)
        raise RecordingFolderError(
            f"{root} already holds this recording, finished. Choose another root=, or delete it"
        )
    if strangers:
        raise RecordingFolderError(
            f"{root} holds something that is no recording of ours: {', '.join(strangers[:5])}. "
            "Choose another root="
        )
    work.mkdir(exist_ok=True)
    draft = work / f"{_MANIFEST}.tmp"
    draft.write_text(json.dumps(provenance, indent=2))
    draft.rename(manifest)
    return work


def _refuse_other(
    root: Path, there: dict[str, dict[str, Any]], here: dict[str, dict[str, Any]]
) -> None:
    differences = [
        f"  {name}: {before.get(name)!r} there, {now.get(name)!r} here"
        for part, now in here.items()
        for before in [there.get(part, {})]
        for name in sorted(before.keys() | now.keys())
        if before.get(name) != now.get(name)
    ]
    if differences:
        raise RecordingFolderError(
            f"{root} holds another recording:\n" + "\n".join(differences) + "\n"
            "Choose another root=, or repeat the command that began it"
        )
