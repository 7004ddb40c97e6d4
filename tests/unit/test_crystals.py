"""Crystals on the bottom: they dissolve as fast as diffusion lets them, faster when stirred."""

import math

import numpy as np
import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Inventory, Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.dissolving import Dissolving
from labutopia_lerobot.liquids.settling import let_sink, sinking_speeds
from labutopia_lerobot.predicates import clouded, dissolved
from labutopia_lerobot.substances.filling import Filling, ImpossibleFillingError
from labutopia_lerobot.substances.possible_solutions import require_possible_solutions
from solution_bench import TAKER, bench, energy, liquid_of, mix, world

SALT = Crystals("sodium chloride", 1.0)
WATER = Filling(60.0)


def gone_after(speed: float) -> float:
    """Return how long a little salt takes to dissolve in much water [s]."""
    inventory = Inventory.of([()], [SALT.species])
    dissolving = Dissolving([Crystals("sodium chloride", 1e-4)], inventory)
    own = inventory.filled((), 1e-4)[None].copy()
    dissolving.strew(own, np.zeros(1), 1.0, [Crystals("sodium chloride", 1e-4)])
    for step in range(10_000):
        if not own[0, dissolving.columns].any():
            return 0.1 * step
        dissolving.dissolve(own, own.sum(axis=0), 1e-4, 293.15, speed, 0.1)
    return math.inf


def test_a_grain_at_rest_is_gone_when_its_sphere_has_shrunk_away() -> None:
    """d^2 = d0^2 - 8 D c_s t / rho, the law of a sphere in still water (Sherwood number 2)."""
    expected = 2170.0 * 0.5e-3**2 / (8 * 1.5e-9 * 360.0)
    assert gone_after(0.0) == pytest.approx(expected, rel=0.05)


def test_stirred_it_is_gone_several_times_sooner() -> None:
    """At Re = 11 and Sc = 593 the Sherwood number is 18.9 at first (Ranz and Marshall)."""
    assert gone_after(0.0) / gone_after(0.026) == pytest.approx(7.6, rel=0.15)


def test_near_saturation_they_dissolve_as_much_slower_as_the_solution_takes_less() -> None:
    """Noyes and Whitney: the rate goes with what is lacking to saturation."""
    inventory = Inventory.of([(Solute("sodium chloride", 1.0),)], [SALT.species])
    dissolving = Dissolving([Crystals("sodium chloride", 1e-4)], inventory)

    def gone(molar: float) -> float:
        own = inventory.filled((Solute("sodium chloride", molar),), 1e-4)[None].copy()
        dissolving.strew(own, np.zeros(1), 1.0, [Crystals("sodium chloride", 1e-4)])
        before = own[0, dissolving.columns].sum()
        dissolving.dissolve(own, own.sum(axis=0), 1e-4, 293.15, 0.0, 0.1)
        return float(before - own[0, dissolving.columns].sum())

    saturated = 6.1  # mol/l, 357 g/l (CRC Handbook)
    assert gone(5.0) / gone(0.1) == pytest.approx((saturated - 5.0) / (saturated - 0.1), rel=0.1)


@pytest.mark.parametrize(
    "salt", ["magnesium sulfate", "zinc sulfate", "sodium thiosulfate", "iron(III) sulfate"]
)
def test_salts_that_bind_much_water_dissolve_too(salt: str) -> None:
    crystals = [Crystals(salt, 1.0)]
    inventory = Inventory.of([()], [crystals[0].species])
    dissolving = Dissolving(crystals, inventory)
    own = inventory.filled((), 1e-4)[None].copy()
    dissolving.strew(own, np.zeros(1), 1.0, crystals)
    reasons = {
        dissolving.dissolve(own, own.sum(axis=0), 1e-4, 293.15, 0.05, 1.0)[1] for _ in range(300)
    }
    assert not own[0, dissolving.columns].any()
    assert reasons == {""}


