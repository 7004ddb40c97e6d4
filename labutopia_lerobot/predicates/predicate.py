"""A named fact about the world."""

from collections.abc import Callable
from dataclasses import dataclass

from labutopia_lerobot.world import World


@dataclass(frozen=True)
class Predicate:
    """A yes-or-no question about the present world.

    Attributes:
        name: How the fact appears in `info["facts"]` and in result files.
        holds: The answer for a world.
    """

    name: str
    holds: Callable[[World], bool]
