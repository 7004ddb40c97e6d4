"""A folder of work that may be killed at any moment: one process at a time, and always the same."""

import fcntl
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError

_UNCOMPARED = {"uncommitted_changes"}
"""Not compared; a change shows in the hash of the sources."""


@contextmanager
def locked(folder: Path, option: str, refusal: type[UserError]) -> Iterator[None]:
    """Make a folder if there is none, and keep it for this process alone; a kill frees it.

    Args:
        folder: The folder.
        option: Which option names it.
        refusal: Exception to raise otherwise.

    Raises:
        UserError: Of the kind `refusal`, if it cannot be used, or another process uses it.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError as error:
        raise refusal(f"{option}={folder} cannot be used: {error.strerror}") from None
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise refusal(
                f"{option}={folder} is in use by another process. Wait for it, or choose another "
                f"{option}="
            ) from None
        yield
    finally:
        os.close(descriptor)


def differences(there: Mapping[str, Any], here: Mapping[str, Any], prefix: str = "") -> list[str]:
    """Return in what one description differs from another, a line for each.

    Args:
        there: A folder's own description, as it came from JSON.
        here: The same of the present process; what it does not have is not compared at top level.
        prefix: What stands before each name.
    """
    now = json.loads(json.dumps(here))
    lines = []
    for name in sorted(there.keys() | now.keys()) if prefix else now:
        before, after = there.get(name), now.get(name)
        if before == after or name in _UNCOMPARED:
            continue
        if isinstance(after, dict):
            known = before if isinstance(before, dict) else {}
            lines += differences(known, after, f"{prefix}{name}.")
        else:
            lines.append(f"  {prefix}{name}: {before!r} there, {after!r} here")
    return lines


def write_whole(file: Path, content: Mapping[str, Any]) -> None:
    """Write JSON to a file so that it is there whole or not at all."""
    draft = file.with_name(f"{file.name}.tmp")
    draft.write_text(json.dumps(content, indent=1) + "\n")
    draft.rename(file)
