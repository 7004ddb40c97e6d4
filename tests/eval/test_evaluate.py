from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.jobs import EvaluationJob, make_jobs
from labutopia_lerobot.evaluation.policies import (
    REFERENCE_POLICIES,
    Action,
    PolicyMaker,
    RandomPolicy,
    StillPolicy,
)
from labutopia_lerobot.evaluation.rollout import Episode, choose, evaluate, in_order, play
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import CONTROL_HZ

SEEDS = range(100_000, 100_003)


def played(workers: int) -> list[Episode]:
    """Play the three reference policies; the slowest comes first, to mix up the order."""
    jobs = [
        job
        for name in ("still", "expert", "random")
        for job in make_jobs(EvaluationConfig(policy=PolicyConfig(name), task="level1/pick"))
    ]
    return in_order(list(evaluate(jobs, SEEDS, workers)), jobs)


@pytest.fixture(scope="module")
def episodes() -> list[Episode]:
    return played(workers=2)


def test_the_expert_wins_and_doing_nothing_or_anything_does_not(episodes: list[Episode]) -> None:
    wins = Counter(episode.row.policy for episode in episodes if episode.row.success)
    assert wins == {"expert": 3}


@pytest.mark.slow
def test_rows_do_not_depend_on_the_workers(episodes: list[Episode]) -> None:
    alone = played(workers=1)
    assert [episode.row for episode in alone] == [episode.row for episode in episodes]
    for one, other in zip(alone, episodes, strict=True):
        np.testing.assert_array_equal(one.actions, other.actions)


def test_a_row_has_the_condition_that_was_to_be_played(episodes: list[Episode]) -> None:
    assert all(episode.row.condition == episode.job.condition for episode in episodes)


def test_rows_are_ordered_by_pairing_and_seed(episodes: list[Episode]) -> None:
    assert [(episode.row.policy, episode.row.seed) for episode in episodes] == [
        (policy, seed) for policy in ("still", "expert", "random") for seed in SEEDS
    ]


def test_the_first_successes_and_failures_are_filmed(episodes: list[Episode]) -> None:
    assert [path.name for _, path in choose(episodes, 1, Path())] == [
        "level1-pick_id_seed100000_timeout.mp4",
        "level1-pick_id_seed100000_success.mp4",
        f"level1-pick_id_seed100000_{episodes[-3].row.outcome}.mp4",
    ]


class BrokenPolicy:
    def start(self, env: LabEnv, seed: int) -> None:
        pass

    def act(self, observation: Observation) -> Action:
        raise ZeroDivisionError("a bug")


def test_a_bug_in_a_policy_is_no_failed_episode() -> None:
    maker: PolicyMaker = BrokenPolicy
    job = EvaluationJob(Setting("level1/pick", obs="state"), "broken", maker)
    with pytest.raises(ZeroDivisionError, match="a bug"):
        play(job, 0)


def test_random_actions_reach_the_whole_box_within_the_limits() -> None:
    env = LabEnv(Setting("level1/pick", obs="state"))
    observation, _ = env.reset(seed=0)
    policy = RandomPolicy()
    policy.start(env, seed=0)
    actions = np.array([policy.act(observation) for _ in range(3000)], dtype=np.float64)
    low, high, speed = (np.array(limit) for limit in (PANDA.lower, PANDA.upper, PANDA.speed))
    assert (np.abs(np.diff(actions, axis=0)) <= speed / CONTROL_HZ + 1e-6).all()
    assert ((actions >= low - 1e-6) & (actions <= high + 1e-6)).all()
    assert (np.ptp(actions, axis=0) > 0.8 * (high - low)).all()


MOODY_TASK = """
from dataclasses import replace
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.tasks.level1.pick import pick

class Sulk:
    def phases(self, world):
        if world.frame("flask_rim").position_w[1] > {limit}:
            never = lambda world, target, elapsed: False
            yield Phase("sulk", lambda w: w.gripper, 0.08, never, timeout_s=0.1)
        yield Phase("nod", lambda w: w.gripper, 0.08, lambda world, target, elapsed: True)

def moody():
    (step,) = pick().steps
    return replace(pick(), {where})
"""


@pytest.fixture
def moody(tmp_path: Path) -> Callable[[str, float], EvaluationJob]:
    """Make a job of the expert and a task in which it sulks where the flask is to the left."""

    def make(where: str, limit: float) -> EvaluationJob:
        (tmp_path / "level1").mkdir()
        text = MOODY_TASK.format(where=where, limit=limit)
        (tmp_path / "level1" / "moody.py").write_text(text)
        setting = Setting("level1/moody", obs="state", tasks_dir=str(tmp_path))
        return EvaluationJob(setting, "expert", REFERENCE_POLICIES["expert"])

    return make


def test_a_row_says_which_phase_the_expert_could_not_finish(
    moody: Callable[[str, float], EvaluationJob],
) -> None:
    job = moody("steps=(replace(step, skills=(Sulk(),)),), time_limit_s=1.0", -1.0)
    row = play(job, 0).row
    assert row.expert_failure == "sulk/sulk not done after 0.1 s"
    assert (row.outcome, row.cause) == ("timeout", "never reached")
    assert play(EvaluationJob(job.setting, "still", StillPolicy), 0).row.expert_failure is None


def test_a_row_counts_the_starts_that_were_drawn_anew(
    moody: Callable[[str, float], EvaluationJob],
) -> None:
    job = moody("setup=(Sulk(),), time_limit_s=0.5", 0.05)
    env = LabEnv(job.setting)
    failures = {seed: env.reset(seed=seed)[1]["setup_failures"] for seed in range(12)}
    assert 0 in failures.values()
    hard = max(failures, key=lambda seed: failures[seed])
    assert failures[hard] > 0
    assert play(job, hard).row.setup_failures == failures[hard]
