"""Tips and probes reach what is in the same vessel, and nothing through its wall."""

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.handling import Handling
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.substances.filling import Filling, Solute
from liquid_experiments import world

BEAKER = glassware("beaker", "250 ml", "beaker")
DEEP = 0.012
PRESSED = 0.0002


@pytest.fixture(scope="module")
def handling() -> Handling:
    model, data = world(BEAKER)
    filling = Filling(100.0, dissolved=(Solute("acetic acid", 0.1),))
    liquid = Liquid(model, data, [BEAKER], [filling], 1000)
    liquid.fill({BEAKER: filling}, np.random.default_rng(0))
    liquid.take_account()
    return Handling(liquid)


def all_around(radius: float) -> list[np.ndarray]:
    angles = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    return [np.array([radius * np.cos(a), radius * np.sin(a), DEEP]) for a in angles]


@pytest.mark.parametrize("gap", [-PRESSED, 0.0, 0.001])
def test_a_tip_at_the_outside_of_a_wall_is_in_nothing(handling: Handling, gap: float) -> None:
    for point in all_around(BEAKER.profile.outer_radius(DEEP) + gap):
        assert handling.near(point) is None
        assert handling.solution_at(point) is None
        assert handling.temperature_at(point) is None
        assert handling.draw("beaker", 5, point) == 0


@pytest.mark.parametrize("gap", [-PRESSED, 0.0, 0.001])
def test_a_tip_at_the_inside_of_a_wall_is_in_the_liquid(handling: Handling, gap: float) -> None:
    for point in all_around(BEAKER.profile.inner_radius(DEEP) - gap):
        assert handling.near(point) is not None
        assert handling.solution_at(point) is not None
        assert handling.temperature_at(point) == pytest.approx(293.15)


@pytest.mark.parametrize("gap", [-PRESSED, 0.0, 0.001])
def test_a_tip_on_the_bottom_is_in_the_liquid_and_under_it_in_none(
    handling: Handling, gap: float
) -> None:
    bottom, beside = BEAKER.profile.bottom, 0.01
    assert handling.near(np.array([beside, 0.0, bottom + gap])) is not None
    assert handling.near(np.array([beside, 0.0, -gap])) is None
