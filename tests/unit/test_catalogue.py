"""Instruments are found by their files; what is wrong with a name or a file is reported."""

from types import ModuleType

import pytest

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware import instrument_catalogue as room
from labutopia_lerobot.labware.instrument_catalogue import CatalogueError, catalogue, instrument
from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace


def test_an_instrument_is_found_by_the_name_of_its_file():
    assert catalogue()["muffle_furnace"] is MuffleFurnace
    assert instrument("muffle_furnace", "furnace") == MuffleFurnace("furnace")
    assert instrument("cabinet") == Cabinet("cabinet")


def test_an_unknown_one_is_reported_with_the_nearest_and_all_others():
    with pytest.raises(UserError, match="Did you mean 'muffle_furnace'\\?") as reported:
        instrument("mufle_furnace")
    assert all(kind in str(reported.value) for kind in catalogue())


@pytest.mark.parametrize("members", [{}, {"A": Cabinet, "B": MuffleFurnace}, {"A": object}])
def test_a_module_that_does_not_define_one_instrument_is_reported(members):
    module = ModuleType("some.module")
    for name, kind in members.items():
        vars(module)[name] = type(name, (kind,), {"__module__": "some.module"})
    with pytest.raises(CatalogueError, match=r"some\.module must define one"):
        room._instrument_of(module)
