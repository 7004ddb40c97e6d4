"""A task in a folder of the user's own, without a line changed anywhere else."""

import subprocess
import sys
from pathlib import Path

import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import UnknownTaskError, load_task, task_files

TASK = '''
"""Lift a flask a little."""

from labutopia_lerobot.labware.glassware import erlenmeyer_flask
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import falling, gripped, lifted
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.task import Substep, Task


def raise_flask() -> Task:
    """Return the task."""
    glass = erlenmeyer_flask("glass", "500 ml")
    return Task(
        instruction="Raise the flask by ten centimetres.",
        start={glass: OnBench(x=(0.22, 0.35), y=(-0.07, 0.07))},
        expert=(Pick(glass, lift=0.15),),
        substeps=(Substep("gripped", (gripped(glass),)),),
        goal=(lifted(glass, by=0.10), gripped(glass)),
        never={"dropped": falling(glass, faster_than=0.5)},
        time_limit_s=15.0,
    )
'''


@pytest.fixture
def tasks_dir(tmp_path: Path) -> Path:
    file = tmp_path / "my_tasks" / "level1" / "raise_flask.py"
    file.parent.mkdir(parents=True)
    file.write_text(TASK)
    return tmp_path / "my_tasks"


def test_a_task_file_in_a_folder_of_ones_own_is_found_beside_the_others(tasks_dir):
    assert set(task_files(tasks_dir)) - set(task_files()) == {"level1/raise_flask"}


def test_its_expert_succeeds_in_the_environment(tasks_dir):
    env = LabEnv("level1/raise_flask", obs="state", tasks_dir=tasks_dir)
    env.reset(seed=0)
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert info["outcome"] == "success"


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


def test_an_empty_folder_is_an_error_that_says_where_tasks_go(tmp_path):
    with pytest.raises(UnknownTaskError, match=r"level1/<name>\.py"):
        load_task("level1/pick", tmp_path)


def test_a_file_without_its_function_is_an_error_that_names_it(tasks_dir):
    (tasks_dir / "level1" / "empty.py").write_text("")
    with pytest.raises(UnknownTaskError, match=r"empty\(\) -> Task"):
        load_task("level1/empty", tasks_dir)


def test_a_task_that_exists_twice_is_an_error(tasks_dir):
    (tasks_dir / "level1" / "pick.py").write_text(TASK)
    with pytest.raises(UnknownTaskError, match="exists twice"):
        task_files(tasks_dir)
