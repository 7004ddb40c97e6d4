"""Attacks on every registered task, without liquid: the judge is the same, and much faster.

Levels 3 and 4 are made of the steps of levels 1 and 2: `make test-slow` plays them, and more seeds.
"""

import pytest

from attacks.plays import FAILING, PASSING, Play, drop, outcome, shake_while_holding
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import Setting

TASKS = [
    pytest.param(task, marks=[pytest.mark.slow] if task.startswith(("level3", "level4")) else [])
    for task in task_files()
]
SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 5))]


@pytest.fixture(params=TASKS, scope="module", ids=lambda task: task.replace("/", "-"))
def env(request: pytest.FixtureRequest) -> LabEnv:
    return LabEnv(Setting(request.param, obs="state", liquid="off"))


def applies(play: Play, env: LabEnv) -> bool:
    """Tell whether a play fails a task: nothing can be dropped where nothing is held."""
    task = env.workcell.task
    if play is shake_while_holding:
        return any(fact.name.endswith(" gripped") for fact in task.goal)
    held = any(name.endswith((" gripped", " grasped")) for name in task.facts)
    return held if play is drop else True


@pytest.mark.parametrize("play", FAILING, ids=lambda play: play.__name__)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_fail(env: LabEnv, play: Play, seed: int):
    env.reset(seed=seed)
    if applies(play, env):
        assert outcome(env, play, seed)["outcome"] != "success"


@pytest.mark.parametrize("seed", SEEDS)
def test_a_ram_into_the_bench_is_told_as_what_it_is(env: LabEnv, seed: int):
    told = outcome(env, FAILING[0], seed)["outcome"]
    assert told not in {"success", "timeout", "interrupted"}


@pytest.mark.parametrize("play", PASSING, ids=lambda play: play.__name__)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(env: LabEnv, play: Play, seed: int):
    assert outcome(env, play, seed)["outcome"] == "success"
