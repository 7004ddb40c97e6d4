"""Facts that must not happen: the other half of an action, shared by the tasks of all levels.

What a number comes from is said on its line. What no task forgives, such as broken glass, stands in
`Task.forbidden`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import reduce
from operator import or_

from labutopia_lerobot.predicates import (
    Predicate,
    falling,
    faster,
    knocked_over,
    on_hot_surface,
    spilled,
    struck,
)
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.task import Step
from labutopia_lerobot.world import Graspable, OpenVessel, Thing


def handling(
    vessel: Pourable, *, spill: float | None, into: OpenVessel | None = None
) -> dict[str, Predicate]:
    """Return what must not happen to a vessel that is handled.

    Args:
        vessel: The handled vessel.
        spill: Share of its content that may be spilled (paper: "without spilling"; the number is
            ours); None for an empty one.
        into: What it is poured into, if anything.
    """
    spilling = {} if spill is None else {"spilled": spilled(vessel, share=spill, over=into)}
    return {
        "knocked_over": knocked_over(vessel, beyond_deg=30),
        **spilling,
        "dropped": falling(vessel, faster_than=0.4),  # paper: no drop; ours: 10 mm, less a step
    }


def burning() -> dict[str, Predicate]:
    """Return what must not happen near what is hot; a scene in which nothing heats has no such."""
    # Ours: ISO 13732-1 has 60 C as the threshold of burns by glass and ceramics after 5 to 10 s.
    return {"burnt": on_hot_surface(above_c=60.0)}


def of_any(*each: Mapping[str, Predicate]) -> dict[str, Predicate]:
    """Return what must happen to none of several vessels, from what must not to each."""
    return {name: reduce(or_, (one[name] for one in each)) for name in each[0]}


def slamming(part: Operable, *, faster_than: float) -> dict[str, Predicate]:
    """Return what must not happen to a door or drawer, by any mover (paper: "smoothly").

    Args:
        part: The door or drawer.
        faster_than: Speed of its joint that is not smooth any more [rad/s or m/s].
    """
    return {"slammed": faster(part, than=faster_than)}


def sparing(
    distractors: Iterable[Thing], *steps: Step, but_for: frozenset[str] = frozenset()
) -> tuple[Step, ...]:
    """Return steps during which nothing but the bench, and what may, touches some things."""
    spared = struck(*distractors, but_for=but_for)
    return tuple(replace(step, never={**step.never, "struck": spared}) for step in steps)


def stirring(rod: Graspable, vessel: OpenVessel, rack: Thing) -> dict[str, Predicate]:
    """Return what must not happen while a rod from a rack stirs in a vessel."""
    return {
        "knocked_over": knocked_over(rod, beyond_deg=30),
        "dropped": falling(rod, faster_than=0.4),  # as `handling`
        "spilled": spilled(vessel, share=0.01),  # paper: "without causing spillage"
        # Paper: no "collision"; ours: a rod that stirs may brush the wall.
        "struck": struck(vessel, force=2.0),
        "rack_struck": struck(rack, but_for=frozenset({rod.name})),
    }
