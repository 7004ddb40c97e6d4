"""What happens when portions meet, worked out by rules.

A deviation from the paper, whose reactions a language model infers: here they follow from
constants. `docs/chemistry.md` says which, and what they do not know.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

from labutopia_lerobot.chemistry import colour, observe
from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.course import ReactionVessel, charge_of, proceed
from labutopia_lerobot.chemistry.hazards import refuse
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.network import WATER, network
from labutopia_lerobot.chemistry.portions import WATER_PER_VOLUME, poured
from labutopia_lerobot.chemistry.reaction import (
    Amounts,
    Conditions,
    Outcome,
    Phase,
    Product,
    Reactant,
    Reaction,
    Yield,
)
from labutopia_lerobot.chemistry.refusals import ImpossibleConditionsError
from labutopia_lerobot.chemistry.rules import indicator
from labutopia_lerobot.chemistry.speciation import ph_of

_BOILING_POINT = 373.15
"""Of water at 101,325 Pa [K]: above it nothing is in solution."""

_RANGES = {
    "temperature": (273.15, 2000.0, "K"),
    "concentration": (1e-6, 2e4, "mol/m^3"),
    "amount": (1e-12, 1e3, "mol"),
    "volume": (0.0, 1.0, "m^3"),
    "ph": (-1.0, 15.0, "pH"),
}
"""What can be asked; estimates of ours of what a laboratory does."""

_HEAT_CAPACITY = 4.168e6
"""Of water by volume at 25 C [J/(m^3 K)]: 4.180 kJ/(kg K) and 997 kg/m^3, CRC Handbook."""


def react(
    portions: Sequence[str | Reactant],
    conditions: Conditions = Conditions(),  # noqa: B008 - frozen
) -> Outcome:
    """Return what happens when portions are poured together.

    Args:
        portions: At least one; a text is a portion with the defaults of `Reactant`.
        conditions: How it is done.

    Raises:
        UnknownCompoundError: A compound is not in the table.
        AmbiguousCompoundError: A name fits several.
        ImpossibleConditionsError: A number is out of its range, or the solvent is not water.
        HazardRefusedError: The mixture is dangerous.
        NoEquilibriumError: The equilibrium was not computed.
    """
    meant = [Reactant(one) if isinstance(one, str) else one for one in portions]
    if not meant:
        raise ImpossibleConditionsError("nothing is poured in. Name at least one compound")
    _check(meant, conditions)
    compounds = [_resolved(one.compound) for one in meant]
    catalysts = [_resolved(name) for name in conditions.catalysts]
    doses = sorted(
        (_dose(one, compound, conditions) for one, compound in zip(meant, compounds, strict=True)),
        key=lambda dose: (dose[0].id, dose[1], dose[2]),
    )
    hot = conditions.temperature > _BOILING_POINT
    volume = 0.0 if hot else math.fsum(dose[2] for dose in doses)
    vessel = ReactionVessel(
        volume=volume,
        temperature=conditions.temperature,
        open_system=conditions.open_system,
        catalysts=_formulas(catalysts),
        ph=conditions.ph,
        alone=len({one.id for one in compounds if one.formula != "H2O"}) == 1,
    )
    before: dict[str, float] = {}
    for compound, amount, own in doses:
        brought = poured(compound, amount, own, conditions.temperature, wet=vessel.is_wet)
        for key, mol in brought.items():
            before[key] = before.get(key, 0.0) + mol
        if vessel.is_wet and compound.formula != "H2O":
            before[WATER] = before.get(WATER, 0.0) + own * WATER_PER_VOLUME
    refuse(charge_of([*compounds, *catalysts], before, vessel))
    after, changes = proceed(before, vessel)
    return _outcome(before, after, changes, vessel, compounds)


@lru_cache(maxsize=4096)
def _resolved(name: str) -> Compound:
    return resolve(name)


def _check(portions: Sequence[Reactant], conditions: Conditions) -> None:
    asked: list[tuple[str, float | None]] = [
        ("temperature", conditions.temperature),
        ("concentration", conditions.concentration),
        ("ph", conditions.ph),
    ]
    for one in portions:
        asked += [("amount", one.amount), ("volume", one.volume)]
    for name, value in asked:
        if value is None:
            continue
        lowest, highest, unit = _RANGES[name]
        if not lowest <= value <= highest:
            raise ImpossibleConditionsError(
                f"{name} {value:g} is not possible here: choose from {lowest:g} to {highest:g} "
                f"{unit}"
            )
    if _resolved(conditions.solvent).formula != "H2O":
        raise ImpossibleConditionsError(
            f"solvent {conditions.solvent!r} is not modelled. Choose water, or pour pure compounds "
            "together (volume=0)"
        )
    for one in portions:
        if one.amount is None and one.volume == 0.0:
            raise ImpossibleConditionsError(
                f"{one.compound}: a portion without volume needs an amount in mol"
            )


def _dose(
    portion: Reactant, compound: Compound, conditions: Conditions
) -> tuple[Compound, float, float]:
    """Return the compound, its amount [mol] and the volume of liquid that it brings [m^3]."""
    if compound.formula == "H2O":
        amount = portion.amount
        volume = portion.volume if amount is None else amount / WATER_PER_VOLUME
        return compound, volume * WATER_PER_VOLUME, volume
    amount = portion.amount
    if amount is None:
        amount = conditions.concentration * portion.volume
    return compound, amount, portion.volume


def _formulas(compounds: Sequence[Compound]) -> frozenset[str]:
    names: set[str] = set()
    for one in compounds:
        names |= {one.formula, f"{one.formula}(s)", one.name.lower(), *one.ions}
    return frozenset(names)


def _enthalpy(amounts: Mapping[str, float]) -> float:
    """Return the sum of the enthalpies of formation of what the network knows [J]."""
    made = network().species
    return math.fsum(mol * made[key].enthalpy for key, mol in amounts.items() if key in made)


def _outcome(
    before: Mapping[str, float],
    after: dict[str, float],
    changes: Sequence[Change],
    vessel: ReactionVessel,
    compounds: Sequence[Compound],
) -> Outcome:
    heat = _enthalpy(before) - _enthalpy(after)
    warming = heat / (vessel.volume * _HEAT_CAPACITY) if vessel.is_wet else 0.0
    seen_before: colour.Rgb = (1.0, 1.0, 1.0)
    seen = seen_before
    ph = None
    if vessel.is_wet:
        seen_before = colour.of_solution(before, vessel.volume)
        seen = colour.of_solution(after, vessel.volume)
        ph = ph_of(after, vessel.volume)
        changes = [*changes, *indicator.changes(compounds, before, after)]
    reactions = []
    for number, change in enumerate(changes, start=1):
        words = observe.of_reaction(change)
        if number == 1:
            words += observe.of_mixture(seen_before, seen, warming)
        reactions.append(_reaction(f"r{number}", change, words))
    return Outcome(
        tuple(reactions),
        Amounts(
            before=dict(before),
            after=after,
            extents={f"r{n}": one.extent for n, one in enumerate(changes, start=1)},
            heat=heat,
            temperature=vessel.temperature + warming,
            volume=vessel.volume,
            ph=ph,
            colour=seen,
            turbid=observe.is_turbid(after, vessel.volume),
        ),
        _note(changes, vessel, warming),
    )


def _note(changes: Sequence[Change], vessel: ReactionVessel, warming: float) -> str:
    notes = []
    if not vessel.is_wet:
        notes.append("There is no water: only reactions of pure compounds were looked for.")
    if any(one.slow for one in changes):
        notes.append("A slow reaction is given as it is at its end.")
    if vessel.is_wet and vessel.temperature + warming > _BOILING_POINT:
        notes.append("The heat would make it boil; evaporation is not modelled.")
    return " ".join(notes)


_PHASES: dict[str, Phase] = {"s": "solid", "g": "gas", "aq": "aq", "l": "aq"}


def _reaction(name: str, change: Change, words: Sequence[str]) -> Reaction:
    made = network().species
    amount: Yield = "high" if change.used > 0.7 else "medium" if change.used > 0.3 else "low"
    return Reaction(
        reaction_id=name,
        reaction_type=change.kind,
        stoichiometry=change.written(),
        expected_products=tuple(
            Product(observe.name_of(key), key[: key.rindex("(")], _PHASES[made[key].phase], amount)
            for key in change.products
        ),
        observable_changes=tuple(words),
        confidence_score=change.confidence,
        rationale=change.rationale,
    )
