"""Adversarial cases of `level2/neutralise`: what is in the beaker decides, not what was done."""

from typing import Any

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import swirl

TASK = "level2/neutralise"
GREEN = "yellow_beaker looks green"
NEUTRAL = "pH of yellow_beaker between 5.8 and 7"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def tip(env: LabEnv, ml: float, vessel: str, into: str | None = "yellow_beaker") -> dict[str, Any]:
    """Begin, put some of a vessel's liquid into another one, or away, mix it, and take a step."""
    env.reset(seed=0)
    simulation = env.workcell.simulation
    liquid = simulation.liquid
    assert liquid is not None
    flowing = np.flatnonzero(liquid.origins == liquid.names.index(vessel))
    flowing = flowing[: round(ml * 1e-6 / liquid.volume)]
    if into is None:
        liquid.take(flowing)
    else:
        middle = simulation.data.body(into).xpos
        grid = np.arange(len(flowing))
        places = np.column_stack([grid % 5 - 2, grid // 5 % 5 - 2, 10 + grid // 25])
        liquid.positions[flowing] = middle + 0.008 * places
        liquid.velocities[flowing] = 0.0
    simulation.account = liquid.take_account()
    swirl(simulation)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(
        NeedsLiquidError, match=r"level2/neutralise has solutions in base_beaker.*Choose liquid=on"
    ):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


def test_as_much_base_as_there_is_acid_turns_it_green(env: LabEnv) -> None:
    acid = env.workcell.task.contents
    (molar,) = (f.dissolved[0].molar for v, f in acid.items() if v.name == "yellow_beaker")
    info = tip(env, 0.96 * 100.0 * molar / 0.12, "base_beaker")
    assert info["facts"][GREEN]
    assert info["facts"][NEUTRAL]
    assert info["outcome"] != "overshot"
    assert 5.8 < info["solutions"]["yellow_beaker"]["ph"] < 7.0


@pytest.mark.parametrize("ml", [1.0, 40.0])
def test_too_little_base_leaves_it_yellow(env: LabEnv, ml: float) -> None:
    info = tip(env, ml, "base_beaker")
    assert not info["facts"][GREEN]
    assert not info["facts"][NEUTRAL]


def test_too_much_base_is_overshot(env: LabEnv) -> None:
    info = tip(env, 125.0, "base_beaker")
    assert info["outcome"] == "overshot"
    assert not info["facts"][GREEN]


def test_the_flask_beside_holds_no_base(env: LabEnv) -> None:
    info = tip(env, 40.0, "acid_flask")
    assert not info["facts"][GREEN]
    assert info["outcome"] == "contaminated"


def test_a_beaker_that_has_been_emptied_has_not_turned(env: LabEnv) -> None:
    info = tip(env, 100.0, "yellow_beaker", into=None)
    assert not info["facts"][GREEN]
    assert not info["facts"][NEUTRAL]
    assert info["solutions"]["yellow_beaker"]["ml"] < 1.0


def test_the_privileged_state_has_the_solution_of_every_vessel(env: LabEnv) -> None:
    env.reset(seed=0)
    names = environment_state_names(env.workcell.task)
    state = dict(zip(names, env.environment_state().tolist(), strict=True))
    world = env.workcell.world
    for vessel in env.workcell.task.contents:
        solution = world.solution(vessel)
        assert solution is not None
        assert state[f"{vessel.name}.acidity"] == pytest.approx(7.0 - solution.ph, abs=1e-5)
        seen = [state[f"{vessel.name}.{colour}"] for colour in ("red", "green", "blue")]
        assert seen == pytest.approx(solution.colour, abs=1e-5)
        assert state[f"{vessel.name}.warmth"] == pytest.approx(0.0, abs=0.01)
        molar = 1e-3 * sum(solution.concentrations.values())
        assert state[f"{vessel.name}.dissolved"] == pytest.approx(molar, rel=1e-5)
        assert state[f"{vessel.name}.mixed"] == pytest.approx(solution.mixed, abs=1e-5)
