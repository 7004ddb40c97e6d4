"""Routes of an episode as its dataset has them: map, planned paths, key waypoints.

All in the world frame [m]: that of the map, which the room has too (`load_room(room).map()`).
Lengths are rounded to millimetres, headings to 1e-4 rad.
"""

from typing import TypedDict


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
        map: Digest of its map (`Occupancy.sha256`).
        paths: In the order in which they were planned.
    """

    room: str
    map: str
    paths: list[PlannedPath]


def difference(there: Routes | None, here: Routes | None) -> str | None:
    """Return in what routes differ, None if in nothing.

    Args:
        there: What a dataset says.
        here: What this environment plans.
    """
    if there is None or here is None:
        return None if there is here else "somebody drives in one of them only"
    for key in ("room", "map"):
        if there[key] != here[key]:
            return f"its {key} is {there[key]!r}, but the environment has {here[key]!r}"
    for number, path in enumerate(there["paths"]):
        planned = here["paths"][number] if number < len(here["paths"]) else None
        if planned is None:
            return f"no path to {path['thing']!r} is planned at {path['t']:g} s (path {number})"
        wrong = [key for key, value in planned.items() if path.get(key) != value]
        if wrong:
            return f"path {number} is another than the one that is planned here: {wrong[0]}"
    return None
