"""Rooms and furniture as MuJoCo specs, and where the cameras of a task stand in them."""

from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.room import Room, Surface, UnknownRoomError

ROOMS = {room.name: room for room in (LABORATORY,)}
"""Every room by its name."""

DEFAULT_ROOM = LABORATORY.name
"""The room of the paper's levels 1 to 4."""


def load_room(name: str) -> Room:
    """Return the room of a name.

    Raises:
        UnknownRoomError: If there is none; the message lists the choices.
    """
    if name not in ROOMS:
        raise UnknownRoomError(f"room={name!r} is unknown. Choose from: {', '.join(ROOMS)}")
    return ROOMS[name]


__all__ = [
    "DEFAULT_ROOM",
    "LABORATORY",
    "ROOMS",
    "Room",
    "Surface",
    "UnknownRoomError",
    "load_room",
]
