"""The furnished rooms that tasks draw from in which one drives: those with two benches to work at.

Found by program (`scenes.survey`): a robot as wide as the paper's disc of 0.6 m gets to two benches
at least, and docks where its arm reaches a place that nothing stands on.
"""

from collections.abc import Mapping

BENCHES = 2
"""Benches that each of them has at least."""

_ROOMS = {
    "analytical": (0, 1, 2, 3, 4, 6, 7, 8),
    "biology": (0, 4, 7, 8),
    "corridor": (1, 2, 9),
    "glove_box": (2, 3, 4, 5, 6, 9),
    "organic": (1, 2, 4, 7, 8, 9),
    "physics": (0, 1, 2, 3, 5, 9, 10),
    "preparation": (2, 6, 8),
    "teaching": (0, 1, 4, 5, 6, 9),
    "weighing_room": (0, 1, 2, 3, 5),
}
"""Family -> numbers of its rooms."""

_WITH_SINKS = {
    "analytical": (2, 3, 6, 7, 8, 9),
    "biology": (0, 1, 3, 4, 7),
    "corridor": (0, 1, 2, 4, 5, 9),
    "glove_box": (0, 2, 3, 4, 5, 6, 7, 8, 9),
    "organic": (4, 7, 8),
    "preparation": (0, 2, 3, 4, 5, 6, 7, 8, 9),
    "teaching": (1, 2, 5, 8, 9, 10),
}
"""Family -> numbers of its rooms in which every robot gets to a sink and to a bench with free
places for three things to take from above, 0.25 m apart; one bench is enough."""

_SHALLOW = frozenset(
    {"analytical_0", "analytical_2", "analytical_6", "organic_9", "physics_2", "physics_5"}
)
"""Those of them in which no robot gets to a bench on which an oven can stand."""

_HELD_OUT = ("corridor", "weighing_room")
"""Families that are for tests only: nobody has trained in rooms that are furnished alike; ours."""


def rooms_to_drive_in() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the rooms for training, and those for tests."""
    train = tuple(family for family in _ROOMS if family not in _HELD_OUT)
    return _named(train), _named(_HELD_OUT)


def rooms_with_deep_benches() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return those of them with a bench for an oven, for training and for tests."""
    train, test = rooms_to_drive_in()
    return (
        tuple(room for room in train if room not in _SHALLOW),
        tuple(room for room in test if room not in _SHALLOW),
    )


def rooms_with_sinks() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the rooms with a sink and a bench for three things, for training and for tests."""
    train = tuple(family for family in _WITH_SINKS if family not in _HELD_OUT)
    test = tuple(family for family in _WITH_SINKS if family in _HELD_OUT)
    return _named(train, _WITH_SINKS), _named(test, _WITH_SINKS)


def _named(
    families: tuple[str, ...], rooms: Mapping[str, tuple[int, ...]] = _ROOMS
) -> tuple[str, ...]:
    return tuple(f"{family}_{number}" for family in families for number in rooms[family])
