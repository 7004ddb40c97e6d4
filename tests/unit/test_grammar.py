"""Every program takes `name=value`, `--name value` and `--name=value`, and a task by itself."""

from pathlib import Path

import pytest

from labutopia_lerobot.cli.evaluate import parse as evaluated
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.record import OverrideError
from labutopia_lerobot.cli.record import parse as recorded
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.evaluation.config import EvaluationOptionError

PICK, PRESS = "level1/pick", "level1/press"


def parser() -> OptionParser:
    made = OptionParser()
    made.add_argument("task")
    made.add_argument("--out", type=Path)
    made.add_argument("--results", type=Path, nargs="+")
    made.add_argument("--seed", type=int, default=0)
    made.add_argument("--headless", action="store_true")
    add_setting_flags(made)
    return made


@pytest.mark.parametrize(
    "line",
    [
        "level1/pick --axes light material --width 64 --headless --seed -4",
        "level1/pick --axes [light,material] --width=64 --headless --seed=-4",
        "level1/pick --axes light,material width=64 headless=true seed=-4",
        "task=level1/pick axes=[light,material] width=64 headless=true seed=-4",
        "axes=light,material level1/pick width=64 --headless seed=-4",
        "--task level1/pick axes=[light,material] --width 64 headless=True --seed -4",
        "--task=level1/pick --axes=light,material --width 64 headless=true --seed -4",
    ],
)
def test_flags_and_names_with_values_say_the_same_to_a_parser_of_flags(line):
    found = parser().parse_args(line.split())
    assert (found.seed, found.headless) == (-4, True)
    setting = setting_of_flags(found, found.task)
    assert (setting.task, setting.width, setting.axes) == (PICK, 64, ("light", "material"))


def test_an_underscore_is_as_good_as_a_dash():
    for line in (
        "x tasks_dir=here",
        "x --tasks_dir here",
        "x tasks-dir=here",
        "x --tasks-dir=here",
    ):
        assert parser().parse_args(line.split()).tasks_dir == "here"


def test_what_is_no_option_stays_a_path():
    found = parser().parse_args(
        ["runs/lr=1e-4", "out=a=b", "--results", "a,b", "c=d", "--seed", "1"]
    )
    assert (found.task, found.out, found.seed) == ("runs/lr=1e-4", Path("a=b"), 1)
    assert found.results == [Path("a,b"), Path("c=d")]
    assert parser().parse_args(["--", "out=x"]).task == "out=x"
    assert parser().parse_args(["headless=false", "x"]).headless is False


def test_a_switch_is_true_or_false(capsys):
    with pytest.raises(SystemExit, match="2"):
        parser().parse_args(["x", "headless=maybe"])
    assert "headless=maybe is neither true nor false" in capsys.readouterr().err


def test_commands_of_a_program_take_both_too():
    made = OptionParser()
    command = made.add_subparsers(dest="command").add_parser("generate")
    command.add_argument("--size", type=float, nargs=2)
    command.add_argument("--family")
    for line in ("generate size=8,6 family=organic", "generate --size 8 6 --family organic"):
        found = made.parse_args(line.split())
        assert (found.size, found.family) == ([8.0, 6.0], "organic")


@pytest.mark.parametrize(
    "line",
    [
        "task=level1/pick,level1/press cameras=[front,top] episodes=3 together=true root=a/lr=1",
        "level1/pick level1/press cameras=front,top --episodes 3 --together --root=a/lr=1",
        "level1/pick,level1/press --cameras front top --together true --episodes=3 --root a/lr=1",
        "--task [level1/pick,level1/press] --cameras [front,top] --together root=a/lr=1 episodes=3",
    ],
)
def test_flags_and_names_with_values_say_the_same_to_the_recorder(line):
    config = recorded(line.split())
    assert config.tasks == [PICK, PRESS]
    assert (config.episodes, config.together, config.root) == (3, True, "a/lr=1")
    assert list(getattr(config, "cameras", ())) == ["front", "top"]


@pytest.mark.parametrize(
    "line",
    [
        "level1/pick,level1/press policy.path=a/lr=1 out=it's split=id,ood",
        "--task level1/pick level1/press --policy.path a/lr=1 --out it's --split id ood",
    ],
)
def test_flags_and_names_with_values_say_the_same_to_the_evaluator(line):
    config = evaluated(line.split())
    assert (config.tasks, config.splits) == ([PICK, PRESS], ["id", "ood"])
    assert (config.policy.path, config.out) == ("a/lr=1", "it's")


def test_one_value_stays_one_and_what_takes_several_becomes_a_list():
    config = recorded(["level1/pick", "axes=all", "cameras=[front]", "level=null"])
    assert config.task == PICK
    assert getattr(config, "axes", None) == ["all"]
    assert getattr(config, "cameras", None) == ["front"]


@pytest.mark.parametrize(
    ("line", "reported"),
    [
        ("level1/pick --episode 3", r"'--episode' is no option. Did you mean 'episodes='\?"),
        ("level1/pick episode=3", r"'episode=3' is no option. Did you mean 'episodes='\?"),
        ("level1/pick --episodes", "--episodes needs a value: --episodes VALUE or episodes=VALUE"),
    ],
)
def test_a_word_that_is_no_option_is_reported_with_the_nearest(line, reported):
    with pytest.raises(OverrideError, match=reported):
        recorded(line.split())
    with pytest.raises(EvaluationOptionError, match=reported):
        evaluated([*line.split(), "policy=expert"] if "VALUE" not in reported else line.split())
