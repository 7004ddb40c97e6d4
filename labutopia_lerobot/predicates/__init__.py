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
from labutopia_lerobot.predicates.counting import Count, swings, turns
from labutopia_lerobot.predicates.damage import broken, collided
from labutopia_lerobot.predicates.liquids import liquid_moving, poured, spilled
from labutopia_lerobot.predicates.openables import (
    above,
    clear_of,
    closed,
    faster,
    grasped,
    latched,
    less_open,
    opened,
)
from labutopia_lerobot.predicates.placing import (
    near,
    released,
    standing_on,
    struck,
    touching,
    withdrawn,
)
from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.squeezing import dispensed, spout_over
from labutopia_lerobot.predicates.stirring import immersed, moving, off_axis, over_mouth
from labutopia_lerobot.predicates.tilting import lip_over, tilted
from labutopia_lerobot.predicates.vessels import (
    falling,
    gripped,
    knocked_over,
    lifted,
    steady,
    upright,
)

__all__ = [
    "Count",
    "Predicate",
    "above",
    "aligned",
    "broken",
    "clear_of",
    "closed",
    "collided",
    "dispensed",
    "falling",
    "faster",
    "fingered",
    "fingers_clear_of",
    "grasped",
    "gripped",
    "immersed",
    "knocked_over",
    "latched",
    "less_open",
    "lifted",
    "lip_over",
    "liquid_moving",
    "moving",
    "near",
    "off_axis",
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
    "swings",
    "switched_on",
    "tilted",
    "touched",
    "touching",
    "turns",
    "upright",
    "withdrawn",
]
