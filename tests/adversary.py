"""Playing a task badly on purpose: what the tests of strict judging share."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import WhereItStood
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.task import Task
from labutopia_lerobot.world import FloatArray, World

type Spoil = Callable[[Expert, NDArray[np.float32]], None]
"""Changes an action in place, knowing where the expert is."""


@dataclass(frozen=True)
class Beside(WhereItStood):
    """A point ahead of where a thing stood.

    Attributes:
        ahead: By how much [m].
    """

    ahead: float = 0.05

    def position_w(self, world: World) -> FloatArray:
        point: FloatArray = super().position_w(world) + np.array([self.ahead, 0.0, 0.0])
        return point


def begun(task: str, **options: Any) -> LabEnv:
    """Return an environment in which an episode has begun.

    It makes no pictures and, unless told otherwise, has a third of the usual particles.
    """
    env = LabEnv(Setting(task, obs="state", **({"particles": 300} | options)))
    env.reset(seed=0)
    return env


def begun_with(task_id: str, task: Task, monkeypatch: pytest.MonkeyPatch, **options: Any) -> LabEnv:
    """Return an environment, without pictures, of a task that no file holds; an episode has begun.

    Args:
        task_id: The task whose place it takes.
        task: What is played.
        monkeypatch: Of the test.
        **options: Fields of `Setting`.
    """
    found = "labutopia_lerobot.scenario.scenario.task_function"
    monkeypatch.setattr(found, lambda task_id, tasks_dir: lambda draw: task)
    return begun(task_id, **options)


def play(env: LabEnv, *skills: Skill, spoil: Spoil | None = None, seed: int = 5) -> dict[str, Any]:
    """Play skills from a reset, the task's own by default; return the last info."""
    env.reset(seed=seed)
    expert = Expert(skills or env.workcell.task.skills, env.workcell.world, env.workcell.motion)
    expert.start()
    over = False
    while not over:
        action = expert.act()
        if spoil is not None:
            spoil(expert, action)
        _, _, terminated, truncated, info = env.step(action)
        over = terminated or truncated
    return info


def turning(by: float, *phases: str, joint: int = 6) -> Spoil:
    """Return what turns a joint slowly in some phases, and keeps it turned.

    Args:
        by: How far [rad].
        *phases: Labels of the phases.
        joint: Which joint; the last one rolls the hand.
    """
    held: list[NDArray[np.float32]] = []

    def spoil(expert: Expert, action: NDArray[np.float32]) -> None:
        if expert.label in phases:
            held.append(held[0] if held else action.copy())
            action[:-1] = held[0][:-1]  # or the other joints would make up for it
            action[joint] += np.clip(0.03 * len(held), 0.0, by)

    return spoil
