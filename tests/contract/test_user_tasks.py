"""A task in a folder of the user's own, without a line changed anywhere else."""

import importlib.metadata
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from labutopia_lerobot import registry
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.gymnasium_ids import register_tasks
from labutopia_lerobot.layout import ImpossibleStartError
from labutopia_lerobot.registry import (
    UnknownTaskError,
    choose_tasks,
    is_beyond_paper,
    task_files,
    tasks_of_levels,
)
from labutopia_lerobot.scenario.task_function import task_function
from labutopia_lerobot.setting import Setting

README = Path(__file__).parents[2] / "README.md"

TASK = README.read_text().partition('```python\n"""Lift')[2].partition("```")[0]
"""The README's own example, less its first line."""


@pytest.fixture
def tasks_dir(tmp_path: Path) -> Path:
    file = tmp_path / "my_tasks" / "level1" / "raise_flask.py"
    file.parent.mkdir(parents=True)
    file.write_text(f'"""Lift{TASK}')
    return tmp_path / "my_tasks"


def test_a_task_file_in_a_folder_of_ones_own_is_found_beside_the_others(tasks_dir):
    assert set(task_files(tasks_dir)) - set(task_files()) == {"level1/raise_flask"}


def test_it_is_none_of_the_papers_which_a_level_means(tasks_dir):
    assert is_beyond_paper("level1/raise_flask", tasks_dir)
    assert tasks_of_levels([1], tasks_dir) == tasks_of_levels([1])
    assert choose_tasks("raise_flask", 1, tasks_dir) == ["level1/raise_flask"]


def test_its_expert_succeeds_in_the_environment(tasks_dir):
    env = LabEnv(Setting("level1/raise_flask", obs="state", tasks_dir=tasks_dir))
    env.reset(seed=0)
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert info["outcome"] == "success"


@pytest.mark.parametrize(
    ("written", "instead", "why"),
    [
        ("falling(glass, faster_than=0.4)", "~gripped(glass)", "not .glass gripped"),
        ("steps=(", "setup=(Pick(glass, lift=9.0),), steps=(", "lift not done after"),
    ],
)
def test_a_start_that_is_lost_before_it_begins_says_why(tasks_dir, written, instead, why):
    file = tasks_dir / "level1" / "raise_flask.py"
    assert written in file.read_text()
    file.write_text(file.read_text().replace(written, instead))
    env = LabEnv(Setting("level1/raise_flask", obs="state", tasks_dir=tasks_dir))
    with pytest.raises(ImpossibleStartError, match=f"cannot begin with seed 0 .* since: .*{why}"):
        env.reset(seed=0)


