"""`labutopia-check`: the suite's checks over a folder of the user's own."""

import sys
from pathlib import Path

import pytest

from labutopia_lerobot.checks import CHECKS
from labutopia_lerobot.cli import check

LAZY = """
from dataclasses import replace
from labutopia_lerobot.predicates import upright
from labutopia_lerobot.task import Substep, Step
from labutopia_lerobot.tasks.level1.pick import pick


def lazy():
    task = pick()
    (flask,) = task.start
    stands = upright(flask, within_deg=5)
    steps = (Step("stand", (), (Substep("stood", (stands,)),)),)
    return replace(task, instruction="Stand.", steps=steps, goal=(stands,), time_limit_s=4.0)
"""

BROKEN = """
def broken():
    return 1 / 0
"""

FINE = """
from dataclasses import replace
from labutopia_lerobot.tasks.level1.pick import pick


def fine():
    return replace(pick(), instruction="Fetch the flask.")
"""


HASTY = """
from dataclasses import replace
from labutopia_lerobot.tasks.level1.pick import pick


def hasty():
    return replace(pick(), instruction="Hurry.", time_limit_s=0.2)
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with three tasks: one that all succeed at, one that cannot be made, a good one."""
    for name, text in {"lazy": LAZY, "broken": BROKEN, "fine": FINE}.items():
        file = tmp_path / "mine" / "level1" / f"{name}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return tmp_path / "mine"


def checked(monkeypatch, capsys, *arguments: str) -> tuple[int, list[str]]:
    monkeypatch.setattr(sys, "argv", ["labutopia-check", *arguments])
    with pytest.raises(SystemExit) as ended:
        check.main()
    out, err = capsys.readouterr()
    return ended.value.code, (out + err).splitlines()


def test_what_is_wrong_with_a_task_is_reported_check_by_check(monkeypatch, capsys, folder):
    status, lines = checked(monkeypatch, capsys, str(folder), "--task", "level1/lazy")
    assert status == 1
    assert len(lines) == len(CHECKS) + 2  # that it can be made, and the sum
    reported = "\n".join(lines)
    assert "pass  level1/lazy  every element of the model has a name" in reported
    assert "FAIL  level1/lazy  the goal is false at the start" in reported
    assert "the whole goal holds at the start, and these have latched: stood" in reported
    assert "FAIL  level1/lazy  doing nothing does not succeed (" in reported
    assert lines[-1].startswith("1 task checked; ")


def test_a_task_that_cannot_be_made_is_reported_and_does_not_keep_others_from_being_checked(
    monkeypatch, capsys, folder
):
    monkeypatch.setattr(check, "CHECKS", CHECKS[:1])
    status, lines = checked(monkeypatch, capsys, str(folder))
    assert status == 1
    assert lines[0].startswith("FAIL  level1/broken  the task can be made: ")
    assert "broken.py, line 3: ZeroDivisionError: division by zero" in lines[0]
    assert lines[1].startswith("pass  level1/fine  the task can be made")
    assert lines[-1] == "3 tasks checked; 1 check failed"


def test_what_fails_in_the_same_way_with_ten_seeds_is_reported_once(monkeypatch, capsys, folder):
    (folder / "level1" / "hasty.py").write_text(HASTY)
    only = [each for each in CHECKS if each.__name__ == "the_expert_wins_at_least_nine_of_ten"]
    monkeypatch.setattr(check, "CHECKS", only)
    status, lines = checked(monkeypatch, capsys, str(folder), "--task", "level1/hasty")
    assert status == 1
    seeds = ", ".join(map(str, range(100, 110)))
    assert f"10 of 10 failed. seeds {seeds}: timeout; the first: Ended in step 'pick'" in lines[1]
    assert lines[1].count("Substeps not reached") == 1


@pytest.mark.slow
def test_a_good_task_passes_everything(monkeypatch, capsys, folder):
    status, lines = checked(monkeypatch, capsys, str(folder), "--task", "level1/fine")
    assert status == 0, [line for line in lines if not line.startswith("pass")]
    assert len(lines) == len(CHECKS) + 2
    assert lines[-1] == "1 task checked; no checks failed"


@pytest.mark.parametrize(
    ("line", "tasks"),
    [
        ("level1/pick", ["level1/pick"]),
        ("task=level1/pick", ["level1/pick"]),
        ("level1/pick level3/pick", ["level1/pick", "level3/pick"]),
        ("mine", ["level1/broken", "level1/fine", "level1/lazy"]),
        ("tasks_dir=mine", ["level1/broken", "level1/fine", "level1/lazy"]),
        ("mine level1/fine", ["level1/fine"]),
        ("level1/fine mine", ["level1/fine"]),
        ("mine task=level1/fine", ["level1/fine"]),
        ("level1/fine --tasks-dir mine", ["level1/fine"]),
        ("level1/press", "'level1/press' is a task, and a folder here: say task=level1/press or"),
        ("task=level1/press", ["level1/press"]),
        ("tasks_dir=level1/press", ["level1/own"]),
        ("./level1/press", ["level1/own"]),
        ("level1/folder", ["level1/own"]),
        ("level1/pik", "Unknown task 'level1/pik'. Did you mean 'level1/pick'"),
        ("mine level1/pick", "mine does not hold level1/pick"),
        ("mine level1/folder", "mine and level1/folder are two folders: check one at a time"),
        ("", "Name a folder of tasks, or a task, such as level1/pick"),
    ],
)
def test_a_bare_word_is_a_task_or_a_folder(monkeypatch, capsys, folder, line, tasks):
    monkeypatch.chdir(folder.parent)
    for name in ("press", "folder"):
        file = folder.parent / "level1" / name / "level1" / "own.py"
        file.parent.mkdir(parents=True)
        file.write_text(FINE.replace("fine", "own"))
    monkeypatch.setattr(check, "_outcomes", lambda task, folder, console: [("holds", None)])
    status, lines = checked(monkeypatch, capsys, *line.split())
    if isinstance(tasks, str):
        assert status == 2
        assert lines[0].startswith(f"Error: {tasks}")
    else:
        assert status == 0
        assert [line.split()[1] for line in lines[:-1]] == tasks


def test_a_folder_without_tasks_and_a_task_of_another_folder_are_reported(
    monkeypatch, capsys, folder
):
    status, lines = checked(monkeypatch, capsys, str(folder.parent))
    assert status == 2
    assert "holds no task: put one at" in lines[0]
    status, lines = checked(monkeypatch, capsys, str(folder), "--task", "level1/pick")
    assert status == 2
    assert lines == [
        f"Error: {folder} does not hold level1/pick. Tasks in it: level1/broken, level1/fine, "
        "level1/lazy"
    ]
