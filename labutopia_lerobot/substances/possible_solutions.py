"""Whether the solutions of a task can be, alone and poured together."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations

import numpy as np

from labutopia_lerobot.chemistry.course import ReactionVessel, charge_of
from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.hazards import refuse
from labutopia_lerobot.chemistry.inventory import Inventory, Solute, made_up
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.substances.filling import Filling, ImpossibleFillingError
from labutopia_lerobot.substances.substance import WATER, ZERO_C
from labutopia_lerobot.world import Thing

_ROOM = 293.15
"""As warm as solutions are when they meet, if they are no warmer [K]."""

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
            cold as it is; another solvent than water is in the scene; solutions of two vessels are
            dangerous together or boil.
    """
    if not any(filling.reacts for filling in contents.values()):
        return
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
        _require(task, [vessel], {filling: filling.volume}, "Dissolve less of it, or another")
    for both in combinations(contents, 2):
        volumes: dict[Filling, float] = {}
        for vessel in both:
            volumes[contents[vessel]] = volumes.get(contents[vessel], 0.0) + contents[vessel].volume
        _require(task, both, volumes, "Take one of them out of the task, or dilute both")


def _require(
    task: str, vessels: Iterable[Thing], volumes: Mapping[Filling, float], cure: str
) -> None:
    names = " and ".join(vessel.name for vessel in vessels)
    try:
        for fault in _faults(volumes):
            raise ImpossibleFillingError(f"{task}: what is in {names} {fault}. {cure}")
    except ChemistryError as error:
        raise ImpossibleFillingError(f"{task}, {names}: {error}. {cure}") from error


def _faults(volumes: Mapping[Filling, float]) -> Iterator[str]:
    """Yield what is wrong with solutions that are poured together, by their volumes [m^3]."""
    solutes: dict[Solute | Crystals, None] = {}
    total = sum(volumes.values())
    amounts: dict[str, float] = {}
    for filling, volume in volumes.items():
        solutes |= dict.fromkeys(filling.dissolved) | dict.fromkeys(filling.crystals)
        for key, mol in made_up(filling.dissolved).items():
            amounts[key] = amounts.get(key, 0.0) + mol * volume
        for one in filling.crystals:
            amounts[one.species] = amounts.get(one.species, 0.0) + one.mol
    vessel = ReactionVessel(total, _ROOM, slow=False)
    refuse(charge_of([solute.compound for solute in solutes], amounts, vessel))
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
        if sum(solid.values()) > _CLOUDED * float(before[inventory.dissolved].sum()):
            most = max(solid, key=lambda key: solid[key])
            yield f"does not stay dissolved at {own - ZERO_C:g} degrees C: {most} falls out"
    warmest = max([_ROOM, *(f.celsius + ZERO_C for f in volumes if f.celsius is not None)])
    heat = float((before - after) @ inventory.enthalpies)
    capacity = total * WATER.density * WATER.specific_heat
    if warmest + heat / capacity > WATER.boiling_point:
        yield f"would boil over: it warms by {heat / capacity:.0f} K"
