"""An episode before it is played: a task and a look of the room, drawn from a seed."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from labutopia_lerobot.chemistry.kept_answers import KeptAnswers, KeptAnswersError, load_answers
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.layout import require_drivable, require_in_every_room, rooms_for
from labutopia_lerobot.robots import ROBOTS, load_robot
from labutopia_lerobot.scenario.draw import Draw, Value
from labutopia_lerobot.scenario.task_function import task_function
from labutopia_lerobot.scenario.variation import (
    Variation,
    draw_ambient,
    draw_instruction,
    draw_variation,
)
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import ALL, DEFAULT_ROOM, Setting
from labutopia_lerobot.task import Task

_OF_ARMS_ALONE = ("level3/", "level4/")
"""Levels whose tasks are of an arm on its stand; those of the first two a robot with a base plays
too, standing still. Ours: no expert with a base has been measured in these."""


class NeedsBaseError(UserError, ValueError):
    """A task in which one drives, and a robot that cannot; the message lists those that can."""


class ArmsAloneError(UserError, ValueError):
    """A task of arms alone, and a robot with a base; the message lists those without one."""


@dataclass(frozen=True)
class Scenario:
    """The draws of an episode.

    Attributes:
        task: The task.
        variation: What varies around it.
        drawn: Axis -> value, for `info`, rows and datasets.
    """

    task: Task
    variation: Variation
    drawn: Mapping[str, Value] = field(default_factory=dict)


def scenario_seeds(setting: Setting, seed: int, attempt: int = 0) -> list[int]:
    """Return the seeds of everything random in an episode.

    Args:
        setting: Task, split and the other options; tasks and splits never share a scene.
        seed: Seed of the episode.
        attempt: How many starts of this episode have been discarded.
    """
    names = [zlib.crc32(word.encode()) for word in (setting.task, setting.split)]
    return [seed, *names, attempt]


def draw_scenario(setting: Setting, seed: int, attempt: int = 0) -> Scenario:
    """Draw what the episode of a seed is.

    Raises:
        AxisError: If the task declares an axis wrongly.
        UnknownOptionError: If the task does not have the axes of the setting.
    """
    return _scenario(
        setting, Draw(setting.split, setting.axes, scenario_seeds(setting, seed, attempt))
    )


def canonical_task(setting: Setting) -> Task:
    """Return the task with the first value on every axis: names and widths are those of all draws.

    Raises:
        ArmsAloneError: If the task is one of arms alone, of level 3 or 4, and the robot has a base.
        AxisError: If the task declares an axis wrongly.
        KeptAnswersError: If the reasoner is a file without the answers that the task needs.
        NeedsBaseError: If one drives in the task, and the robot cannot.
        NowhereToDriveError: If one does, and the room has not the benches for it.
        TaskError: If the task does not have the step of the setting.
        UnknownOptionError: If the task does not have the axes of the setting.
        UnknownRoomError: If there is no such room.
    """
    room = load_room(setting.room)  # it must be one that can be played in
    task = _scenario(setting, Draw(setting.split, setting.axes)).task
    base = load_robot(setting.robot).base
    if task.drives and base is not None:
        if setting.room == DEFAULT_ROOM:
            require_in_every_room(task.start)
        else:
            require_drivable(task.start, room.ground(base), setting.room)
    if setting.step is not None:
        task.steps_until(setting.step)
    answers = load_answers(setting.reasoner)
    if answers is not None:
        _require_answered(setting, task, answers)
    return task


def _scenario(setting: Setting, draw: Draw) -> Scenario:
    task, variation = _drawn(setting, draw)
    if setting.liquid == "off":
        task = task.without_liquid(setting.task)
    draw.require_axes(setting.task, lambda: _axes(setting))
    return Scenario(task, variation, draw.values)


def _drawn(setting: Setting, draw: Draw) -> tuple[Task, Variation]:
    task = task_function(setting.task, setting.tasks_dir)(draw)
    robot = load_robot(setting.robot)
    robot.meshes.require()
    _require_fit(setting, task)
    if task.drives and setting.room == DEFAULT_ROOM:  # nobody has chosen one
        draw.vary("room", shifted=True)
    drives_in = rooms_for(task.start) if task.drives else None
    variation = draw_variation(draw, len(robot.arm), drives_in=drives_in)
    variation = replace(variation, ambient=draw_ambient(draw, task))
    instruction = draw_instruction(draw, task)
    if instruction != task.instruction:
        task = replace(task, instruction=instruction)
    return task, variation


def _require_answered(setting: Setting, task: Task, answers: KeptAnswers) -> None:
    """Refuse answers where nothing can react, and those to other questions than the task has."""
    held = [filling.compounds for filling in task.contents.values()]
    if not any(held):
        raise KeptAnswersError(
            f"reasoner={setting.reasoner}: nothing is dissolved in {setting.task}, so that nothing "
            "reacts. Leave reasoner= out"
        )
    if missing := answers.unanswered(held):
        raise KeptAnswersError(
            f"reasoner={setting.reasoner} has no answer about {' and '.join(missing[0])} of "
            f"{setting.task}. Ask for it: labutopia-chem ask {setting.task} --out FILE.json"
        )


def _require_fit(setting: Setting, task: Task) -> None:
    """Refuse a robot that cannot drive where one drives, and a base where arms alone play."""
    mobile = load_robot(setting.robot).base is not None
    if task.drives and not mobile:
        raise NeedsBaseError(
            f"robot={setting.robot} is mounted on a stand, and in {setting.task} one drives. "
            f"Choose from: {_robots(mobile=True)}"
        )
    if mobile and not task.drives and setting.task.startswith(_OF_ARMS_ALONE):
        raise ArmsAloneError(
            f"robot={setting.robot} has a base, and {setting.task} is a task of arms alone. "
            f"Choose from: {_robots(mobile=False)}"
        )


def _robots(*, mobile: bool) -> str:
    return ", ".join(n for n, robot in ROBOTS.items() if (robot.base is not None) == mobile)


def _axes(setting: Setting) -> Mapping[str, bool]:
    """Return every axis of a task, and whether `ood` can shift it."""
    everything = Draw(axes=(ALL,))
    _drawn(setting, everything)
    return everything.axes
