"""Routes of an episode as its dataset has them: map, planned paths, key waypoints.

All in the world frame [m]: that of the map, which the room has too (`load_room(room).map()`).
Lengths are rounded to millimetres, headings to 1e-4 rad.
"""

import base64
from typing import TypedDict

from labutopia_lerobot.navigation.occupancy import Occupancy


class RoomMap(TypedDict):
    """A map as ROS has it: a picture, and where it lies.

    Attributes:
        png: The picture (`Occupancy.png`), in base64.
        origin: Where the south-west corner of its lowest, leftmost pixel is: x, y [m].
        resolution: Width of a pixel [m].
    """

    png: str
    origin: list[float]
    resolution: float


class PlannedPath(TypedDict):
    """A path as it was planned.

    Attributes:
        t: When [s].
        thing: Name of the thing that it leads to.
        around: Names of those who were gone round, where they were at that time.
        waypoints: Key waypoints: x, y [m].
        path: Points a decimetre apart: x, y [m] and heading [rad].
        dock: Place at the bench to which it leads: x, y [m] and heading [rad].
    """

    t: float
    thing: str
    around: list[str]
    waypoints: list[list[float]]
    path: list[list[float]]
    dock: list[float]


class Routes(TypedDict):
    """What one knew of the room beforehand, and where one planned to go.

    Attributes:
        room: Its name, or that of its file and a hash.
        map: Its map, before anybody drives.
        paths: In the order in which they were planned.
    """

    room: str
    map: RoomMap
    paths: list[PlannedPath]


def map_of(occupancy: Occupancy) -> RoomMap:
    """Return a map as a dataset has it."""
    return RoomMap(
        png=base64.b64encode(occupancy.png).decode(),
        origin=[float(c) for c in occupancy.origin],
        resolution=occupancy.resolution,
    )


def occupancy_of(stored: RoomMap) -> Occupancy:
    """Return the map that a dataset has.

    Raises:
        ValueError: If it is no map.
    """
    try:
        (x, y), resolution = stored["origin"], stored["resolution"]
        png = base64.b64decode(stored["png"], validate=True)
        return Occupancy.of_png(png, (float(x), float(y)), float(resolution))
    except (KeyError, TypeError) as error:
        raise ValueError(f"It has not what a map has: {error!r}") from None


def difference(there: Routes | None, here: Routes | None) -> str | None:
    """Return in what routes differ, None if in nothing.

    Args:
        there: What a dataset says.
        here: What this environment plans.
    """
    if there is None or here is None:
        return None if there is here else "somebody drives in one of them only"
    if there["room"] != here["room"]:
        return f"its room is {there['room']!r}, but the environment has {here['room']!r}"
    try:
        known = occupancy_of(there["map"])
    except ValueError as error:
        return f"its map cannot be read. {error}"
    if known.sha256 != occupancy_of(here["map"]).sha256:
        return f"its map is not that of {here['room']} here"
    for number, path in enumerate(there["paths"]):
        planned = here["paths"][number] if number < len(here["paths"]) else None
        if planned is None:
            return f"no path to {path['thing']!r} is planned at {path['t']:g} s (path {number})"
        wrong = [key for key, value in planned.items() if path.get(key) != value]
        if wrong:
            return f"path {number} is another than the one that is planned here: {wrong[0]}"
    return None
