"""Gymnasium ids: `labutopia/level1-pick-v0` makes the task `level1/pick`.

With another robot than the paper's, its name stands before: `labutopia/<robot>-level1-pick-v0`.
"""

import warnings
from typing import TYPE_CHECKING, Any

import gymnasium

from labutopia_lerobot.registry import UnknownTaskError, task_files
from labutopia_lerobot.setting import OF_THE_LEVEL, ROBOT_NAMES, robot_of_level, setting_from

if TYPE_CHECKING:
    from labutopia_lerobot.env import LabEnv


def gymnasium_id(task_id: str, robot: str = OF_THE_LEVEL) -> str:
    """Return the Gymnasium id of a task and a robot; Gymnasium's ids take one slash only."""
    before = "" if robot in (OF_THE_LEVEL, robot_of_level(task_id)) else f"{robot}-"
    return f"labutopia/{before}{task_id.replace('/', '-')}-v0"


def register_tasks() -> None:
    """Register every task and robot; what they need is imported when the first is made.

    Tasks that clash, of installed packages, are reported when one is asked for, not by the import.
    """
    try:
        tasks = task_files()
    except UnknownTaskError as error:
        warnings.warn(f"No Gymnasium id is registered. {error}", stacklevel=2)
        return
    for task_id in tasks:
        for robot in ROBOT_NAMES:
            options = {"task": task_id, "robot": robot}
            gymnasium.register(gymnasium_id(task_id, robot), make_env, kwargs=options)


def make_env(render_mode: str = "rgb_array", **options: Any) -> "LabEnv":
    """Return the environment of some options, which are the fields of `Setting`.

    Raises:
        UnknownOptionError: If there is no such option, or a value is impossible.
        UnknownTaskError: If there is no such task.
    """
    from labutopia_lerobot.env import LabEnv  # here: it imports mujoco

    return LabEnv(setting_from(options), render_mode)
