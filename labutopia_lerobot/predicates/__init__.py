"""Named facts about the world: memoryless, relative to the scene, never changing anything."""

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.vessels import (
    falling,
    gripped,
    knocked_over,
    lifted,
    steady,
    upright,
)

__all__ = ["Predicate", "falling", "gripped", "knocked_over", "lifted", "steady", "upright"]
