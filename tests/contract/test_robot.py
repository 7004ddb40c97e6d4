"""The environment as a LeRobot `Robot`: found, driven and recorded by LeRobot's own programs."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from lerobot.configs.dataset import DatasetRecordConfig
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.robots import RobotConfig
from lerobot.robots.utils import make_robot_from_config
from lerobot.scripts import lerobot_record
from lerobot.teleoperators import Teleoperator, TeleoperatorConfig

import lerobot_env_labutopia  # noqa: F401  (what LeRobot imports)
from labutopia_lerobot.datasets.declaration import dataset_features
from labutopia_lerobot.devices import LabUtopiaRobot, LabUtopiaRobotConfig
from labutopia_lerobot.devices.config_lerobot_robot import InvalidRobotError
from labutopia_lerobot.devices.lerobot_robot import NEXT_EPISODE
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting

SMALL = {"cameras": ("front",), "width": 64, "height": 48}


@TeleoperatorConfig.register_subclass("scripted")
@dataclass
class ScriptedConfig(TeleoperatorConfig):
    """A person who types the expert's commands."""


EVENTS = {"exit_early": False, "rerecord_episode": False, "stop_recording": False}
"""What LeRobot's recorder hears of its keyboard; the first is the right arrow: go on."""


class Scripted(Teleoperator):
    """Five commands, then on; another scene, then on; five commands, then on."""

    config_class = ScriptedConfig
    name = "scripted"
    commands: ClassVar[list[np.ndarray]] = []
    is_connected = is_calibrated = True
    feedback_features: ClassVar[dict[str, type]] = {}
    action_features: ClassVar[dict[str, type]] = {}

    def __init__(self, config: ScriptedConfig) -> None:
        super().__init__(config)
        self._given = 0

    def get_action(self) -> dict[str, float]:
        names = LabUtopiaRobot(LabUtopiaRobotConfig()).action_features
        self._given += 1
        EVENTS["exit_early"] = self._given in (5, 6, 11)
        command = self.commands[(self._given - 1) % 6]
        action = dict(zip(names, command.tolist(), strict=True))
        return action | ({NEXT_EPISODE: 1.0} if self._given == 6 else {})

    def connect(self, calibrate: bool = True) -> None: ...
    def calibrate(self) -> None: ...
    def configure(self) -> None: ...
    def send_feedback(self, feedback: dict[str, Any]) -> None: ...
    def disconnect(self) -> None: ...


@pytest.fixture
def robot() -> Iterator[LabUtopiaRobot]:
    robot = LabUtopiaRobot(LabUtopiaRobotConfig(**SMALL))
    robot.connect()
    yield robot
    robot.disconnect()


def test_lerobot_finds_it_by_its_type() -> None:
    config = RobotConfig.get_choice_class("labutopia")(task="level1/press", **SMALL)
    assert isinstance(make_robot_from_config(config), LabUtopiaRobot)


@pytest.mark.parametrize(
    ("option", "reported"),
    [
        ({"task": "level1/pik"}, "Did you mean 'level1/pick'"),
        ({"obs": "state"}, "a robot has cameras"),
        ({"width": 0}, "from 1 to"),
    ],
)
def test_a_wrong_flag_is_reported(option: dict[str, Any], reported: str) -> None:
    with pytest.raises(InvalidRobotError, match=reported):
        LabUtopiaRobotConfig(**option)


def test_it_does_what_the_environment_does(robot: LabUtopiaRobot, solution) -> None:
    env = LabEnv(Setting("level1/pick", split="train", **SMALL))
    seen, _ = env.reset(seed=0)
    for command in solution[:5]:
        reported = robot.get_observation()
        assert [reported[name] for name in robot.action_features] == seen["agent_pos"].tolist()
        assert np.array_equal(reported["front"], seen["pixels"]["front"])
        seen, *_, info = env.step(command)
        acted = robot.send_action(dict(zip(robot.action_features, command, strict=True)))
        assert list(acted.values()) == info["applied_action"].tolist()
    env.close()


def test_the_next_episode_begins_when_it_is_asked_for(robot: LabUtopiaRobot) -> None:
    first = robot.get_observation()
    still = {name: first[name] for name in robot.action_features}
    robot.send_action(still)
    robot.send_action({**still, NEXT_EPISODE: True})
    env = LabEnv(Setting("level1/pick", split="train", **SMALL))
    second, _ = env.reset(seed=1)
    env.close()
    assert np.array_equal(robot.get_observation()["front"], second["pixels"]["front"])


def test_lerobot_records_a_person_with_the_features_of_our_datasets(
    tmp_path: Path, solution, monkeypatch
) -> None:
    monkeypatch.setattr(Scripted, "commands", solution)
    monkeypatch.setattr(lerobot_record, "init_keyboard_listener", lambda: (None, EVENTS))
    monkeypatch.setattr(lerobot_record, "make_teleoperator_from_config", Scripted)
    lerobot_record.record(
        lerobot_record.RecordConfig(
            robot=LabUtopiaRobotConfig(**SMALL),
            teleop=ScriptedConfig(),
            dataset=DatasetRecordConfig(
                repo_id="local/person",
                root=tmp_path / "person",
                single_task="Pick up the conical flask from the bench.",
                num_episodes=2,
                episode_time_s=600,
                reset_time_s=600,
                push_to_hub=False,
            ),
            play_sounds=False,
        )
    )
    dataset = LeRobotDataset("local/person", root=tmp_path / "person", video_backend="pyav")
    declared = dataset_features(Setting("level1/pick", **SMALL))
    for key in ("observation.state", "action", "observation.images.front"):
        for part in ("dtype", "shape", "names"):
            assert list(dataset.features[key][part]) == list(declared[key][part])
    assert dataset.fps == 30
    assert [row["length"] for row in dataset.meta.episodes] == [5, 5]
    starts = []
    for seed in (0, 1):
        env = LabEnv(Setting("level1/pick", split="train", **SMALL))
        starts.append(env.reset(seed=seed)[0]["pixels"]["front"] / 255.0)
        env.close()
    for number in range(10):
        assert dataset[number]["action"].tolist() == solution[number % 5].tolist()
    for episode, first in enumerate((0, 5)):
        shown = dataset[first]["observation.images.front"].permute(1, 2, 0).numpy()
        distances = [np.abs(shown - start).mean() for start in starts]
        assert int(np.argmin(distances)) == episode
