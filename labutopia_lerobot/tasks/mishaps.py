"""What must not happen: the other half of an action, shared by the tasks of all levels.

What a number comes from is said on its line.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import reduce
from operator import or_

from labutopia_lerobot.predicates import Predicate, falling, knocked_over, spilled, struck
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.task import Step
from labutopia_lerobot.world import Graspable, OpenVessel, Thing


def handling(
    vessel: Pourable, *, spill: float | None, pouring: Predicate | None = None
) -> dict[str, Predicate]:
    """Return what must not happen to a vessel that is handled.

    Args:
        vessel: What is handled.
        spill: Share of its content that may be spilled (paper: "without spilling"; the number is
            ours); None for an empty one.
        pouring: What excuses a tilt where no liquid is simulated.
    """
    spilling = {}
    if spill is not None:
        lean = _runs_over_deg(vessel)
        spilling["spilled"] = spilled(vessel, share=spill, unless=pouring, beyond_deg=lean)
    return {
        "knocked_over": knocked_over(vessel, beyond_deg=30),
        **spilling,
        "dropped": falling(vessel, faster_than=0.4),  # paper: no drop; ours: 10 mm, less a step
    }


def _runs_over_deg(vessel: OpenVessel) -> float:
    """Return from which lean on a vessel spills where no liquid is simulated [deg].

    A half-full cylinder runs over where the tangent of its lean is its height over the diameter of
    its mouth, one that tapers later. 9 degrees before that: 45 for a beaker; where it is tall and
    narrow 60, from where on a lip that pours must be over its target (`actions.pour`).
    """
    brim = math.degrees(math.atan2(vessel.height, 2 * vessel.mouth_radius))
    return min(max(brim - 9.0, 45.0), 60.0)


def of_any(*each: Mapping[str, Predicate]) -> dict[str, Predicate]:
    """Return what must happen to none of several vessels, from what must not to each."""
    return {name: reduce(or_, (one[name] for one in each)) for name in each[0]}


def sparing(
    bystanders: Iterable[Thing], *steps: Step, but_for: frozenset[str] = frozenset()
) -> tuple[Step, ...]:
    """Return steps during which nothing but the bench, and what may, touches some things."""
    spared = struck(*bystanders, but_for=but_for)
    return tuple(replace(step, never={**step.never, "struck": spared}) for step in steps)


def stirring(rod: Graspable, vessel: OpenVessel, rack: Thing) -> dict[str, Predicate]:
    """Return what must not happen while a rod from a rack stirs in a vessel."""
    return {
        "knocked_over": knocked_over(rod, beyond_deg=30),
        "dropped": falling(rod, faster_than=0.4),  # as `handling`
        "spilled": spilled(vessel, share=0.01),  # paper: "without causing spillage"
        "struck": struck(vessel),
        "rack_struck": struck(rack, but_for=frozenset({rod.name})),
    }
