"""Precision of an episode, beside its success; it is measured and decides nothing."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Any

import numpy as np

from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.task import Step, Task
from labutopia_lerobot.world import ARM, BASE, BENCH, HAND, LEFT_PAD, RIGHT_PAD, World

_FINGERS = (HAND, LEFT_PAD, RIGHT_PAD)
_ROBOT = frozenset({ARM, BASE, *_FINGERS})


class Precision:
    """Measures one episode through the same world as the judges; `note` it after every step.

    Places and directions are those of the goal, at the end of the episode. Volumes are those of the
    steps, each when it is done, since its vessel may be emptied again later, or else at the end.

    What should not touch: the arm and anything; hand or pads and the bench, the room, a distractor
    or what does not move of an instrument (bottles are there to be squeezed); a thing of the task
    and the room or a distractor.

    Args:
        task: The played task.
        world: Where.
    """

    def __init__(self, task: Task, world: World) -> None:
        self._task, self._world = task, world
        self._fixed = frozenset(
            piece.name
            for piece in task.start
            if not piece.movable and not isinstance(piece, Dispenser)
        )
        docks = world.floor.docks if task.drives else ()
        self._benches = frozenset({BENCH, *(dock.bench for dock in docks)})
        self._volumes: dict[str, list[float]] = {}
        self._contacts: Counter[str] = Counter()

    def note(self, substeps: Mapping[str, float]) -> None:
        """Look at the world after a control step.

        Args:
            substeps: Time at which every substep latched [s]; infinite before.
        """
        for step in self._task.steps:
            if step.name not in self._volumes and np.isfinite(substeps[step.substeps[-1].name]):
                self._volumes[step.name] = self._misses(_facts(step), "ml")
        self._contacts.update(f"{first} and {second}" for first, second in self._unwanted())

    @property
    def columns(self) -> dict[str, Any]:
        """The columns of the row, as of now."""
        undone = (step for step in self._task.steps if step.name not in self._volumes)
        volumes = [*self._volumes.values(), *(self._misses(_facts(step), "ml") for step in undone)]
        return {
            "ml_off_target": _worst([*chain(*volumes)]),
            "mm_off_place": _worst(self._misses(self._task.goal, "mm")),
            "deg_off_place": _worst(self._misses(self._task.goal, "deg")),
            "unwanted_contacts": dict(sorted(self._contacts.items())),
        }

    def _misses(self, facts: Iterable[Predicate], unit: str) -> list[float]:
        """Return by how much the world misses what facts ask for, in one unit."""
        misses = (fact.errors(self._world) for fact in facts)
        return [miss[unit] for miss in misses if unit in miss]

    def _unwanted(self) -> Iterator[tuple[str, str]]:
        """Yield what touches now though it should not, each pair once."""
        for part in (ARM, BASE):
            for other in self._world.touched_by(part) - _ROBOT:
                yield part, other
        fingers = frozenset(chain(*map(self._world.touched_by, _FINGERS)))
        for other in fingers - _ROBOT:
            if other in self._fixed or not self._belongs_to_the_task(other):
                yield HAND, other
        for piece in self._task.start:
            for other in self._world.touched_by(piece.name) - _ROBOT - self._benches:
                if not self._belongs_to_the_task(other):
                    yield piece.name, other

    def _belongs_to_the_task(self, name: str) -> bool:
        """Return whether a body is one of a thing's: the name of each starts with the thing's."""
        return any(f"{name}_".startswith(f"{piece.name}_") for piece in self._task.start)


def _facts(step: Step) -> Iterator[Predicate]:
    return (fact for substep in step.substeps for fact in substep.when)


def _worst(amounts: list[float]) -> float | None:
    return round(max(amounts), 3) if amounts else None
