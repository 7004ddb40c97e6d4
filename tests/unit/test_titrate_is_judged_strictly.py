"""Adversarial cases of `level4/titrate`: the end point of the acid counts, however it looks."""

import math
from typing import Any

import pytest
from scipy.optimize import brentq

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import Titrate
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of

TASK = "level4/titrate"
BURETTE, BEAKER = "stand_burette", "beaker"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK, particles=1000)


def needed(env: LabEnv) -> float:
    """Return the equivalence volume of the episode [ml], by hand: 0.1 mol/l of base."""
    held = {vessel.name: filling for vessel, filling in env.workcell.task.contents.items()}
    return held[BEAKER].ml * held[BEAKER].dissolved[0].molar / 0.1


def after(env: LabEnv, more_ml: float, *, of_water: bool = False) -> dict[str, Any]:
    """Begin, bring the equivalence volume and some more into the beaker, and take a step."""
    env.reset(seed=0)
    simulation = env.workcell.simulation
    liquid = liquid_of(simulation)
    if of_water:
        assert liquid.solutions is not None
        water = liquid.solutions.inventory.filled((), liquid.volume)
        liquid.kept.portion.contents[:] = water
    bring(simulation, BURETTE, BEAKER, needed(env) + more_ml)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def reached(info: dict[str, Any]) -> list[bool]:
    """Return what is said of the pH, and of the volume, in the beaker."""
    (ph,) = (so for name, so in info["facts"].items() if name.startswith("pH of beaker between"))
    (ml,) = (
        so
        for name, so in info["facts"].items()
        if " ml of what was in" in name and "to" in name.split(" ml")[0]
    )
    return [ph, ml]


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


@pytest.mark.parametrize("more_ml", [-0.05, 0.0, 0.05])
def test_the_equivalence_volume_is_the_end_point(env: LabEnv, more_ml: float) -> None:
    info = after(env, more_ml)
    assert reached(info) == [True, True]
    assert info["outcome"] == "running"


def test_two_drops_less_are_not(env: LabEnv) -> None:
    assert reached(after(env, -0.2)) == [False, False]


def test_four_drops_more_are_too_many(env: LabEnv) -> None:
    info = after(env, 0.3)
    assert reached(info) == [False, False]
    assert info["outcome"] in {"overshot", "overrun"}


def test_water_is_no_base_however_much_of_it_runs(env: LabEnv) -> None:
    assert reached(after(env, 0.0, of_water=True)) == [False, True]


def test_an_acid_that_was_partly_spilled_is_neutral_too_soon(env: LabEnv) -> None:
    env.reset(seed=0)
    simulation = env.workcell.simulation
    bring(simulation, BEAKER, None, 20.0)
    bring(simulation, BURETTE, BEAKER, needed(env) * 25.0 / 45.0)
    *_, info = env.step(env.workcell.filter.applied.copy())
    assert reached(info)[1] is False


def computed_ph(acid_mmol: float, base_mmol: float, ml: float) -> float:
    """Return the pH of acetic acid and sodium hydroxide: the balance of charge, by bisection.

    pK 4.756, and 14.17 of water at 20 degrees C (CRC Handbook).
    """
    acid, base, k, kw = acid_mmol / ml, base_mmol / ml, 10**-4.756, 10**-14.17

    def excess(ph: float) -> float:
        h = 10.0**-ph
        return base + h - kw / h - acid * k / (k + h)

    ph: float = brentq(excess, 0.0, 14.0)
    return ph


@pytest.mark.slow
def test_the_curve_that_the_robot_plays_lies_within_a_tenth_of_the_computed_one() -> None:
    env = begun(TASK, particles=500)
    seed = next(seed for seed in range(100) if _holds(env, seed) == "acetic acid")
    env.reset(seed=seed)
    cell, world = env.workcell, env.workcell.world
    (skill,) = (one for one in cell.task.skills if isinstance(one, Titrate))
    (molar,) = (f.dissolved[0].molar for v, f in cell.task.contents.items() if v.name == BEAKER)
    portions = Titrate(
        skill.wing, skill.delivered, skill.meter, ph=12.0, first_ml=1.0, drop_ml=0.8, last_ml=0.9
    )
    expert: Expert = cell.expert([portions])
    expert.start()
    points: list[tuple[float, float]] = []
    label = ""
    while len(points) < 12 and not expert.failure:
        cell.simulation.step(cell.filter(expert.act(), cell.simulation.commands))
        if expert.label != label == "titrate/watch":
            account = world.liquid
            assert account is not None
            ml = 1e6 * account.from_in(BURETTE, BEAKER)
            points.append((ml, world.reading(skill.meter.name).shown))
        label = expert.label
    computed = [computed_ph(45.0 * molar, 0.1 * ml, 45.0 + ml) for ml, _ in points]
    assert len(points) == 12
    assert computed[0] < 4.5 < 10.0 < computed[-1]  # on both sides of the leap
    for (ml, shown), ph in zip(points, computed, strict=True):
        assert math.isclose(shown, ph, abs_tol=0.1), f"at {ml:.2f} ml"


def _holds(env: LabEnv, seed: int) -> str:
    """Return which acid an episode has."""
    env.reset(seed=seed)
    (held,) = (f for v, f in env.workcell.task.contents.items() if v.name == BEAKER)
    return held.dissolved[0].of