@pytest.mark.slow
def test_the_evaluator_plays_it_from_the_command_line(tasks_dir, tmp_path):
    out = tmp_path / "result"
    command = [
        *(sys.executable, "eval/run.py", "task=level1/raise_flask", "policy=expert"),
        *(f"tasks_dir={tasks_dir}", "episodes=2", "videos=0", "workers=1", f"out={out}"),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "level1/raise_flask" in done.stdout
    assert (out / "result.json").is_file()


def test_a_misspelled_task_of_ones_own_is_reported_with_those_in_the_folder(tasks_dir):
    reported = rf"Did you mean 'level1/raise_flask'\?.* In {tasks_dir}: level1/raise_flask$"
    with pytest.raises(UnknownTaskError, match=reported):
        Setting("level1/raise_flsk", tasks_dir=str(tasks_dir))


def test_an_empty_folder_is_an_error_that_says_where_tasks_go(tmp_path):
    with pytest.raises(UnknownTaskError, match=r"level1/<name>\.py"):
        task_files(tmp_path)


def test_a_file_without_its_function_is_an_error_that_names_it(tasks_dir):
    (tasks_dir / "level1" / "empty.py").write_text("")
    with pytest.raises(UnknownTaskError, match=r"empty\(\) -> Task"):
        task_function("level1/empty", str(tasks_dir))


def test_a_task_that_exists_twice_is_an_error(tasks_dir):
    (tasks_dir / "level1" / "pick.py").write_text("")
    with pytest.raises(UnknownTaskError, match="exists twice"):
        task_files(tasks_dir)


def test_a_package_that_is_not_there_is_reported_and_the_other_tasks_stay(monkeypatch):
    broken = importlib.metadata.EntryPoint("lab", "nowhere.lab_tasks", "labutopia.tasks")
    monkeypatch.setattr(registry, "entry_points", lambda: [broken])
    with pytest.warns(UserWarning, match=r"'nowhere\.lab_tasks' for tasks, which cannot be found"):
        assert "level1/pick" in task_files()


def test_tasks_that_clash_do_not_break_the_import(tasks_dir, monkeypatch):
    (tasks_dir / "level1" / "pick.py").write_text("")
    monkeypatch.setattr("labutopia_lerobot.registry._installed", lambda entry: [tasks_dir])
    entry = importlib.metadata.EntryPoint("lab", "lab_tasks", "labutopia.tasks")
    monkeypatch.setattr(registry, "entry_points", lambda: [entry])
    with pytest.warns(UserWarning, match=r"No Gymnasium id is registered.*exists twice"):
        register_tasks()


@pytest.mark.parametrize(
    ("right", "wrong", "line", "reported"),
    [
        ("import falling, gripped", "import falling, is_gripped", 5, "Did you mean 'gripped'?"),
        ("(gripped(glass),))", "(griped(glass),))", 13, "Did you mean 'gripped'?"),
        ("time_limit_s=15.0", "time_limit=15.0", 14, "Did you mean 'time_limit_s'?"),
        ("y=(-0.07, 0.07)", "y=(0.07, -0.07)", 16, "write y=(least, greatest)"),
        ("y=(-0.07, 0.07)", "y=0.07", 16, "y=0.07 is no range"),
        ("500 ml", "501 ml", 12, "sizes: 300 ml, 500 ml, 1000 ml"),
        ("faster_than=0.4", "", 19, "missing a required keyword-only argument: 'faster_than'"),
        ("    return Task(", "    return Task((", 14, "was never closed"),
        (
            "(held,), touches=(glass,)",
            "held, touches=(glass,)",
            17,
            "not the Substep 'gripped' (is a comma missing?)",
        ),
        ("    glass =", "    {}['a']\n    glass =", 12, "KeyError: 'a'"),
    ],
)
def test_a_mistake_in_ones_own_file_is_reported_with_its_line(
    tasks_dir, right, wrong, line, reported
):
    file = tasks_dir / "level1" / "raise_flask.py"
    assert right in file.read_text()
    file.write_text(file.read_text().replace(right, wrong))
    with pytest.raises(UserError) as raised:
        task_function("level1/raise_flask", str(tasks_dir))
    assert str(raised.value).startswith(f"{file}, line {line}: ")
    assert reported in str(raised.value)
    assert len(str(raised.value).splitlines()) == 1


def test_a_file_below_the_working_directory_is_reported_as_it_is_typed(tasks_dir, monkeypatch):
    (tasks_dir / "level1" / "raise_flask.py").write_text("import nothing_of_this_name")
    monkeypatch.chdir(tasks_dir.parent)
    reported = "^my_tasks/level1/raise_flask.py, line 1: ModuleNotFoundError"
    with pytest.raises(UserError, match=reported):
        task_function("level1/raise_flask", "my_tasks")


def test_a_mistake_of_ours_is_no_mistake_of_the_user(monkeypatch):
    broken = SimpleNamespace(pick=lambda: {}["a"])
    monkeypatch.setattr(
        "labutopia_lerobot.scenario.task_function._import", lambda task, path: broken
    )
    with pytest.raises(KeyError):
        task_function.__wrapped__("level1/pick")
