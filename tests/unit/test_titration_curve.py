"""A titration curve of a weak acid lies within 0.1 of the computed one, at the pH meter."""

import math
from collections.abc import Iterator

import pytest
from scipy.optimize import brentq

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Titrate
from labutopia_lerobot.skills.expert import Expert
from solution_bench import bring

TASK = "level4/titrate"
BURETTE, BEAKER = "stand_burette", "beaker"
_SETTLED_STEPS = 300
"""Control steps after which the electrode shows what is there: seven of its time constants."""


def of_a_weak_acid(particles: int) -> LabEnv:
    """Return an environment in which an episode with acetic acid has begun."""
    env = begun(TASK, particles=particles)
    for seed in range(100):
        env.reset(seed=seed)
        if held(env)[0] == "acetic acid":
            return env
    raise AssertionError("no episode has acetic acid")


def held(env: LabEnv) -> tuple[str, float, float]:
    """Return which acid the beaker holds, its concentration [mol/l] and its volume [ml]."""
    (filling,) = (f for v, f in env.workcell.task.contents.items() if v.name == BEAKER)
    return filling.dissolved[0].of, filling.dissolved[0].molar, filling.ml


def run_in(env: LabEnv) -> float:
    """Return how much has run into the beaker [ml], to the particle."""
    account = env.workcell.simulation.account
    assert account is not None
    return 1e6 * account.from_in(BURETTE, BEAKER)


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


def require_near(points: list[tuple[float, float]], env: LabEnv) -> None:
    """Make sure that pairs of volume [ml] and reading lie on the curve, on both sides of its leap.

    Args:
        points: As they were measured.
        env: Where.
    """
    _, molar, sample = held(env)
    computed = [computed_ph(sample * molar, 0.1 * ml, sample + ml) for ml, _ in points]
    assert computed[0] < 4.5 < 10.0 < computed[-1]
    for (ml, shown), ph in zip(points, computed, strict=True):
        assert math.isclose(shown, ph, abs_tol=0.1), f"at {ml:.2f} ml"


def portions(env: LabEnv) -> Iterator[float]:
    """Yield how much is to be in the beaker [ml]: along the buffer, and through the leap."""
    _, molar, sample = held(env)
    needed = sample * molar / 0.1
    yield from (share * needed for share in (0.1, 0.3, 0.5, 0.7, 0.9))
    yield from (needed + more for more in (-0.3, -0.1, 0.1, 0.3, 1.0, 2.0))


def test_its_curve_lies_within_a_tenth_of_the_computed_one() -> None:
    env = of_a_weak_acid(particles=1000)
    simulation = env.workcell.simulation
    points = []
    for ml in portions(env):
        bring(simulation, BURETTE, BEAKER, ml - run_in(env))
        for _ in range(_SETTLED_STEPS):
            simulation.apparatus.step()
        points.append((run_in(env), env.workcell.world.reading("meter_ph").shown))
    require_near(points, env)


@pytest.mark.slow
def test_the_curve_that_the_robot_plays_lies_within_a_tenth_of_the_computed_one() -> None:
    env = of_a_weak_acid(particles=500)
    cell, world = env.workcell, env.workcell.world
    (skill,) = (one for one in cell.task.skills if isinstance(one, Titrate))
    # Half a millilitre at a time; it never stops by itself, so that all its readings have settled.
    _, molar, sample = held(env)
    slow = Titrate(
        skill.wing,
        skill.delivered,
        skill.meter,
        ph=14.0,
        first_ml=0.3 * sample * molar / 0.1,
        drop_ml=0.5,
    )
    expert: Expert = cell.expert([slow])
    expert.start()
    points: list[tuple[float, float]] = []
    label = ""
    for _ in range(cell.task.max_steps):
        cell.simulation.step(cell.filter(expert.act(), cell.simulation.commands))
        if expert.label != label == "titrate/watch":
            points.append((run_in(env), world.reading(skill.meter.name).shown))
        label = expert.label
        if expert.failure or (points and points[-1][1] > 11.0):
            break
    assert not expert.failure
    assert len(points) >= 8
    require_near(points, env)