def test_crystals_lie_on_the_bottom_and_are_neither_clear_nor_dissolved() -> None:
    simulation = bench(WATER, Filling(60.0, crystals=(SALT,)))
    liquid, view = liquid_of(simulation), world(simulation)
    solution = view.solution(TAKER)
    assert solution is not None
    assert 0.98 * SALT.mol < solution.solids["NaCl(s)"] <= SALT.mol
    assert clouded(TAKER).holds(view)
    assert not dissolved(TAKER).holds(view)
    held = np.flatnonzero(liquid.accounted == liquid.names.index(TAKER.name))
    heights = liquid.positions[held, 2] - liquid.positions[held, 2].min()
    assert liquid.solutions is not None
    salt = liquid.what.contents[held, liquid.solutions.inventory.species.index("NaCl(s)")]
    assert salt[heights < 0.012].sum() > 0.95 * salt.sum()


def test_what_dissolves_keeps_amounts_and_energy_and_cools_the_water() -> None:
    simulation = bench(WATER, Filling(60.0, crystals=(SALT,)))
    liquid, view = liquid_of(simulation), world(simulation)
    warm = energy(simulation)
    liquid.stirring[:] = 0.05
    mix(simulation, 120.0)
    assert energy(simulation) == pytest.approx(warm, abs=1e-9 * abs(warm))
    solution = view.solution(TAKER)
    assert solution is not None
    assert dissolved(TAKER).holds(view)
    assert solution.concentrations["Na^+(aq)"] * solution.volume == pytest.approx(
        SALT.mol, rel=1e-9
    )
    # 3.9 kJ/mol (CRC Handbook, "Enthalpy of solution"): 17.1 mmol in 60 ml.
    assert 293.15 - solution.temperature == pytest.approx(0.26, abs=0.04)


def test_more_than_dissolves_stays_on_the_bottom() -> None:
    """Of sodium chloride 360 g dissolve in a litre, hardly less in the cold (CRC Handbook)."""
    much = Crystals("sodium chloride", 30.0)
    simulation = bench(WATER, Filling(60.0, crystals=(much,)))
    liquid, view = liquid_of(simulation), world(simulation)
    liquid.stirring[:] = 0.2
    mix(simulation, 900.0)
    solution = view.solution(TAKER)
    assert solution is not None
    assert solution.solids["NaCl(s)"] > 0.1 * much.mol
    saturated = 1e-3 * solution.concentrations["Na^+(aq)"]
    assert saturated == pytest.approx(360.0 / 58.44, rel=0.15)


def test_stirring_carries_a_precipitate_but_no_crystals() -> None:
    speeds = sinking_speeds(("BaSO4(s)", "NaCl(s)"), {"NaCl(s)": 0.5e-3})
    assert speeds[1] == pytest.approx(0.064, rel=0.1)  # Schiller and Naumann, by hand: Re = 36
    heights = np.repeat(np.arange(6.0), 5) * 0.005
    contents = np.zeros((30, 2))
    contents[:5] = 1e-6
    for _ in range(60):
        let_sink(contents, heights, speeds, 0.005, 0.05, 1.0 / 30)
    assert contents[5:, 0].sum() > 0.1 * contents[:, 0].sum()
    assert contents[5:, 1].sum() == 0.0


@pytest.mark.parametrize(
    ("crystals", "reason"),
    [
        (Crystals("sodium carbonate", 1.0), "what crystals of sodium carbonate become in water"),
        (Crystals("sodium chloride", 0.0), "grams above 0"),
        (Crystals("sodium chloride", math.inf), "grams above 0"),
        (Crystals("sodium chloride", 1.0, grain_mm=50.0), "0.01 to 5 mm"),
    ],
)
def test_crystals_that_cannot_be_are_refused(crystals: Crystals, reason: str) -> None:
    beaker = glassware("beaker", "150 ml")
    with pytest.raises(ImpossibleFillingError, match=reason):
        require_possible_solutions("my_task", {beaker: Filling(60.0, crystals=(crystals,))})


def test_grains_of_two_sizes_are_refused() -> None:
    held = {
        glassware("beaker", "150 ml", name): Filling(60.0, crystals=(Crystals("KCl", 1.0, mm),))
        for name, mm in (("first", 0.5), ("second", 1.0))
    }
    with pytest.raises(ImpossibleFillingError, match=r"my_task, second: crystals of KCl of two"):
        require_possible_solutions("my_task", held)
