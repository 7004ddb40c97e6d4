"""Rooms in files of the user's own, and what rows and datasets call them.

There a room is `STEM@HASH`, such as `organic_42@1a2b3c4d`: no path, and no two files are one room.
Such a name is known in a process once it has read the file.
"""

import hashlib
from functools import cache
from pathlib import Path

from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plans import PlanError, plan_from

_SUFFIX = ".json"
_read: dict[str, Plan] = {}


def is_file(room: str) -> bool:
    """Return whether the name of a room is that of a file."""
    return room.endswith(_SUFFIX)


def is_of_file(room: str) -> bool:
    """Return whether the name of a room is one that rows and datasets give to that of a file."""
    return "@" in room and not is_file(room)


def room_label(room: str) -> str:
    """Return what rows and datasets call a room: its name, or that of its file and a hash.

    Raises:
        PlanError: If it is a file that cannot be read or is no plan.
    """
    return _label(room) if is_file(room) else room


def read_before(label: str) -> Plan | None:
    """Return the room of a label, if its file was read in this process."""
    return _read.get(label)


@cache  # once: the file may change while a program runs
def _label(file: str) -> str:
    try:
        content = Path(file).read_bytes()
        plan = plan_from(content.decode(), file)
    except (OSError, UnicodeDecodeError) as error:
        raise PlanError(f"room={file} cannot be read: {error}") from None
    label = f"{Path(file).stem}@{hashlib.sha256(content).hexdigest()[:8]}"
    _read[label] = plan
    return label
