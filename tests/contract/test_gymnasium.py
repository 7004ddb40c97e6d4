import subprocess
import sys
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.gymnasium_ids import gymnasium_id
from labutopia_lerobot.registry import UnknownTaskError, task_files
from labutopia_lerobot.setting import Setting, UnknownOptionError


@pytest.mark.parametrize(
    ("task", "obs", "liquid"),
    [
        ("level1/pick", "state", "off"),
        ("level1/pick", "pixels", "off"),
        # They are all the same environment; some cannot be played without liquid.
        *(pytest.param(task, "state", "on", marks=pytest.mark.slow) for task in task_files()),
    ],
)
def test_gymnasium_finds_no_fault_with_a_task(task: str, obs: str, liquid: str) -> None:
    small = {"width": 64, "height": 64, "particles": 100}
    env = gymnasium.make(gymnasium_id(task), obs=obs, liquid=liquid, **small).unwrapped
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Actions are radians and metres, as a robot takes them; LeRobot's policies normalise.
        warnings.filterwarnings("ignore", message=".*symmetric and normalized space")
        check_env(env)


def test_importing_the_package_registers_the_ids_without_importing_mujoco_or_torch() -> None:
    program = (
        "import sys, labutopia_lerobot, gymnasium;"
        "gymnasium.spec('labutopia/level1-pick-v0');"
        "assert not {'mujoco', 'torch', 'scipy'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_the_environment_and_not_a_wrapper_limits_the_time() -> None:
    env = gymnasium.make("labutopia/level1-pick-v0", obs="state")
    assert env.spec is not None
    assert env.spec.max_episode_steps is None
    env.reset(seed=0)
    lab = env.unwrapped
    assert isinstance(lab, LabEnv)
    still = lab.workcell.simulation.command.astype(np.float32)
    truncations = [env.step(still)[3] for _ in range(lab._max_episode_steps)]
    assert truncations.index(True) == len(truncations) - 1


def test_success_is_reported_on_reset_and_on_every_step() -> None:
    env = LabEnv(Setting("level1/pick", obs="state"))
    _, info = env.reset(seed=0)
    assert info["is_success"] is False
    expert = env.expert()
    expert.start()
    reported = []
    terminated = truncated = False
    while not (terminated or truncated):
        _, reward, terminated, truncated, info = env.step(expert.act())
        reported.append(info["is_success"])
        assert reward == float(info["is_success"])
    assert reported == [False] * (len(reported) - 1) + [True]


def test_observations_stay_within_their_space() -> None:
    env = LabEnv(Setting("level1/pick", obs="state"))
    rng = np.random.default_rng(0)
    observation, _ = env.reset(seed=0)
    for _ in range(60):
        assert env.observation_space.contains(observation)
        action = rng.uniform(env.action_space.low, env.action_space.high).astype(np.float32)
        observation, *_ = env.step(action)


def test_the_picture_of_a_state_environment_follows_the_robot() -> None:
    env = LabEnv(Setting("level1/pick", obs="state", width=64, height=64))
    env.reset(seed=0)
    before = env.render()
    for _ in range(20):
        env.step(env.action_space.high)
    assert not np.array_equal(before, env.render())
    env.close()


def test_a_wrong_option_names_the_choices() -> None:
    with pytest.raises(UnknownOptionError, match=r"obs='depth' is unknown.*pixels, state"):
        LabEnv(Setting("level1/pick", obs="depth"))
    with pytest.raises(UnknownOptionError, match=r"'side' is unknown.*front, top, wrist"):
        LabEnv(Setting("level1/pick", cameras=("front", "side")))
    with pytest.raises(UnknownOptionError, match=r"at least one.*front, top, wrist"):
        LabEnv(Setting("level1/pick", cameras=()))
    with pytest.raises(UnknownOptionError, match=r"split='odd' is unknown.*train, id, ood"):
        LabEnv(Setting("level1/pick", split="odd"))
    with pytest.raises(UnknownTaskError, match=r"Did you mean 'level1/pick'"):
        LabEnv(Setting("level1/pik"))
