"""Adversarial cases of `level3/precipitate`: what is named falls out, all of it."""

from typing import Any

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring

TASK = "level3/precipitate"
TARGET, SMALL = "large_beaker", ("tall_beaker", "low_beaker")


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def right_of(env: LabEnv) -> str:
    """Return the small beaker that is asked for."""
    return env.workcell.task.steps[0].substeps[0].when[0].name.removesuffix(" gripped")


def wrong_of(env: LabEnv) -> str:
    """Return the other one."""
    return next(name for name in SMALL if name != right_of(env))


def after(env: LabEnv, origin: str, into: str, ml: float) -> dict[str, Any]:
    """Put some of what a vessel holds into another and mix it, and take a step."""
    bring(env.workcell.simulation, origin, into, ml)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def formed(info: dict[str, Any]) -> bool:
    """Return whether enough of what is named has fallen out."""
    (so,) = (so for name, so in info["facts"].items() if " mmol of " in name)
    return bool(so)


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


@pytest.mark.slow
@pytest.mark.parametrize("split", ["id", "ood"])
def test_in_every_draw_the_right_one_makes_it_and_the_other_does_not(split: str) -> None:
    env = begun(TASK, split=split)
    drawn = set()
    for seed in range(8):
        env.reset(seed=seed)
        drawn.add(env.workcell.task.instruction.split("Make ")[1].split(" of the ")[0])
        right = right_of(env)
        assert formed(after(env, right, TARGET, 0.8 * 80.0))
        env.reset(seed=seed)
        assert not formed(after(env, wrong_of(env), TARGET, 80.0))
    assert len(drawn) == (3 if split == "id" else 2)


@pytest.mark.slow
def test_the_wrong_one_ends_the_episode_and_the_right_one_does_not(env: LabEnv) -> None:
    for poured, outcome in ((right_of, "running"), (wrong_of, "contaminated")):
        env.reset(seed=0, options={"after": "pick"})
        assert after(env, poured(env), TARGET, 60.0)["outcome"] == outcome


def test_half_of_what_it_takes_is_not_enough(env: LabEnv) -> None:
    env.reset(seed=0)
    assert not formed(after(env, right_of(env), TARGET, 20.0))


def test_it_must_form_in_the_large_beaker(env: LabEnv) -> None:
    env.reset(seed=0)
    info = after(env, TARGET, right_of(env), 30.0)
    assert not formed(info)
    assert info["outcome"] == "contaminated"


def test_what_it_is_made_of_is_no_precipitate(env: LabEnv) -> None:
    env.reset(seed=0)
    *_, info = env.step(env.workcell.filter.applied.copy())
    assert not formed(info)
    assert info["solutions"][TARGET]["mol_solid"] == 0.0


@pytest.mark.parametrize("seed", range(4))
def test_the_small_ones_look_alike(env: LabEnv, seed: int) -> None:
    env.reset(seed=seed)
    looks = [env.workcell.world.solution(v) for v in env.workcell.task.start if v.name in SMALL]
    colours = np.array([one.colour for one in looks if one is not None])
    assert np.ptp(colours, axis=0).max() < 0.02
