"""Facts about liquid: poured, spilled, moving.

Where liquid is simulated they are about volumes. Where it is not (`liquid=off`) the same facts are
told from how vessels are tilted, as in the original.
"""

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.tilting import lip_over, tilted
from labutopia_lerobot.world import OpenVessel, Thing, World


def poured(
    vessel: OpenVessel,
    target: OpenVessel,
    *,
    share: float,
    of: Thing | None = None,
    beyond_deg: float = 95.0,
    below: float = 0.20,
) -> Predicate:
    """At least this share of what was filled into the vessel, or into `of`, is in the target.

    Without liquid: the vessel leans more than `beyond_deg` degrees, beyond the level, where nothing
    stays in a beaker, with its lip over the target's mouth, less than `below` metres above.
    """
    tipped = tilted(vessel, beyond_deg=beyond_deg)
    aimed = lip_over(vessel, target, below=below)
    origin = vessel if of is None else of

    def holds(world: World) -> bool:
        liquid = world.liquid
        if liquid is None:
            return tipped.holds(world) and aimed.holds(world)
        arrived = liquid.from_in(origin.name, target.name)
        return arrived > 0.0 and arrived >= share * liquid.originated_in(origin.name)

    def off(world: World) -> dict[str, float]:
        liquid = world.liquid
        if liquid is None:
            return {}
        arrived = liquid.from_in(origin.name, target.name)
        return {"ml": 1e6 * (liquid.originated_in(origin.name) - arrived)}

    return Predicate(f"{100 * share:g} % of {origin.name} poured into {target.name}", holds, off)


def spilled(
    vessel: Thing, *, share: float, unless: Predicate | None = None, beyond_deg: float = 45.0
) -> Predicate:
    """More than this share of what was filled into the vessel lies on the bench or the like.

    What clings to glass, to the hand or to anything else that can move is not spilled yet.

    Without liquid: the vessel leans more than `beyond_deg` degrees (a half-full beaker runs over
    at 52 to 56), unless that fact holds.
    """
    tipped = tilted(vessel, beyond_deg=beyond_deg)

    def holds(world: World) -> bool:
        liquid = world.liquid
        if liquid is not None:
            spilt = liquid.spilled_from(vessel.name)
            return spilt > share * liquid.originated_in(vessel.name)
        return tipped.holds(world) and not (unless is not None and unless.holds(world))

    return Predicate(f"more than {100 * share:g} % of {vessel.name} spilled", holds)


def liquid_moving(vessel: Thing, *, above: float) -> Predicate:
    """Liquid inside the vessel moves at more than `above` metres per second on the average.

    Without liquid: never.
    """
    return Predicate(
        f"liquid in {vessel.name} moving above {above:g} m/s",
        lambda world: world.liquid is not None and world.liquid.speed_in(vessel.name) > above,
    )
