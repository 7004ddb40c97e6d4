"""Kinetics: slow reactions take their time, as their rate laws say, and lose nothing."""

import numpy as np
import pytest

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.solutions import Solutions
from labutopia_lerobot.substances.filling import Filling
from solution_bench import (
    BASE,
    GIVER,
    TAKER,
    atoms,
    bench,
    bring,
    energy,
    liquid_of,
    mix,
    pour,
    world,
)


def test_a_slow_reaction_of_unknown_rate_does_not_happen_and_is_named_once() -> None:
    ester = Filling(50.0, dissolved=(Solute("methyl acetate", 0.1),))
    simulation = bench(ester, BASE)
    bring(simulation, GIVER.name, TAKER.name, 40.0)
    solutions = liquid_of(simulation).solutions
    assert solutions is not None
    equation = "CH3COOCH3 + OH^- -> CH3COO^- + CH3OH"
    assert solutions.unreacted == (f"too slow to happen here: {equation}",)
    here = world(simulation).solution(TAKER)
    assert here is not None
    assert here.concentrations["CH3COOCH3(aq)"] == pytest.approx(1e3 * 0.1 * 40 / 90, rel=0.02)


class WaterBath:
    """Two solutions, stirred together at a temperature.

    Args:
        one: The first.
        other: As much of the second.
        kelvin: Of the bath [K].
    """

    def __init__(self, one: Filling, other: Filling, kelvin: float) -> None:
        n = 40
        self.solutions = Solutions((one, other), ("vessel",), 1e-7)
        contents = self.solutions.contents([(one, other)[i % 2] for i in range(n)])
        zeros = np.zeros(n, int)
        self._kelvin, self._litres = kelvin, n * 1e-7 * 1e3
        self._what = Portion(zeros, zeros.copy(), np.full(n, kelvin), np.ones((n, 1)), contents)

    def wait(self, seconds: int) -> None:
        """Let time go on."""
        what = self._what
        n = len(what.contents)
        heights, inside, capacities = np.linspace(0.0, 0.01, n), np.zeros(n, int), np.full(n, 0.417)
        for _ in range(seconds):
            self.solutions.react(what, heights, heights, capacities, inside, np.array([0.05]), 1.0)
            what.temperatures[:] = self._kelvin  # the bath takes the heat of reaction

    def molar(self, key: str) -> float:
        """Return a concentration [mol/l]."""
        at = self.solutions.inventory.species.index(key)
        return float(self._what.contents[:, at].sum()) / self._litres

    @property
    def atoms(self) -> dict[str, float]:
        """How many there are, with those that have left as gas [mol]."""
        there = self._what.contents.sum(axis=0) + self.solutions.given_off[0]
        return atoms(self.solutions.inventory.species, there)


def assert_kept(before: dict[str, float], after: dict[str, float]) -> None:
    """Assert that nothing was made or lost."""
    assert after.keys() == before.keys()
    for name, amount in after.items():
        assert amount == pytest.approx(before[name], rel=1e-9, abs=1e-9 * 4e-6)


@pytest.mark.parametrize(("kelvin", "constant"), [(293.15, 0.080), (313.15, 0.272)])
def test_an_ester_is_saponified_as_fast_as_its_rate_law_says(
    kelvin: float, constant: float
) -> None:
    """Of equal concentrations c, 1 / c grows by k t (Atkins and de Paula, Physical Chemistry)."""
    bath = WaterBath(Filling(50.0, dissolved=(Solute("ethyl acetate", 0.1),)), BASE, kelvin)
    before = bath.atoms
    bath.wait(10)
    first = bath.molar("OH^-(aq)")
    bath.wait(60)
    assert 1.0 / bath.molar("OH^-(aq)") - 1.0 / first == pytest.approx(60.0 * constant, rel=0.03)
    bath.wait(600)
    assert 1.0 / bath.molar("OH^-(aq)") - 1.0 / first == pytest.approx(660.0 * constant, rel=0.03)
    assert bath.solutions.unreacted == ()
    assert_kept(before, bath.atoms)


@pytest.mark.parametrize(("kelvin", "constant"), [(298.15, 0.0465), (308.15, 0.0860)])
def test_peroxide_takes_its_time_to_make_iodine_in_acid(kelvin: float, constant: float) -> None:
    """As in an iodine clock; in 0.2 mol/l of acid both paths count: k1 + k2 [H^+]."""
    iodide = Filling(50.0, dissolved=(Solute("potassium iodide", 0.2),))
    peroxide = (Solute("hydrogen peroxide", 0.02), Solute("hydrochloric acid", 0.4))
    bath = WaterBath(iodide, Filling(50.0, dissolved=peroxide), kelvin)
    before = bath.atoms
    bath.wait(5)
    first = bath.molar("H2O2(aq)")
    assert first > 0.008
    bath.wait(20)
    rate = 0.098 * constant  # iodide is used up by 2 % in the mean
    assert bath.molar("H2O2(aq)") == pytest.approx(first * np.exp(-20.0 * rate), rel=0.03)
    iodine = sum(bath.molar(key) for key in ("I2(aq)", "I3^-(aq)"))
    assert iodine == pytest.approx(0.01 - bath.molar("H2O2(aq)"), rel=0.01)
    assert_kept(before, bath.atoms)


def test_iodide_takes_its_time_to_make_oxygen_of_peroxide_without_acid() -> None:
    iodide = Filling(50.0, dissolved=(Solute("potassium iodide", 0.2),))
    peroxide = Filling(50.0, dissolved=(Solute("hydrogen peroxide", 0.2),))
    bath = WaterBath(iodide, peroxide, 298.15)
    before = bath.atoms
    bath.wait(5)
    first = bath.molar("H2O2(aq)")
    bath.wait(300)
    left = bath.molar("H2O2(aq)")
    assert left == pytest.approx(first * np.exp(-300.0 * 2.0 * 0.0115 * 0.1), rel=0.03)
    assert bath.molar("I^-(aq)") == pytest.approx(0.1, rel=1e-3)
    gas = bath.solutions.inventory.amounts(bath.solutions.given_off[0])
    assert gas["O2(g)"] == pytest.approx(4e-3 * (0.1 - left) / 2.0, rel=0.01)
    assert_kept(before, bath.atoms)


def test_an_ester_takes_its_time_in_a_vessel_and_warms_it() -> None:
    ester, base = (
        Filling(50.0, dissolved=(Solute(of, 0.5),)) for of in ("ethyl acetate", "sodium hydroxide")
    )
    simulation = bench(ester, base)
    pour(simulation, 0.9, 60)
    warm, before = energy(simulation), world(simulation).solution(TAKER)
    mix(simulation, 60.0)
    after = world(simulation).solution(TAKER)
    assert before is not None
    assert after is not None
    assert before.ph > after.ph > 12.0
    assert after.temperature > before.temperature + 0.5
    assert energy(simulation) == pytest.approx(warm, abs=1e-9 * abs(warm))
