"""The furnished rooms that tasks draw from in which one drives: those with two benches to work at.

Found by program (`scenes.survey`): a robot as wide as the paper's disc of 0.6 m gets to two benches
at least, and docks where its arm reaches a place that nothing stands on.
"""

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


def _named(families: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{family}_{number}" for family in families for number in _ROOMS[family])
