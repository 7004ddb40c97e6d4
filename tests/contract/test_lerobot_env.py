import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
import torch
from lerobot.configs import FeatureType
from lerobot.envs import make_env, make_env_config
from lerobot.envs.utils import env_to_policy_features
from lerobot.scripts.lerobot_eval import rollout
from numpy.typing import NDArray

import lerobot_env_labutopia  # noqa: F401 (registers the type, as LeRobot's programs do)
from labutopia_lerobot.checks.playing import expert, still
from labutopia_lerobot.datasets.declaration import dataset_features
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import action_feature, observation_features
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import OBSERVATION_KINDS, Setting

SIZE = {"width": 64, "height": 48}


def flat(space: gymnasium.Space[Any], path: str = "") -> dict[str, tuple[tuple[int, ...], str]]:
    """Return path -> shape and dtype of every array in a space."""
    if isinstance(space, gymnasium.spaces.Dict):
        inner = [flat(part, f"{path}/{name}".lstrip("/")) for name, part in space.items()]
        return {key: value for part in inner for key, value in part.items()}
    return {path: (space.shape or (), str(space.dtype))}


@pytest.mark.parametrize("obs", OBSERVATION_KINDS)
def test_spaces_config_and_dataset_follow_one_declaration(obs: str) -> None:
    cameras = ["wrist", "front"]
    setting = Setting("level1/pick", obs, tuple(cameras), **SIZE)
    declared = observation_features(setting, lambda: canonical_task(setting))
    env = LabEnv(setting)
    config = make_env_config("labutopia", obs=obs, cameras=cameras, **SIZE)
    dataset = dataset_features(setting)

    assert flat(env.observation_space) == {
        path: (feature.shape, feature.dtype) for path, feature in declared.items()
    }
    assert env.action_space.shape == action_feature(setting).shape
    everything = {feature.key: feature for feature in [*declared.values(), action_feature(setting)]}
    assert {
        config.features_map[name]: feature.shape for name, feature in config.features.items()
    } == {key: feature.shape for key, feature in everything.items()}
    for key, feature in everything.items():
        assert tuple(dataset[key]["shape"]) == feature.shape
        assert tuple(dataset[key]["names"]) == feature.names


def test_policies_get_pictures_channels_first_and_the_right_types() -> None:
    features = env_to_policy_features(make_env_config("labutopia", **SIZE))
    assert features["observation.images.top"].shape == (3, 48, 64)
    assert features["observation.images.top"].type is FeatureType.VISUAL
    assert features["observation.state"].type is FeatureType.STATE
    assert features["action"].type is FeatureType.ACTION
    state = env_to_policy_features(make_env_config("labutopia", obs="state"))
    assert state["observation.environment_state"].type is FeatureType.ENV


