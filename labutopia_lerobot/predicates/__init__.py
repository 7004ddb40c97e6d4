"""Named facts about the world: memoryless, relative to the scene, never changing anything."""

from labutopia_lerobot.predicates.buttons import (
    aligned,
    fingered,
    fingers_clear_of,
    pressed,
    pushed,
    switched_on,
    touched,
)
from labutopia_lerobot.predicates.liquids import poured, spilled
from labutopia_lerobot.predicates.openables import (
    clear_of,
    closed,
    collided,
    grasped,
    less_open,
    opened,
)
from labutopia_lerobot.predicates.placing import near, released, standing_on, struck, withdrawn
from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.squeezing import dispensed, spout_over
from labutopia_lerobot.predicates.stirring import dipped, moving, off_axis, on_side, over_mouth
from labutopia_lerobot.predicates.tilting import lip_over, tilted, tilted_left, tilted_right
from labutopia_lerobot.predicates.vessels import (
    falling,
    gripped,
    knocked_over,
    lifted,
    steady,
    upright,
)

__all__ = [
    "Predicate",
    "aligned",
    "clear_of",
    "closed",
    "collided",
    "dipped",
    "dispensed",
    "falling",
    "fingered",
    "fingers_clear_of",
    "grasped",
    "gripped",
    "knocked_over",
    "less_open",
    "lifted",
    "lip_over",
    "moving",
    "near",
    "off_axis",
    "on_side",
    "opened",
    "over_mouth",
    "poured",
    "pressed",
    "pushed",
    "released",
    "spilled",
    "spout_over",
    "standing_on",
    "steady",
    "struck",
    "switched_on",
    "tilted",
    "tilted_left",
    "tilted_right",
    "touched",
    "upright",
    "withdrawn",
]
