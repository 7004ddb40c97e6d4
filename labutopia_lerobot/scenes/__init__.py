"""Rooms and furniture as MuJoCo specs, and where the cameras of a task stand in them."""

import difflib
from collections.abc import Sequence
from functools import cache

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.furnished_room import furnished_room
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.room import NowhereToDriveError, Room, Surface, UnknownRoomError
from labutopia_lerobot.scenes.room_files import is_of_file, read_before, room_label
from labutopia_lerobot.scenes.rooms_to_drive_in import rooms_to_drive_in

ROOMS = {room.name: room for room in (LABORATORY,)}
"""Rooms that are no plans, by name."""

_LISTED = 30
"""Greatest number of names in a message."""


class NoWorkPlaceError(UserError, ValueError):
    """A room in which no task can be played; the message names some in which one can."""


def load_room(name: str) -> Room:
    """Return the room of a name, such as `laboratory` or `organic_7`, or of a file.

    Args:
        name: Its name, a file that `labutopia-scene generate` made, or what a dataset calls that.

    Raises:
        UnknownRoomError: If there is none; the message names similar names.
        NoWorkPlaceError: If no robot can work in it.
        PlanError: If the file cannot be read or is no plan.
    """
    if name in ROOMS:
        return ROOMS[name]
    label = room_label(name)
    if read_before(label) is not None:
        return _planned_room(label)
    if is_of_file(name):
        raise UnknownRoomError(
            f"room={name!r} is a room of somebody's own: without its file, "
            f"{name.partition('@')[0]}.json, nothing can be played in it. Give that to "
            "labutopia-replay, labutopia-verify or labutopia-render: --room FILE.json"
        )
    known = (*ROOMS, *plan_names())
    if name not in known:
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
        choices = f"Did you mean: {', '.join(near)}?" if near else f"Choose from: {_some(known)}"
        raise UnknownRoomError(
            f"room={name!r} is unknown. {choices} A room of your own: room=FILE.json"
        )
    return _planned_room(name)


def rooms_to_draw() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the furnished rooms that the axis `room` draws from: for training, and for tests.

    Of each family the last room in which one can work is for tests: nobody has trained in it, but
    in others that are furnished alike.
    """
    families: dict[str, list[str]] = {}
    for name in plan_names():
        if (plan := load_plan(name)).work_places:
            families.setdefault(plan.family, []).append(name)
    train = tuple(name for names in families.values() for name in names[:-1])
    return train, tuple(names[-1] for names in families.values())


@cache
def _planned_room(name: str) -> Room:
    plan = read_before(name) or load_plan(name)
    if not plan.work_places:
        train, test = rooms_to_draw()
        fit = sorted((*train, *test))
        raise NoWorkPlaceError(
            f"room={name!r} has no work place, a bench with a stand for the robot before it. Rooms "
            f"that have one: {_some([*ROOMS, *fit])}"
        )
    return furnished_room(plan)


def _some(names: Sequence[str]) -> str:
    """Return names in a line, the first ones of many."""
    more = len(names) - _LISTED
    return ", ".join(names[:_LISTED]) + (f" and {more} more" if more > 0 else "")


__all__ = [
    "LABORATORY",
    "ROOMS",
    "NoWorkPlaceError",
    "NowhereToDriveError",
    "Room",
    "Surface",
    "UnknownRoomError",
    "load_room",
    "room_label",
    "rooms_to_draw",
    "rooms_to_drive_in",
]
