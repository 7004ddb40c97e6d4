"""Fixtures of the suite: every test here runs over every registered task."""

import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import Setting

TASKS = list(task_files())


@pytest.fixture(params=TASKS, scope="module", ids=lambda task: task.replace("/", "-"))
def env(request: pytest.FixtureRequest) -> LabEnv:
    """One environment per task, without pictures, and with a third of the usual particles."""
    return LabEnv(Setting(request.param, obs="state", particles=300))