@pytest.mark.slow
def test_importing_the_plugin_imports_no_mujoco() -> None:
    program = (
        "import sys, lerobot_env_labutopia;"
        "from lerobot.envs import make_env_config;"
        "make_env_config('labutopia');"
        "assert 'mujoco' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"task": "level1/pik"}, "Did you mean 'level1/pick'"),
        ({"task": "level9"}, "Levels with tasks: 1"),
        ({"split": "odd"}, "train, id, ood"),
        ({"obs": "depth"}, "pixels, state"),
        ({"cameras": ["side"]}, "front, top, wrist"),
        ({"fps": 60}, "30"),
        ({"max_parallel_tasks": 2}, "share one policy"),
    ],
)
def test_a_wrong_flag_names_the_choices(wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(UserError, match=message):
        make_env_config("labutopia", **wrong)


def test_a_level_names_all_of_its_tasks() -> None:
    suites = make_env(make_env_config("labutopia", task="level1, level1/pick", obs="pixels"))
    assert "pick" in suites["level1"]
    assert all(envs.num_envs == 1 for envs in suites["level1"].values())


INSTRUCTION = "Pick up the conical flask and hold it still, 20 cm or more above the bench."


class Script(torch.nn.Module):
    """A policy that plays one list of actions per environment, then repeats the last."""

    def __init__(self, *scripts: list[NDArray[np.float32]]) -> None:
        super().__init__()
        self._scripts = scripts

    def reset(self) -> None:
        self._step = 0

    def select_action(self, observation: dict[str, Any]) -> torch.Tensor:
        assert observation["observation.state"].shape == (len(self._scripts), 8)
        assert observation["task"] == [INSTRUCTION] * 2
        actions = [script[min(self._step, len(script) - 1)] for script in self._scripts]
        self._step += 1
        return torch.from_numpy(np.stack(actions))


@pytest.mark.parametrize("asynchronous", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_lerobot_counts_one_success_of_two(
    asynchronous: bool, solution: list[NDArray[np.float32]]
) -> None:
    config = make_env_config("labutopia", obs="state")
    envs = make_env(config, n_envs=2, use_async_envs=asynchronous)["level1"]["pick"]
    seen = []
    try:
        result = rollout(
            envs,
            Script(solution, solution[:1]),
            *[lambda passed_on: passed_on] * 4,
            seeds=[0, 1],
            render_callback=lambda envs: seen.append(envs.call("render")[0].shape),
        )
    finally:
        envs.close()
    steps = canonical_task(Setting("level1/pick")).max_steps
    assert result["success"].any(dim=1).tolist() == [True, False]
    assert result["reward"].sum(dim=1).tolist() == [1.0, 0.0]
    assert result["done"].int().argmax(dim=1).tolist() == [len(solution) - 1, steps - 1]
    assert seen == [(256, 256, 3)] * (steps + 1)


@pytest.mark.slow
@pytest.mark.parametrize("obs", OBSERVATION_KINDS)
def test_lerobot_eval_plays_a_policy(obs: str, tmp_path: Path) -> None:
    program = Path(sys.executable).with_name("lerobot-eval")
    flags = {
        "policy.type": "act",
        "policy.device": "cpu",
        "policy.pretrained_backbone_weights": "null",
        "policy.chunk_size": 100,
        "policy.n_action_steps": 100,
        "env.type": "labutopia",
        "env.obs": obs,
        "env.cameras": "[wrist]",
        "env.width": 64,
        "env.height": 64,
        "eval.n_episodes": 2,
        "eval.batch_size": 2,
        "output_dir": tmp_path,
    }
    subprocess.run(
        [program, *(f"--{name}={value}" for name, value in flags.items())],
        check=True,
        cwd=tmp_path,
        env=os.environ | {"HF_HUB_OFFLINE": "1"},
    )
    results = json.loads((tmp_path / "eval_info.json").read_text())
    assert results["per_group"]["level1"]["n_episodes"] == 2
    assert [(row["task_group"], row["task_id"]) for row in results["per_task"]] == [
        ("level1", "pick")
    ]
    assert len(results["overall"]["video_paths"]) == 2


@pytest.mark.slow
def test_lerobot_eval_ends_with_the_message_of_a_wrong_flag(tmp_path: Path) -> None:
    program = Path(sys.executable).with_name("lerobot-eval")
    flags = ["--policy.type=act", "--env.type=labutopia", "--env.task=level1/pik"]
    done = subprocess.run([program, *flags], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode != 0
    assert "error: Unknown task 'level1/pik'. Did you mean 'level1/pick'" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_successes_per_task_stand_in_a_run_of_weights_and_biases(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import wandb  # here: only a training that logs imports it

    monkeypatch.setenv("WANDB_SILENT", "true")
    config = make_env_config("labutopia", obs="state", liquid="off")
    envs = config.create_envs(n_envs=2)["level1"]["pick"]
    with wandb.init(mode="offline", dir=tmp_path) as run:
        envs.reset(seed=[0, 1])
        picking, waiting = (member.unwrapped for member in envs._ensure().envs)
        script = expert(picking)
        actions = np.stack([still(waiting).act()] * 2)
        over = np.zeros(2, dtype=bool)
        while not over.all():
            if not over[0]:
                actions[0] = script.act()
            _, _, terminated, truncated, _ = envs.step(actions)
            over = terminated | truncated
        envs.close()
        run.log({"eval/pc_success": 50.0}, step=1)  # as LeRobot does
        logged = dict(run.summary)
    assert logged["eval/level1/pick/pc_success"] == 50.0
    assert logged["eval/level1/pick/episodes"] == 2
