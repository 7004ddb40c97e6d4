"""What holds for any mixture: nothing is lost, and neither order nor repetition matters."""

from collections.abc import Mapping

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.chemistry.course import ReactionVessel, proceed
from labutopia_lerobot.chemistry.engine import react
from labutopia_lerobot.chemistry.formula import parse
from labutopia_lerobot.chemistry.network import network
from labutopia_lerobot.chemistry.reaction import Conditions, Outcome, Reactant
from labutopia_lerobot.chemistry.refusals import ChemistryError

_IDS = sorted(substances())

_amounts = st.floats(1e-6, 1.0)
_volumes = st.sampled_from([0.0, 1e-5, 1e-4, 1e-3])
_portions = st.builds(Reactant, st.sampled_from(_IDS), _amounts, _volumes)
_conditions = st.builds(
    Conditions,
    temperature=st.floats(273.15, 373.0) | st.floats(373.2, 2000.0),
    open_system=st.booleans(),
)
_many = settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)


def _answer(portions: list[Reactant], conditions: Conditions) -> Outcome | None:
    try:
        return react(portions, conditions)
    except ChemistryError:
        return None


def _atoms(amounts: Mapping[str, float]) -> dict[str, float]:
    totals: dict[str, float] = {"charge": 0.0}
    for key, mol in amounts.items():
        formula = parse(key[: key.rindex("(")])
        totals["charge"] += mol * formula.charge
        for element, n in formula.atoms.items():
            totals[element] = totals.get(element, 0.0) + n * mol
    return totals


@_many
@given(st.lists(_portions, min_size=1, max_size=4), _conditions)
def test_atoms_and_charge_are_conserved(portions: list[Reactant], conditions: Conditions) -> None:
    outcome = _answer(portions, conditions)
    if outcome is None:
        return
    before, after = _atoms(outcome.amounts.before), _atoms(outcome.amounts.after)
    poured = sum(mol for key, mol in outcome.amounts.before.items() if key != "H2O(l)")
    for name in before | after:
        largest = poured if name == "charge" else before[name]
        assert after.get(name, 0.0) == pytest.approx(before.get(name, 0.0), abs=1e-9 * largest)


@_many
@given(st.lists(_portions, min_size=1, max_size=4), _conditions)
def test_energy_is_conserved(portions: list[Reactant], conditions: Conditions) -> None:
    outcome = _answer(portions, conditions)
    if outcome is None:
        return

    def enthalpy(amounts: Mapping[str, float]) -> float:
        made = network().species
        return sum(mol * made[key].enthalpy for key, mol in amounts.items() if key in made)

    before, after = enthalpy(outcome.amounts.before), enthalpy(outcome.amounts.after)
    assert before == pytest.approx(after + outcome.amounts.heat, rel=1e-9, abs=1e-6)


@_many
@given(st.lists(_portions, min_size=1, max_size=4), _conditions)
def test_no_amount_is_negative(portions: list[Reactant], conditions: Conditions) -> None:
    outcome = _answer(portions, conditions)
    if outcome is not None:
        assert all(mol >= 0.0 for mol in outcome.amounts.after.values())


@_many
@given(st.lists(_portions, min_size=2, max_size=4), _conditions, st.randoms())
def test_order_does_not_matter(
    portions: list[Reactant], conditions: Conditions, shuffle: object
) -> None:
    outcome = _answer(portions, conditions)
    shuffled = list(portions)
    shuffle.shuffle(shuffled)  # type: ignore[attr-defined]
    other = _answer(shuffled, conditions)
    assert outcome == other


@_many
@given(st.lists(_portions, min_size=1, max_size=3), _conditions)
def test_reacting_the_result_again_changes_nothing(
    portions: list[Reactant], conditions: Conditions
) -> None:
    outcome = _answer(portions, conditions)
    if outcome is None:
        return
    vessel = ReactionVessel(
        volume=outcome.amounts.volume,
        temperature=conditions.temperature,
        open_system=conditions.open_system,
    )
    again, _ = proceed(outcome.amounts.after, vessel)
    scale = sum(mol for key, mol in outcome.amounts.after.items() if key != "H2O(l)")
    for key, mol in outcome.amounts.after.items():
        assert again.get(key, 0.0) == pytest.approx(mol, abs=1e-7 * scale, rel=1e-7)


@_many
@given(st.lists(_portions, min_size=1, max_size=3), _conditions, st.sampled_from([0.1, 2.0, 7.0]))
def test_twice_of_everything_gives_twice_of_everything(
    portions: list[Reactant], conditions: Conditions, times: float
) -> None:
    more = [
        Reactant(one.compound, (one.amount or 0.0) * times, one.volume * times) for one in portions
    ]
    outcome, scaled = _answer(portions, conditions), _answer(more, conditions)
    assert (outcome is None) == (scaled is None)
    if outcome is None or scaled is None:
        return
    scale = sum(mol for key, mol in outcome.amounts.after.items() if key != "H2O(l)")
    for key, mol in outcome.amounts.after.items():
        assert scaled.amounts.after.get(key, 0.0) == pytest.approx(
            times * mol, rel=1e-6, abs=1e-9 * times * scale
        )
