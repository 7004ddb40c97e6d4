"""The data files of the engine: sources, and nothing that is never used."""

from importlib.resources import files

import pytest

from labutopia_lerobot.chemistry.network import SpeciesTable
from labutopia_lerobot.chemistry.rules.known import KnownReactionTable, known
from labutopia_lerobot.chemistry.rules.redox import HalfReactionTable

_DATA = files("labutopia_lerobot.chemistry") / "data"


def _species() -> SpeciesTable:
    return SpeciesTable.model_validate_json((_DATA / "species.json").read_text(encoding="utf-8"))


def test_every_number_of_a_species_names_its_source() -> None:
    listed = _species()
    for one in listed.species:
        assert set(one.provenance.values()) <= set(listed.sources), one.formula
        assert not one.made_of or "log_k" in one.provenance, one.formula
        assert one.enthalpy is None or "enthalpy" in one.provenance, one.formula
        assert not one.absorption or "absorption" in one.provenance, one.formula
        assert one.colour is None or "colour" in one.provenance, one.formula


def test_no_species_is_listed_twice() -> None:
    keys = [(one.formula, one.phase) for one in _species().species]
    assert len(keys) == len(set(keys))


def test_every_listed_reaction_is_of_known_species_and_balanced() -> None:
    text = (_DATA / "known_reactions.json").read_text(encoding="utf-8")
    listed = KnownReactionTable.model_validate_json(text)
    used = {one.record.equation for one in known()}
    assert [one.equation for one in listed.reactions if one.equation not in used] == []


@pytest.mark.parametrize(
    ("name", "table"),
    [("half_reactions", HalfReactionTable), ("known_reactions", KnownReactionTable)],
)
def test_every_reaction_names_its_source(
    name: str, table: type[HalfReactionTable] | type[KnownReactionTable]
) -> None:
    read = table.model_validate_json((_DATA / f"{name}.json").read_text(encoding="utf-8"))
    lines = read.half_reactions if isinstance(read, HalfReactionTable) else read.reactions
    assert {one.source for one in lines} <= set(read.sources)
