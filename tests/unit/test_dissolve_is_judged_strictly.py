"""Adversarial cases of `level2/dissolve`: it is clear because it has been stirred."""

from typing import Any

import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of

TASK = "level2/dissolve"
CLEAR = "all in beaker dissolved"


def after(seconds: float, speed: float, split: str = "id", seed: int = 0) -> dict[str, Any]:
    """Return what is so after some time in which the water moves on average by a speed [m/s]."""
    env = begun(TASK, split=split)
    env.reset(seed=seed)
    simulation = env.workcell.simulation
    handling, liquid = simulation.apparatus.liquid, liquid_of(simulation)
    assert handling is not None
    liquid.stirring[:] = speed
    for _ in range(round(10 * seconds)):
        handling.react(0.1)
    return step(env)


def step(env: LabEnv) -> dict[str, Any]:
    """Take a step in which nothing is commanded."""
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in beaker.*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=pytest.mark.slow) for n in (1, 2))])
@pytest.mark.parametrize("split", ["id", "ood"])
def test_waiting_until_the_time_is_up_leaves_crystals(split: str, seed: int) -> None:
    limit = begun(TASK).workcell.task.time_limit_s
    assert not after(limit, 0.005, split, seed)["facts"][CLEAR]


def test_stirring_for_forty_seconds_leaves_none() -> None:
    info = after(40.0, 0.02)
    assert info["facts"][CLEAR]
    assert info["solutions"]["beaker"]["mol_solid"] == 0.0


def test_a_beaker_that_has_been_emptied_is_not_clear() -> None:
    env = begun(TASK)
    bring(env.workcell.simulation, "beaker", None, 60.0)
    assert not step(env)["facts"][CLEAR]
