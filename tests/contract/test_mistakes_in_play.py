"""What a task file of the user's raises while it is played is told in a line; ours is a bug."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from labutopia_lerobot.checks import CHECKS
from labutopia_lerobot.cli import check
from labutopia_lerobot.errors import FileMistakeError
from labutopia_lerobot.evaluation.result_folder import ROWS, read_rows
from labutopia_lerobot.scenario.task_function import located_in_play, task_function
from labutopia_lerobot.scenes.textures import texture

JUDGED = """
from dataclasses import replace

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.tasks.level1.pick import pick


@predicate("{limit:g} s are not over")
def early(world, *, limit):
    if world.time > limit:
        return [][1]
    return False


def judged():
    return replace(pick(), instruction="Hurry.", never={"late": early(limit=0.32)})
"""
"""A predicate that raises at the tenth control step."""

MOVED = """
from dataclasses import dataclass, replace

import numpy as np

from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.tasks.level1.pick import pick


@dataclass(frozen=True)
class Ponder:
    def phases(self, world):
        yield Phase("wait", lambda w: w.gripper, 0.05, lambda w, target, seconds: seconds > 0.3)
        np.linalg.inv(np.zeros((3, 3)))


def moved():
    task = pick()
    steps = (replace(task.steps[0], skills=(Ponder(),)), *task.steps[1:])
    return replace(task, instruction="Ponder.", steps=steps)
"""
"""A skill that raises after its first phase, in a library that it calls."""

TOLD = {
    "level1/judged": "mine/level1/judged.py, line 11: IndexError: list index out of range",
    "level1/moved": "mine/level1/moved.py, line 14: LinAlgError: Singular matrix",
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in {"judged": JUDGED, "moved": MOVED}.items():
        file = tmp_path / "mine" / "level1" / f"{name}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    monkeypatch.chdir(tmp_path)
    task_function.cache_clear()  # `mine` was another folder in the test before
    return tmp_path / "mine"


def reported_by(program: str, words: str, monkeypatch, capsys) -> list[str]:
    """Run a program that stops; return what it says of why, line by line."""
    monkeypatch.setattr(sys, "argv", [f"labutopia-{program}", *words.split(), "tasks_dir=mine"])
    with pytest.raises(SystemExit, match="2"):
        import_module(f"labutopia_lerobot.cli.{program}").main()
    lines = capsys.readouterr().err.splitlines()
    (first,) = (number for number, line in enumerate(lines) if line.startswith("Error: "))
    return [lines[first].removeprefix("Error: "), *lines[first + 1 :]]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("program", "words", "task"),
    [
        ("view", "headless=true cameras=front width=32 height=32", "level1/judged"),
        ("record", "obs=state episodes=1 workers=1", "level1/judged"),
        ("evaluate", "policy=expert episodes=1 videos=0 workers=1 out=here", "level1/moved"),
    ],
    ids=["view", "record", "evaluate"],
)
def test_every_program_that_plays_names_the_line(monkeypatch, capsys, program, words, task):
    told = reported_by(program, f"{task} {words}", monkeypatch, capsys)
    assert told[0] == TOLD[task]
    assert len([line for line in told if not line.startswith(("In the episode", "What was"))]) == 1


@pytest.mark.parametrize("task", TOLD)
def test_a_check_names_the_line_and_goes_on(monkeypatch, capsys, task):
    names = ("doing_nothing_does_not_succeed", "the_expert_touches_only_what_its_phases_list")
    wanted = [each for each in CHECKS if each.__name__ in names]
    monkeypatch.setattr(check, "CHECKS", wanted)
    monkeypatch.setattr(sys, "argv", ["labutopia-check", "mine", "--task", task])
    with pytest.raises(SystemExit, match="1"):
        check.main()
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(wanted) + 2
    failed = [line for line in lines if line.startswith("FAIL")]
    assert failed
    for line in failed:
        assert line.endswith(TOLD[task])


@pytest.mark.slow
def test_lerobot_eval_ends_with_the_line_too(folder):
    program = Path(sys.executable).with_name("lerobot-eval")
    policy = ["--policy.type=mlp", "--policy.device=cpu", "--eval.batch_size=1"]
    env = ["--env.type=labutopia", "--env.task=level1/judged", f"--env.tasks_dir={folder}"]
    flags = [*policy, *env, "--env.obs=state", "--eval.n_episodes=1", "--output_dir=here"]
    done = subprocess.run([program, *flags], capture_output=True, text=True)
    assert done.returncode != 0
    assert "Traceback" not in done.stderr
    assert f"Error: {TOLD['level1/judged']}" in done.stderr.splitlines()


@pytest.mark.slow
def test_what_was_finished_before_is_kept(monkeypatch, capsys):
    told = reported_by(
        "evaluate",
        "task=[level1/pick,level1/judged] policy=still episodes=1 videos=0 workers=1 out=here",
        monkeypatch,
        capsys,
    )
    assert told[0] == TOLD["level1/judged"]
    assert told[-1].startswith("What was finished before is intact. Go on: ")
    assert [row.task for row in read_rows(Path("here") / ROWS)] == ["level1/pick"]


def test_what_our_code_raises_stays_a_bug_whoever_calls_it(folder):
    file = folder / "level1" / "_helper.py"
    file.write_text("def call(function, *arguments):\n    return function(*arguments)\n")
    helper: dict[str, Any] = {}
    exec(compile(file.read_text(), str(file), "exec"), helper)
    with pytest.raises(KeyError, match="velvet"), located_in_play("level1/judged", str(folder)):
        helper["call"](texture, "velvet")
    with (
        pytest.raises(FileMistakeError, match=r"_helper\.py, line 2: ValueError"),
        located_in_play("level1/judged", str(folder)),
    ):
        helper["call"](int, "velvet")
    with pytest.raises(ZeroDivisionError), located_in_play("level1/pick", str(folder)):
        _ = 1 / 0
