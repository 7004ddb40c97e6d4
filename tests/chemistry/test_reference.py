"""The engine against textbooks: the half it was made on and the half it was not."""

from typing import Any

import pytest
import reference

from labutopia_lerobot.chemistry.network import network
from labutopia_lerobot.chemistry.rules import redox


def _right(entries: list[dict[str, Any]]) -> float:
    wrong = 0
    for entry in entries:
        try:
            wrong += reference.disagreement(entry) is not None
        except reference.ChemistryError:
            wrong += 1  # the table does not know the compound
    return 1.0 - wrong / len(entries)


def test_at_least_97_percent_of_the_half_that_was_looked_at_are_right() -> None:
    assert _right(reference.entries(held_out=False)) >= 0.97


def test_at_least_92_percent_of_the_held_out_half_are_right() -> None:
    assert _right(reference.entries(held_out=True)) >= 0.92


def test_the_list_is_long_and_every_entry_has_a_source() -> None:
    halves = [reference.entries(held_out=held) for held in (False, True)]
    assert sum(map(len, halves)) >= 200
    assert all(one["book"] and one["topic"] for half in halves for one in half)


@pytest.mark.parametrize("held_out", [False, True])
def test_every_equation_of_the_list_is_balanced(held_out: bool) -> None:
    for entry in reference.entries(held_out=held_out):
        for equation in entry["equations"]:
            left, right = reference.sides(equation)
            assert reference.atoms(left) == reference.atoms(right), entry["id"]


def test_every_half_reaction_is_balanced_by_its_electrons() -> None:
    for couple in redox.couples():
        atoms: dict[str, int] = {}
        charge = couple.electrons
        for key, n in couple.coefficients.items():
            composition = network().species[key].composition
            charge += n * composition.charge
            for element, count in composition.atoms.items():
                atoms[element] = atoms.get(element, 0) + n * count
        assert not any(atoms.values()), couple.record.equation
        assert charge == 0, couple.record.equation
