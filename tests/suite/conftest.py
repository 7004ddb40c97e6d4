"""Fixtures of the suite: every test here runs over every registered task."""

from typing import Any

import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.setting import Setting


def _environments() -> list[Any]:
    """Return task and liquid; what takes long, level 4 with liquid, is `make test-slow`.

    The checks of a task stay in one process, where several look at one episode (`checks.playing`).
    """
    found = []
    for task in task_files():
        long, name = task.startswith("level4/"), task.replace("/", "-")
        together = pytest.mark.xdist_group(name)
        marks = [together, pytest.mark.slow] if long else [together]
        found.append(pytest.param((task, "on"), marks=marks, id=name))
        if long:
            found.append(pytest.param((task, "off"), marks=together, id=f"{name}-dry"))
    return found


@pytest.fixture(params=_environments(), scope="module")
def env(request: pytest.FixtureRequest) -> LabEnv:
    """One environment per task, without pictures, and with a third of the usual particles."""
    task, liquid = request.param
    return LabEnv(Setting(task, obs="state", particles=300, liquid=liquid))
