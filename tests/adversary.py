"""Playing a task badly on purpose: what the tests of strict judging share."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OnShelf, WhereItStood
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import Place
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.skill import Phase, Skill
from labutopia_lerobot.task import Task
from labutopia_lerobot.world import CONTROL_HZ, FloatArray, World

type Spoil = Callable[[Expert, NDArray[np.float32]], None]
"""Changes an action in place, knowing where the expert is."""

type Choose = Callable[[list[Skill]], list[Skill]]
"""What is played, of the skills that are still to come."""


@dataclass(frozen=True)
class Careless:
    """Play a skill without keeping clear of some things.

    Attributes:
        skill: What is played.
        of: Their contact names.
    """

    skill: Skill
    of: frozenset[str]

    def phases(self, world: World) -> Iterator[Phase]:
        for phase in self.skill.phases(world):
            yield replace(phase, touches=phase.touches | self.of)


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

    It makes no pictures and, unless set otherwise, has a third of the usual particles.
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
    """Play skills from a reset, the task's own by default; return the last info.

    The outcome is "running" where the goal did not hold in the three seconds after the last skill.
    """
    env.reset(seed=seed)
    return _play_out(env, skills or env.workcell.task.skills, spoil)


def play_on(env: LabEnv, seed: int, after: str, choose: Choose) -> dict[str, Any]:
    """Play from behind a step what is chosen of the skills to come; return as `play` does."""
    env.reset(seed=seed, options={"after": after})
    task = env.workcell.task
    done = len([skill for step in task.steps_until(after) for skill in step.skills])
    return _play_out(env, choose(list(task.skills[done:])))


def _play_out(env: LabEnv, skills: Sequence[Skill], spoil: Spoil | None = None) -> dict[str, Any]:
    """Play skills, and wait for three seconds: a goal that holds for two of them has been won."""
    expert = env.workcell.expert(skills)
    expert.start()
    over, left = False, 3 * CONTROL_HZ
    while not over and left:
        left -= bool(expert.finished or expert.failure)
        action = expert.act()
        if spoil is not None:
            spoil(expert, action)
        _, _, terminated, truncated, info = env.step(action)
        over = terminated or truncated
    return info


def moved(place: Place, *, inward: float = 0.0, left: float = 0.0) -> Place:
    """Return a `Place` onto a shelf, some way off [m]."""
    on = place.on
    assert isinstance(on, OnShelf)
    return replace(place, on=replace(on, inward=on.inward + inward, left=on.left + left))


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
