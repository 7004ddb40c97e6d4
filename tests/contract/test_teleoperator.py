"""A person who moves the hand: keys become commands that our robots take as they are."""

from collections.abc import Iterator

import numpy as np
import pytest
from lerobot.teleoperators import TeleoperatorConfig, make_teleoperator_from_config

import lerobot_env_labutopia  # noqa: F401  (what LeRobot imports)
from labutopia_lerobot.devices import LabUtopiaTeleoperator, LabUtopiaTeleoperatorConfig
from labutopia_lerobot.devices.config_teleoperator import InvalidTeleoperatorError
from labutopia_lerobot.devices.lerobot_robot import NEXT_EPISODE
from labutopia_lerobot.devices.teleoperator import of_keys, of_sticks
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.setting import Setting

SECOND = 30


@pytest.fixture
def person() -> LabUtopiaTeleoperator:
    return LabUtopiaTeleoperator(LabUtopiaTeleoperatorConfig())


@pytest.fixture
def env() -> Iterator[LabEnv]:
    env = LabEnv(Setting("level1/pick", obs="state"))
    env.reset(seed=0)
    yield env
    env.close()


def hold(person: LabUtopiaTeleoperator, env: LabEnv, keys: str, periods: int = SECOND) -> None:
    """Keep keys down, let them go, and wait until the arm stands still."""
    for pressed in [keys] * periods + [""] * SECOND:
        action = person.commanded(of_keys(pressed))
        *_, info = env.step(np.array([action[name] for name in PANDA.names], np.float32))
        assert info["clipped_actions"] == 0


def test_lerobot_finds_it_by_its_type() -> None:
    config = TeleoperatorConfig.get_choice_class("labutopia")()
    made = make_teleoperator_from_config(config)
    assert isinstance(made, LabUtopiaTeleoperator)
    assert list(made.action_features) == list(PANDA.names)


@pytest.mark.parametrize(
    ("keys", "moved"),
    [("w", (0.15, 0, 0)), ("a", (0, 0.15, 0)), ("r", (0, 0, 0.15)), ("sdf", (-0.15, -0.15, -0.15))],
)
def test_a_key_moves_the_hand_without_turning_it(
    person: LabUtopiaTeleoperator, env: LabEnv, keys: str, moved: tuple[float, float, float]
) -> None:
    before = env.workcell.world.gripper
    hold(person, env, keys)
    after = env.workcell.world.gripper
    assert np.abs(after.position_w - before.position_w - moved).max() < 0.01
    turned = np.arccos((np.trace(before.rotation_w.T @ after.rotation_w) - 1) / 2)
    assert turned < np.radians(2)


def test_a_key_rolls_the_hand_without_moving_it(person: LabUtopiaTeleoperator, env: LabEnv) -> None:
    before = env.workcell.world.gripper
    hold(person, env, "o")
    after = before.inverse() @ env.workcell.world.gripper
    assert np.arctan2(after.rotation_w[1, 0], after.rotation_w[0, 0]) == pytest.approx(
        0.8, abs=0.05
    )
    assert np.linalg.norm(after.position_w) < 0.01


def test_the_hand_closes_and_opens(person: LabUtopiaTeleoperator, env: LabEnv) -> None:
    world = env.workcell.world
    hold(person, env, "c")
    assert world.gripper_opening < 0.005
    hold(person, env, "v")
    assert world.gripper_opening == pytest.approx(PANDA.max_opening, abs=0.002)


def test_without_a_key_the_hand_comes_to_rest(person: LabUtopiaTeleoperator) -> None:
    person.commanded(of_keys("wo"))
    for _ in range(SECOND):
        kept = person.commanded(of_keys(""))
    assert person.commanded(of_keys("")) == kept


def test_a_key_that_stays_down_asks_for_one_next_episode_from_its_start(
    person: LabUtopiaTeleoperator,
) -> None:
    start = person.commanded(of_keys(""))
    for _ in range(SECOND):
        person.commanded(of_keys("w"))
    reported = [person.commanded(of_keys(keys)) for keys in ("n", "n", "", "n")]
    assert [NEXT_EPISODE in action for action in reported] == [True, False, False, True]
    assert {name: reported[0][name] for name in PANDA.names} == start


def test_a_stick_moves_as_a_key_does() -> None:
    wish = of_sticks({"delta_x": 1.0, "delta_y": 0.0, "delta_z": 0.0, "gripper": 0})
    key = of_keys("wc")
    assert np.array_equal(wish.along_w, key.along_w)
    assert wish.opening == key.opening


@pytest.mark.parametrize("option", [{"device": "mouse"}, {"robot": "pandas"}, {"room": "moon"}])
def test_a_wrong_flag_lists_the_choices(option: dict[str, str]) -> None:
    with pytest.raises(InvalidTeleoperatorError, match="Choose from"):
        LabUtopiaTeleoperatorConfig(**option)


@pytest.mark.parametrize("device", ["keyboard", "gamepad"])
def test_a_device_that_is_not_there_is_reported_with_the_cure(device: str) -> None:
    person = LabUtopiaTeleoperator(LabUtopiaTeleoperatorConfig(device=device))
    with pytest.raises(ConnectionError, match="pip install"):
        person.connect()
