"""Gymnasium ids: `labutopia/level1-pick-v0` makes the task `level1/pick`."""

import gymnasium

from labutopia_lerobot.registry import task_files


def gymnasium_id(task_id: str) -> str:
    """Return the Gymnasium id of a task; Gymnasium's ids take one slash only."""
    return f"labutopia/{task_id.replace('/', '-')}-v0"


def register_tasks() -> None:
    """Register every task; what an environment needs is imported when the first is made."""
    for task_id in task_files():
        gymnasium.register(
            gymnasium_id(task_id), "labutopia_lerobot.env:LabEnv", kwargs={"task": task_id}
        )
