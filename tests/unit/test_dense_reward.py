"""`reward=dense`: it grows with the episode, adds up to one for a success, and cannot be farmed."""

from dataclasses import replace

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.sim.dense_reward import advance

PICK = Setting("level1/pick", obs="state", liquid="off", reward="dense")


def rewards_of_the_expert(setting):
    """Return the start of an episode, the reward of each of its steps, and how it ended."""
    env = LabEnv(setting)
    env.reset(seed=0)
    began = advance(env.workcell.progress, env.workcell.world)
    expert, rewards, over = env.expert(), [], False
    expert.start()
    while not over:
        _, reward, terminated, truncated, info = env.step(expert.act())
        rewards.append(reward)
        over = terminated or truncated
    return began, np.array(rewards), info


@pytest.mark.parametrize(
    "task", ["level1/pick", "level1/open_drawer", "level1/press", "level2/heat_beaker"]
)
def test_the_rewards_of_a_success_add_up_to_one_and_come_all_along(task):
    began, rewards, info = rewards_of_the_expert(replace(PICK, task=task))
    assert info["is_success"]
    assert 0.0 <= began < 0.3
    assert began + rewards.sum() == pytest.approx(1.0)
    before_goal = rewards[: np.flatnonzero(rewards)[-1]]
    assert (before_goal > 1e-4).sum() > 30  # a second of steps that are rewarded: not sparse


def test_the_nearer_hand_has_come_further_and_going_to_and_fro_earns_nothing():
    env = LabEnv(PICK)
    env.reset(seed=0)
    cell = env.workcell
    expert = env.expert()
    expert.start()
    total, heights = 0.0, []
    for _ in range(40):
        total += env.step(expert.act())[1]
        heights.append(total)
    assert heights[-1] > heights[0]
    joints = cell.simulation.measured.astype(np.float32)
    here = advance(cell.progress, cell.world)
    gained = 0.0
    for swing in (*np.linspace(0, 0.2, 15), *np.linspace(0.2, 0, 15), *[0.0] * 30):
        action = joints.copy()
        action[0] += swing
        gained += env.step(action)[1]
    assert abs(gained - (advance(cell.progress, cell.world) - here)) < 1e-9
    assert gained < 0.02


def test_a_failure_never_comes_to_one_and_sparse_is_the_default():
    env = LabEnv(replace(PICK, reward="sparse"))
    assert Setting("level1/pick").reward == "sparse"
    env.reset(seed=0)
    assert env.step(env.workcell.simulation.command.astype(np.float32))[1] == 0.0
    dense = LabEnv(PICK)
    dense.reset(seed=0)
    total, over = 0.0, False
    while not over:
        _, reward, terminated, truncated, _ = dense.step(dense.action_space.high)
        total += reward
        over = terminated or truncated
    assert total < 0.5
    assert advance(dense.workcell.progress, dense.workcell.world) < 0.5


def test_another_reward_is_refused_with_the_choices():
    with pytest.raises(UnknownOptionError, match="Choose from: sparse, dense"):
        replace(PICK, reward="shaped")
