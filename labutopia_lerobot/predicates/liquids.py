"""Facts about liquid: poured, spilled.

Where liquid is simulated they are about volumes. Where it is not (`liquid=off`) the same facts are
told from how vessels are tilted, as in the original.
"""

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.tilting import Pourable, lip_over, tilted
from labutopia_lerobot.world import Thing, World


def poured(
    vessel: Pourable, target: Pourable, *, share: float, beyond_deg: float = 95.0
) -> Predicate:
    """At least this share of all liquid is in the target.

    Without liquid: the vessel leans more than `beyond_deg` degrees, beyond the level, where nothing
    stays in a beaker, with its lip over the target's mouth.
    """
    tipped, aimed = tilted(vessel, beyond_deg=beyond_deg), lip_over(vessel, target)

    def holds(world: World) -> bool:
        liquid = world.liquid
        if liquid is None:
            return tipped.holds(world) and aimed.holds(world)
        return liquid.inside[target.name] >= share * liquid.total

    return Predicate(f"{vessel.name} poured into {target.name}", holds)


def spilled(
    vessel: Thing, *, share: float, unless: Predicate | None = None, beyond_deg: float = 45.0
) -> Predicate:
    """More than this share of all liquid lies on the bench or on something else that is no vessel.

    Without liquid: the vessel leans more than `beyond_deg` degrees (a half-full beaker runs over
    at 52 to 56), unless that fact holds.
    """
    tipped = tilted(vessel, beyond_deg=beyond_deg)

    def holds(world: World) -> bool:
        liquid = world.liquid
        if liquid is not None:
            return liquid.spilled > share * liquid.total
        return tipped.holds(world) and not (unless is not None and unless.holds(world))

    return Predicate(f"{vessel.name} spilled", holds)
