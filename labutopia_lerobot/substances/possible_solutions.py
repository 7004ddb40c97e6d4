"""Whether the solutions of a task can be, alone and poured together."""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from itertools import combinations

import numpy as np

from labutopia_lerobot.chemistry.course import ReactionVessel, charge_of
from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.hazards import refuse
from labutopia_lerobot.chemistry.inventory import Inventory, Solute, made_up
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.substances.filling import Dispenser, Filling, ImpossibleFillingError, Narrow
from labutopia_lerobot.substances.substance import WATER, ZERO_C
from labutopia_lerobot.world import Thing

_ROOM = 293.15
"""As warm as solutions are when they meet, if they are no warmer [K]."""

_RATIOS = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Of the volumes of two vessels that are poured together in part: what is most dangerous or warmest
need not be all of both; ours."""

_CLOUDED = 0.01
"""Part of what is dissolved that may fall out of a solution by itself; ours: some copper sulfate
becomes hydroxide."""


def require_possible_solutions[Present: Thing](
    task: str, contents: Mapping[Present, Filling]
) -> None:
    """Make sure, before anything is compiled, that solutions can be made up and poured together.

    Args:
        task: What the task is called.
        contents: What each vessel holds.

    Raises:
        ImpossibleFillingError: Something does not dissolve, or not as much of it, or falls out as
            cold as it is; another solvent than water is in the scene; crystals are more than the
            liquid covers, or where none can lie; solutions of two vessels, or a part of one and
            the other, are dangerous together or boil; all of them are dangerous together.
    """
    if any(filling.reacts for filling in contents.values()):
        _require_possible(task, tuple(contents.items()))


@lru_cache(maxsize=256)  # every reset asks, and episodes often hold the same
def _require_possible(task: str, held: tuple[tuple[Thing, Filling], ...]) -> None:
    contents = dict(held)
    grains: dict[str, float] = {}
    for vessel, filling in contents.items():
        if filling.substance != WATER:
            raise ImpossibleFillingError(
                f"{task}: {vessel.name} cannot hold {filling.of}: something is dissolved in a "
                "vessel of this task, and water is the only solvent that the chemistry knows. Fill "
                "it with water, or dissolve nothing"
            )
        for crystals in filling.crystals:
            try:
                crystals.require_known()
            except ChemistryError as error:
                raise ImpossibleFillingError(f"{task}, {vessel.name}: {error}") from error
            if grains.setdefault(crystals.species, crystals.grain_mm) != crystals.grain_mm:
                raise ImpossibleFillingError(
                    f"{task}, {vessel.name}: crystals of {crystals.of} of two sizes cannot be in "
                    "one task: give them one grain_mm"
                )
        _require_on_the_bottom(task, vessel, filling)
        _require(task, [vessel], {filling: filling.volume}, "Dissolve less of it, or another")
    for both in combinations(contents, 2):
        first, second = (contents[vessel] for vessel in both)
        parts = {(first.volume, second.volume): None}
        for ratio in _RATIOS:
            part = min(first.volume, ratio * second.volume)
            parts[part, part / ratio] = None
        for one, other in parts:
            volumes = {first: one}
            volumes[second] = volumes.get(second, 0.0) + other
            _require(task, both, volumes, "Take one of them out of the task, or dilute both")
    whole: dict[Filling, float] = {}
    for filling in contents.values():
        whole[filling] = whole.get(filling, 0.0) + filling.volume
    try:
        _refuse_danger(whole)
    except ChemistryError as error:
        raise ImpossibleFillingError(
            f"{task}, all of its vessels together: {error}. Take one of them out of the task"
        ) from error


def _require_on_the_bottom(task: str, vessel: Thing, filling: Filling) -> None:
    """Refuse crystals where none can lie, or more than the liquid covers."""
    if not filling.crystals:
        return
    if isinstance(vessel, Dispenser) or (isinstance(vessel, Narrow) and vessel.column):
        raise ImpossibleFillingError(
            f"{task}: {vessel.name} cannot hold crystals, as it is a bottle or a narrow tube. Put "
            "them into a beaker or a flask"
        )
    heap = sum(one.mol * one.heaped_volume for one in filling.crystals)
    if heap > filling.volume:
        raise ImpossibleFillingError(
            f"{task}: the crystals in {vessel.name} make a heap of {1e6 * heap:.0f} ml, which "
            f"{filling.ml:g} ml do not cover. Put in fewer, or fill in more"
        )


def _require(
    task: str, vessels: Iterable[Thing], volumes: Mapping[Filling, float], cure: str
) -> None:
    names = " and ".join(vessel.name for vessel in vessels)
    try:
        for fault in _faults(volumes):
            raise ImpossibleFillingError(f"{task}: what is in {names} {fault}. {cure}")
    except ChemistryError as error:
        raise ImpossibleFillingError(f"{task}, {names}: {error}. {cure}") from error


def _refuse_danger(volumes: Mapping[Filling, float]) -> dict[str, float]:
    """Return what solutions that are poured together hold, by their volumes [m^3], in mol by key.

    Raises:
        ChemistryError: They are dangerous together.
    """
    solutes: dict[Solute | Crystals, None] = {}
    amounts: dict[str, float] = {}
    for filling, volume in volumes.items():
        solutes |= dict.fromkeys(filling.dissolved) | dict.fromkeys(filling.crystals)
        for key, mol in made_up(filling.dissolved).items():
            amounts[key] = amounts.get(key, 0.0) + mol * volume
        for one in filling.crystals:
            grains = one.mol * volume / filling.volume
            amounts[one.species] = amounts.get(one.species, 0.0) + grains
    vessel = ReactionVessel(sum(volumes.values()), _ROOM, slow=False)
    refuse(charge_of([solute.compound for solute in solutes], amounts, vessel))
    return amounts


def _faults(volumes: Mapping[Filling, float]) -> Iterator[str]:
    """Yield what is wrong with solutions that are poured together, by their volumes [m^3]."""
    total, amounts = sum(volumes.values()), _refuse_danger(volumes)
    solids = [one.species for filling in volumes for one in filling.crystals]
    inventory = Inventory.of([filling.dissolved for filling in volumes], solids)
    before = inventory.row(amounts)
    after, why = inventory.settled(before, total, _ROOM)
    if why:
        yield f"cannot be worked out: {why}"
    if len(volumes) == 1:
        (filling,) = volumes
        own = _ROOM if filling.celsius is None else filling.celsius + ZERO_C
        lying, _ = inventory.settled(before, total, own)
        more = inventory.amounts(np.maximum(lying - before, 0.0))
        solid = {key: mol for key, mol in more.items() if key.endswith("(s)")}
        dissolved = np.maximum(before, lying)[inventory.dissolved].sum()  # crystals dissolve too
        if sum(solid.values()) > _CLOUDED * float(dissolved):
            most = max(solid, key=lambda key: solid[key])
            yield f"does not stay dissolved at {own - ZERO_C:g} degrees C: {most} falls out"
    warmest = max([_ROOM, *(f.celsius + ZERO_C for f in volumes if f.celsius is not None)])
    heat = float((before - after) @ inventory.enthalpies)
    capacity = total * WATER.density * WATER.specific_heat
    if warmest + heat / capacity > WATER.boiling_point:
        yield f"would boil over: it warms by {heat / capacity:.0f} K"
