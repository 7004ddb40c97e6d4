"""One value holds everything that a user chooses, and every program takes it."""

import argparse
import dataclasses
import pickle
import subprocess
import sys
from pathlib import Path

import pytest

from labutopia_lerobot import setting as settings
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.registry import UnknownTaskError
from labutopia_lerobot.robots import ROBOTS
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.setting import (
    DEFAULT_ROOM,
    ROBOT_NAMES,
    Setting,
    SettingOptions,
    UnknownOptionError,
    option,
    option_help,
    setting_from,
    setting_of,
)

PICK = "level1/pick"


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"obs": "depth"}, "obs='depth' is unknown. Choose from: pixels, state"),
        ({"split": "odd"}, "train, id, ood"),
        ({"liquid": "some"}, "on, off"),
        ({"cameras": ("front", "side")}, "front, top, wrist"),
        ({"cameras": ("front", "front")}, "none twice"),
        ({"cameras": ()}, "at least one"),
        ({"width": 1921}, "width is a whole number from 1 to 1920"),
        ({"height": 1081}, "height is a whole number from 1 to 1080"),
        ({"height": 0}, "height is a whole number from 1 to 1080"),
        ({"particles": 0}, "particles is a whole number from 1"),
        ({"particles": 1.5}, "particles is a whole number from 1"),
        ({"particles": True}, "particles is a whole number from 1"),
    ],
)
def test_impossible_values_are_refused_with_what_is_possible(wrong, message):
    with pytest.raises(UnknownOptionError, match=message):
        Setting(PICK, **wrong)


def test_an_unknown_task_is_refused_with_the_nearest():
    with pytest.raises(UnknownTaskError, match="Did you mean 'level1/pick'"):
        Setting("level1/pik")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("pick", "Did you mean 'level1/pick' or 'level3/pick'?"),
        ("pres", "Did you mean 'level1/press' or 'level3/press'?"),
        ("level2/pik", "Did you mean"),
        ("zebra", "`labutopia-record --help` lists all"),
    ],
)
def test_an_unknown_task_is_reported_in_a_short_line_with_the_lowest_level_first(typed, meant):
    with pytest.raises(UnknownTaskError) as raised:
        Setting(typed)
    assert meant in str(raised.value)
    assert len(str(raised.value)) < 200
    assert str(raised.value).count("level") <= 3


def test_a_misspelled_option_is_refused_with_the_nearest():
    with pytest.raises(UnknownOptionError, match=r"'camera' is no option\. Did you mean 'cameras'"):
        setting_from({"task": PICK, "camera": "front"})


def test_one_camera_and_a_path_may_be_given_as_they_are(tmp_path: Path):
    (tmp_path / "level1").mkdir()
    (tmp_path / "level1" / "mine.py").touch()
    setting = Setting(PICK, cameras="wrist", tasks_dir=tmp_path)  # type: ignore[arg-type]
    assert setting.cameras == ("wrist",)
    assert setting.tasks_dir == str(tmp_path)
    assert hash(setting) == hash(Setting(PICK, cameras=("wrist",), tasks_dir=str(tmp_path)))


def test_a_new_field_is_an_option_of_every_program_without_another_edit(monkeypatch):
    @dataclasses.dataclass
    class WiderOptions(SettingOptions):
        gravity: str = option("earth", "How strongly things fall.")

    @dataclasses.dataclass(unsafe_hash=True)
    class Wider(Setting, WiderOptions):
        pass

    @dataclasses.dataclass
    class Options(WiderOptions):
        task: str = option(PICK, "Task id.")

    monkeypatch.setattr(settings, "Setting", Wider)
    monkeypatch.setattr("labutopia_lerobot.cli.setting_flags.Setting", Wider)
    assert setting_of(Options(gravity="moon")).gravity == "moon"
    assert setting_of(Options()).gravity == "earth"
    assert option_help(Options)["gravity"] == "How strongly things fall."
    assert setting_from({"task": PICK, "gravity": "moon"}).gravity == "moon"
    parser = argparse.ArgumentParser()
    add_setting_flags(parser)
    assert setting_of_flags(parser.parse_args(["--gravity", "moon"]), PICK).gravity == "moon"


def test_every_option_of_every_program_has_its_help():
    from labutopia_lerobot.datasets.recording_config import RecordingConfig
    from labutopia_lerobot.devices import LabUtopiaRobotConfig
    from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
    from labutopia_lerobot.lerobot_plugin import LabUtopiaEnvConfig

    shared = {each.name for each in dataclasses.fields(SettingOptions)}
    for options in (Setting, RecordingConfig, EvaluationConfig, PolicyConfig):
        assert option_help(options).keys() == {each.name for each in dataclasses.fields(options)}
    for options in (LabUtopiaEnvConfig, LabUtopiaRobotConfig):  # the others are LeRobot's
        assert shared <= option_help(options).keys()


def test_a_program_lists_its_own_options_first():
    from labutopia_lerobot.datasets.recording_config import RecordingConfig

    config = RecordingConfig(task=PICK)
    assert list(config.chosen)[:5] == ["task", "level", "together", "split", "episodes"]
    assert list(config.chosen)[-3:] == ["renderer", "reward", "step"]
    assert config.chosen == dataclasses.asdict(config)


def test_help_names_the_robots_that_can_be_typed():
    assert option_help(Setting)["robot"].endswith(f"one of {', '.join(ROBOTS)}.")


def test_the_names_of_robots_and_rooms_are_those_of_what_is_built():
    assert tuple(ROBOTS) == ROBOT_NAMES
    assert LABORATORY.name == DEFAULT_ROOM


def test_a_setting_is_a_value_that_nobody_changes():
    setting = Setting(PICK)
    with pytest.raises(dataclasses.FrozenInstanceError, match="cannot assign to field 'obs'"):
        setting.obs = "state"
    with pytest.raises(dataclasses.FrozenInstanceError, match="cannot assign to field 'sight'"):
        setting.sight = "state"  # type: ignore[attr-defined]
    with pytest.raises(dataclasses.FrozenInstanceError, match="cannot delete field 'obs'"):
        del setting.obs
    for same in (dataclasses.replace(setting), pickle.loads(pickle.dumps(setting)), Setting(PICK)):
        assert same == setting
        assert hash(same) == hash(setting)
    with pytest.raises(TypeError, match="task"):
        Setting()  # type: ignore[call-arg]


def outcome_of(code: str, *flags: str) -> str:
    done = subprocess.run(
        [sys.executable, *flags, "-c", code], capture_output=True, text=True, check=True
    )
    return done.stdout


def test_options_are_known_without_robots_and_rooms():
    loaded = outcome_of("import sys, labutopia_lerobot.setting; print(*sys.modules)").split()
    assert "labutopia_lerobot.setting" in loaded
    heavy = ("labutopia_lerobot.robots", "labutopia_lerobot.scenes", "mujoco")
    assert [name for name in loaded if name.startswith(heavy)] == []


def test_help_stays_where_docstrings_are_left_out():
    code = (
        "from labutopia_lerobot.setting import *; print(*option_help(Setting).values(), sep='\\n')"
    )
    assert outcome_of(code, "-OO") == outcome_of(code)
