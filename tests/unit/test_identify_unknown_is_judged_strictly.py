"""Adversarial cases of `level3/identify_unknown`: the beaker that clouds, found by a test."""

from typing import Any

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of

TASK = "level3/identify_unknown"
REAGENT, PLATE = "reagent_beaker", "target_plate"
ROW = ("left_beaker", "middle_beaker", "right_beaker")


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def right_of(env: LabEnv) -> str:
    """Return the beaker that is asked for."""
    return env.workcell.task.steps[-1].substeps[0].when[1].name.removesuffix(" gripped")


def reagent_in(env: LabEnv, *vessels: str, ml: float = 3.0) -> dict[str, Any]:
    """Begin, put some reagent into vessels and mix it, and take a step."""
    env.reset(seed=0)
    for vessel in vessels:
        bring(env.workcell.simulation, REAGENT, vessel, ml)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def identified(info: dict[str, Any]) -> bool:
    """Return whether the test has identified which one it is."""
    (so,) = (so for name, so in info["facts"].items() if " clouded or " in name)
    return bool(so)


def put_on_the_plate(env: LabEnv, name: str) -> dict[str, Any]:
    """Set a vessel on the plate with all that it holds, and wait for a second."""
    simulation = env.workcell.simulation
    data, liquid = simulation.data, liquid_of(simulation)
    to = data.body(PLATE).xpos - data.body(name).xpos
    to[2] += 0.005
    held = liquid.accounted == liquid.names.index(name)
    data.joint(f"{name}_free").qpos[:3] += to
    liquid.positions[held] += to
    simulation.restore(simulation.state())  # the walls are where they are, not on their way
    for _ in range(30):
        *_, info = env.step(env.workcell.filter.applied.copy())
        if info["outcome"] != "running":
            break
    return info


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


def test_only_the_one_that_is_asked_for_clouds_however_much_reagent_there_is(env: LabEnv) -> None:
    for vessel in ROW:
        info = reagent_in(env, vessel, ml=45.0)
        solid = info["solutions"][vessel]["mol_solid"]
        assert (solid > 1e-5) == identified(info) == (vessel == right_of(env))


@pytest.mark.slow
@pytest.mark.parametrize("split", ["id", "ood"])
def test_in_every_draw_exactly_one_clouds(split: str) -> None:
    env = begun(TASK, split=split)
    for seed in range(3):
        env.reset(seed=seed)
        for vessel in ROW:
            bring(env.workcell.simulation, REAGENT, vessel, 3.0)
        *_, info = env.step(env.workcell.filter.applied.copy())
        cloudy = [v for v in ROW if info["solutions"][v]["mol_solid"] > 1e-6]
        assert cloudy == [right_of(env)]


def test_who_has_seen_both_others_stay_clear_knows_it_too(env: LabEnv) -> None:
    wrong = [vessel for vessel in ROW if vessel != right_of(env)]
    assert identified(reagent_in(env, *wrong))
    assert not identified(reagent_in(env, wrong[0]))
    assert not identified(reagent_in(env))


def test_to_guess_right_without_a_test_is_no_success(env: LabEnv) -> None:
    reagent_in(env)
    info = put_on_the_plate(env, right_of(env))
    assert info["facts"][f"{right_of(env)} standing on {PLATE}"]
    assert not identified(info)
    assert not info["is_success"]


def test_the_wrong_one_on_the_plate_is_misjudged(env: LabEnv) -> None:
    reagent_in(env)
    wrong = next(vessel for vessel in ROW if vessel != right_of(env))
    assert put_on_the_plate(env, wrong)["outcome"] == "misjudged"


def test_the_vessels_look_alike_before(env: LabEnv) -> None:
    env.reset(seed=0)
    looks = [env.workcell.world.solution(v) for v in env.workcell.task.start if v.name in ROW]
    colours = np.array([one.colour for one in looks if one is not None])
    assert np.ptp(colours, axis=0).max() < 0.02
