"""Attacks on every registered task, without liquid, which is much faster, and with.

`make test` attacks a few, `make test-slow` all of them, with more seeds, and all that has liquid
once more with it.
"""

from collections.abc import Sequence
from typing import Any

import pytest

from attacks.plays import (
    FAILING,
    PASSING,
    Play,
    begun,
    drop,
    outcome,
    ram_the_bench,
    shake_while_holding,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.task import NeedsLiquidError

FEW = ("level1/open_drawer", "level1/pick", "level1/press")
"""A mechanism, a thing that is taken, a button: what the other tasks are made of."""
DRY = [pytest.param(task, marks=[] if task in FEW else [pytest.mark.slow]) for task in task_files()]
SEEDS = [pytest.param((0,), id="0"), pytest.param(range(1, 5), id="1-4", marks=pytest.mark.slow)]
WET = [
    pytest.param(task, marks=[] if task == "level1/pour" else [pytest.mark.slow])
    for task in task_files()
]


def few(plays: Sequence[Play]) -> list[Any]:
    """Return plays of which all but the first are left to `make test-slow`."""
    first, *others = plays
    return [first, *(pytest.param(play, marks=pytest.mark.slow) for play in others)]


def named(task: object) -> str:
    return str(task).replace("/", "-")


@pytest.fixture(params=DRY, scope="module", ids=named)
def env(request: pytest.FixtureRequest) -> LabEnv:
    try:
        return begun(request.param)
    except NeedsLiquidError:
        pytest.skip("it is judged by its liquid, and attacked with that")


@pytest.fixture(params=WET, scope="module", ids=named)
def wet(request: pytest.FixtureRequest) -> LabEnv:
    env = begun(request.param, "on")
    env.reset(seed=0)
    if not env.workcell.task.contents:
        pytest.skip("there is no liquid in this task")
    return env


def require_that_it_applies(play: Play, env: LabEnv) -> None:
    """Skip what is no failure: nothing can be dropped where nothing is held."""
    env.reset(seed=0)
    task = env.workcell.task
    if play is shake_while_holding and not any(
        fact.name.endswith(" gripped") for fact in task.goal
    ):
        pytest.skip("nothing is in the hand in the end")
    if play is ram_the_bench and task.drives:
        pytest.skip("it starts away from every bench: test_driving rams them")
    if play is drop and not any(name.endswith((" gripped", " grasped")) for name in task.facts):
        pytest.skip("nothing is ever held")


def judged(env: LabEnv, play: Play, seed: int) -> str:
    """Return the outcome of a play that fails the task."""
    require_that_it_applies(play, env)
    return str(outcome(env, play, seed)["outcome"])


def check_failure(env: LabEnv, play: Play, seed: int) -> None:
    """Check that a play is not won, and that a ram into the bench is reported as what it is."""
    reported = judged(env, play, seed)
    assert reported != "success", seed
    if play is ram_the_bench:
        assert reported not in {"running", "timeout", "interrupted"}, seed


@pytest.mark.parametrize("play", FAILING, ids=lambda play: play.__name__)
@pytest.mark.parametrize("seeds", SEEDS)
def test_a_person_would_fail(env: LabEnv, play: Play, seeds: Sequence[int]):
    for seed in seeds:
        check_failure(env, play, seed)


@pytest.mark.parametrize("play", PASSING, ids=lambda play: play.__name__)
@pytest.mark.parametrize("seeds", SEEDS)
def test_a_person_would_pass(env: LabEnv, play: Play, seeds: Sequence[int]):
    for seed in seeds:
        assert outcome(env, play, seed)["outcome"] == "success", seed


@pytest.mark.parametrize("play", few(FAILING), ids=lambda play: play.__name__)
@pytest.mark.parametrize("seeds", SEEDS)
def test_a_person_would_fail_with_liquid(wet: LabEnv, play: Play, seeds: Sequence[int]):
    for seed in seeds:
        check_failure(wet, play, seed)


@pytest.mark.parametrize("play", few(PASSING), ids=lambda play: play.__name__)
@pytest.mark.parametrize("seeds", SEEDS)
def test_a_person_would_pass_with_liquid(wet: LabEnv, play: Play, seeds: Sequence[int]):
    for seed in seeds:
        assert outcome(wet, play, seed)["outcome"] == "success", seed
