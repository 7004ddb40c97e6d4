"""What must hold for every registered task; a new task adds no test code."""

import pytest

from labutopia_lerobot.checks import CHECKS, Check
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import require_task, task_files


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_it_is_so_that(env: LabEnv, check: Check):
    check(env)


def test_files_are_short():
    for task_id in task_files():
        assert len(require_task(task_id).read_text().splitlines()) <= 120, task_id
