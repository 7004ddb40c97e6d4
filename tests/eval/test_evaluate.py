from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.evaluate import evaluate, in_order, make_pairings
from labutopia_lerobot.evaluation.films import choose
from labutopia_lerobot.evaluation.policies import Action, PolicyMaker, RandomPolicy
from labutopia_lerobot.evaluation.rollout import Episode, Pairing, play
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import CONTROL_HZ

SEEDS = range(100_000, 100_003)


def played(workers: int) -> list[Episode]:
    """Play the three reference policies; the slowest comes first, to mix up the order."""
    pairings = [
        pairing
        for name in ("still", "expert", "random")
        for pairing in make_pairings(
            EvaluationConfig(policy=PolicyConfig(name), task="level1/pick")
        )
    ]
    return in_order(list(evaluate(pairings, SEEDS, workers)), pairings)


@pytest.fixture(scope="module")
def episodes() -> list[Episode]:
    return played(workers=2)


def test_the_expert_wins_and_doing_nothing_or_anything_does_not(episodes: list[Episode]) -> None:
    wins = Counter(episode.row.policy for episode in episodes if episode.row.success)
    assert wins == {"expert": 3}


def test_rows_do_not_depend_on_the_workers(episodes: list[Episode]) -> None:
    alone = played(workers=1)
    assert [episode.row for episode in alone] == [episode.row for episode in episodes]
    for one, other in zip(alone, episodes, strict=True):
        np.testing.assert_array_equal(one.actions, other.actions)


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
    pairing = Pairing(Setting("level1/pick", obs="state"), "broken", maker)
    with pytest.raises(ZeroDivisionError, match="a bug"):
        play(pairing, 0)


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
