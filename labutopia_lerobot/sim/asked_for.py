"""Whether the instruments that a task reads stand in it."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.processes import Process
from labutopia_lerobot.task import Task, TaskError


def require_readings(task_id: str, task: Task) -> None:
    """Make sure, before anything is compiled, that every reading that is asked for can be had.

    Args:
        task_id: What the task is called.
        task: The task.

    Raises:
        TaskError: A fact or a skill reads an instrument that does not stand in the task.
    """
    given = {process.name for piece in task.start for process in piece.processes}
    for name, asker in _asked(task):
        if name not in given:
            raise TaskError(
                f"{task_id}: {asker} asks what '{name}' reads, which nothing in the `start` has. "
                "Put the instrument that it belongs to there. What can be read in this task: "
                f"{', '.join(sorted(given)) or 'nothing'}"
            )


def _asked(task: Task) -> Iterator[tuple[str, str]]:
    """Yield the name of every reading that facts and skills mention, and who does."""
    for fact in task.facts.values():
        yield from ((name, f"the fact '{fact.name}'") for name in _readings_in(fact))
    for skill in (*task.setup, *task.skills):
        yield from ((name, f"the skill {type(skill).__name__}") for name in _readings_in(skill))


def _readings_in(value: object) -> Iterator[str]:
    """Yield the names of the processes within a fact, a skill or a part of one."""
    if isinstance(value, Process):
        yield value.name
    elif isinstance(value, Predicate):
        yield from _readings_in(value.about)
    elif isinstance(value, tuple):
        for part in value:
            yield from _readings_in(part)
    elif is_dataclass(value) and not isinstance(value, type):
        yield from _readings_in(tuple(getattr(value, one.name) for one in fields(value)))
