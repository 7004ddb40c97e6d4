"""Judging goes by names: the name of a predicate shows every argument, and equal ones are one."""

import inspect
from functools import partial
from typing import Any

import numpy as np
import pytest

from labutopia_lerobot import predicates
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instruments.button_panel import ButtonPanel
from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.handling.piston_pipette import PistonPipette
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.labware.instruments.support.tube_rack import TubeRack
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.places import Destination, OverBench, WhereItStood
from labutopia_lerobot.predicates import Transfer, gripped, lifted, predicate, standing_on
from labutopia_lerobot.predicates.buttons import Switchable
from labutopia_lerobot.predicates.openables import Bar, Latching, Openable
from labutopia_lerobot.predicates.pipette_tip import Pipette
from labutopia_lerobot.predicates.placing import Holder
from labutopia_lerobot.predicates.predicate import PredicateFunction, PredicateNameError
from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.predicates.squeezing import Squeezable
from labutopia_lerobot.predicates.stirring import Filled
from labutopia_lerobot.world import Button, OpenVessel, Standing, Thing, World

SMALL, LARGE = (
    glassware("beaker", "150 ml", "small"),
    glassware("beaker", "800 ml", "large"),
)
OVEN, OTHER_OVEN = DryingOven("oven", latching=True), DryingOven("other", latching=True)
PANEL = ButtonPanel("panel")
DRAWER, _, OTHER_DRAWER = Cabinet("cabinet").drawers
VESSELS = (SMALL, LARGE)
SAMPLES: dict[Any, tuple[Any, Any]] = {
    Thing: VESSELS,
    Standing: VESSELS,
    OpenVessel: VESSELS,
    OpenVessel | None: (None, LARGE),
    Filled: VESSELS,
    Squeezable: (WashBottle("bottle"), WashBottle("other")),
    Destination: (WhereItStood(SMALL), OverBench("middle of the bench", ahead=0.5)),
    Holder: (TubeRack("rack"), TubeRack("other")),
    Bar: (DRAWER.handle, OTHER_DRAWER.handle),
    Openable: (DRAWER, OTHER_DRAWER),
    Latching: (OVEN.door, OTHER_OVEN.door),
    Button: ButtonPanel("panel").buttons[:2],
    Pipette: (PistonPipette("pipette"), PistonPipette("other")),
    Readable: (Heater("heater").switch, Heater("other").switch),
    Switchable: (Heater("heater").switch, Heater("other").switch),
    Transfer: (Transfer(SMALL, LARGE), Transfer(LARGE, SMALL)),
    frozenset[str]: (frozenset(), frozenset({"hand"})),
    float: (0.1, 0.2),
    str: ("green", "blue"),
}
"""Annotation of an argument -> two values of it."""

FUNCTIONS = [
    function
    for name in predicates.__all__
    if hasattr(function := getattr(predicates, name), "__wrapped__")
]


def called(function: PredicateFunction[Any], changed: str | None = None) -> predicates.Predicate:
    """Make a predicate of first sample values, but for one argument, which gets the second."""
    positional, named = [], {}
    for name, parameter in inspect.signature(function).parameters.items():
        value = SAMPLES[parameter.annotation][name == changed]
        if parameter.kind is parameter.KEYWORD_ONLY:
            named[name] = value
        else:
            positional.append(value)
    return function(*positional, **named)


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_a_name_shows_every_argument(function: PredicateFunction[Any]):
    first = called(function)
    assert called(function) == first
    for argument in inspect.signature(function).parameters:
        other = called(function, changed=argument)
        assert other.name != first.name, argument
        assert other != first, argument


def test_every_predicate_of_the_package_is_among_them():
    made = {name for name in predicates.__all__ if name[0].islower()}
    counts = {"lasted", "pulled", "swings", "turns"}
    assert made - counts - {"predicate", "latched"} == {function.__name__ for function in FUNCTIONS}


def test_a_catch_is_needed_to_latch_and_the_door_stands_in_the_name():
    names = {predicates.latched(oven.door).name for oven in (OVEN, OTHER_OVEN)}
    assert len(names) == 2


def test_a_template_that_lacks_an_argument_is_refused():
    def high(world: World, thing: Thing, *, above: float) -> bool:
        return True

    with pytest.raises(PredicateNameError, match="It lacks: above"):
        predicate("{thing} high")(high)
    with pytest.raises(PredicateNameError, match="It has too much: by"):
        predicate("{thing} high above {above} by {by}")(high)


def test_several_things_are_all_in_the_name():
    assert predicates.struck(SMALL, LARGE).name.startswith("small or large struck")
    assert predicates.collided().name != predicates.collided(SMALL).name


def test_what_is_put_down_twice_stands_in_two_places():
    there, elsewhere = OverBench("left", ahead=0.5, left=0.1), OverBench("right", ahead=0.5)
    assert standing_on(SMALL, there).name != standing_on(SMALL, elsewhere).name


def test_equal_calls_make_equal_predicates_and_others_do_not():
    assert lifted(SMALL, by=0.1) == lifted(SMALL, by=0.1)
    assert lifted(SMALL, by=0.1) != lifted(LARGE, by=0.1)
    assert ~gripped(SMALL) == ~gripped(SMALL)
    assert gripped(SMALL) | lifted(SMALL, by=0.1) != gripped(SMALL) | lifted(SMALL, by=0.2)


def test_predicates_of_partial_functions_and_of_arrays_can_be_compared():
    limit = partial(max, 1)
    assert predicates.Predicate("x", limit) == predicates.Predicate("x", limit)
    point = np.zeros(3)
    assert predicates.Predicate("x", limit, ((point,), {})) == predicates.Predicate(
        "x", limit, ((point,), {})
    )


def test_not_turns_a_fact_round():
    fact = predicates.Predicate("so", lambda world: True)
    assert fact.holds(None)  # type: ignore[arg-type]
    assert not (~fact).holds(None)  # type: ignore[arg-type]
    assert (~fact).name == "not (so)"


def test_vessels_are_values():
    assert isinstance(SMALL, Vessel)
    assert glassware("beaker", "150 ml", "small") == SMALL
