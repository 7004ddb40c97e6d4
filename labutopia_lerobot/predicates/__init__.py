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
from labutopia_lerobot.predicates.counting import Count, pulled, swings, turns
from labutopia_lerobot.predicates.damage import (
    broken,
    collided,
    displaced,
    pressed_out_of_turn,
)
from labutopia_lerobot.predicates.liquids import (
    Transfer,
    contaminated,
    given,
    lip_over,
    liquid_moving,
    poured,
    received,
    spilled,
)
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
from labutopia_lerobot.predicates.pipetting import in_hand, tip_above, tip_in
from labutopia_lerobot.predicates.placing import (
    near,
    released,
    standing_on,
    struck,
    touching,
    withdrawn,
)
from labutopia_lerobot.predicates.predicate import Predicate, predicate
from labutopia_lerobot.predicates.readings import reads, settled
from labutopia_lerobot.predicates.squeezing import dispensed, spout_over
from labutopia_lerobot.predicates.stirring import immersed, over_mouth
from labutopia_lerobot.predicates.temperatures import on_hot_surface, temperature_between
from labutopia_lerobot.predicates.vessels import (
    falling,
    gripped,
    knocked_over,
    lifted,
    steady,
    tilted,
    upright,
)

__all__ = [
    "Count",
    "Predicate",
    "Transfer",
    "above",
    "aligned",
    "broken",
    "clear_of",
    "closed",
    "collided",
    "contaminated",
    "dispensed",
    "displaced",
    "falling",
    "faster",
    "fingered",
    "fingers_clear_of",
    "given",
    "grasped",
    "gripped",
    "immersed",
    "in_hand",
    "knocked_over",
    "latched",
    "less_open",
    "lifted",
    "lip_over",
    "liquid_moving",
    "near",
    "on_hot_surface",
    "opened",
    "over_mouth",
    "poured",
    "predicate",
    "pressed",
    "pressed_out_of_turn",
    "pulled",
    "pushed",
    "reads",
    "received",
    "released",
    "settled",
    "spilled",
    "spout_over",
    "standing_on",
    "steady",
    "struck",
    "swings",
    "switched_on",
    "temperature_between",
    "tilted",
    "tip_above",
    "tip_in",
    "touched",
    "touching",
    "turns",
    "upright",
    "withdrawn",
]
