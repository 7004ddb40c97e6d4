"""One value holds everything that a user chooses, and every program takes it."""

import argparse
import dataclasses
from pathlib import Path

import pytest

from labutopia_lerobot import setting as settings
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.registry import UnknownTaskError
from labutopia_lerobot.robots import ROBOTS
from labutopia_lerobot.setting import (
    Setting,
    UnknownOptionError,
    option_help,
    setting_from,
    setting_of,
    with_setting,
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
    @dataclasses.dataclass(frozen=True)
    class Wider(Setting):
        """Everything that a user chooses.

        Attributes:
            gravity: How strongly things fall.
        """

        gravity: str = "earth"

    monkeypatch.setattr(settings, "Setting", Wider)
    monkeypatch.setattr("labutopia_lerobot.cli.setting_flags.Setting", Wider)

    @with_setting
    class Options:
        """Options of a program.

        Attributes:
            task: Task id.
        """

        task: str = PICK

    assert setting_of(Options(gravity="moon")).gravity == "moon"
    assert setting_of(Options()).gravity == "earth"
    assert option_help(Options)["gravity"] == "How strongly things fall."
    assert setting_from({"task": PICK, "gravity": "moon"}).gravity == "moon"
    parser = argparse.ArgumentParser()
    add_setting_flags(parser)
    assert setting_of_flags(parser.parse_args(["--gravity", "moon"]), PICK).gravity == "moon"


def test_every_program_declares_every_field():
    from labutopia_lerobot.datasets.recording_config import RecordingConfig
    from labutopia_lerobot.evaluation.config import EvaluationConfig
    from labutopia_lerobot.lerobot_plugin import LabUtopiaEnvConfig

    names = {option.name for option in dataclasses.fields(Setting)}
    for options in (RecordingConfig, EvaluationConfig, LabUtopiaEnvConfig):
        assert names <= {option.name for option in dataclasses.fields(options)}, options


def test_every_field_has_its_help():
    assert {option.name for option in dataclasses.fields(Setting)} == option_help(Setting).keys()


def test_help_names_the_robots_that_can_be_typed():
    assert option_help(Setting)["robot"].endswith(f"one of {', '.join(ROBOTS)}.")
