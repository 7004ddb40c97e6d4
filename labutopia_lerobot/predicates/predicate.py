"""A named fact about the world, and how a function becomes one.

    @predicate("{thing} lifted by {by:g} m")
    def lifted(world: World, thing: Thing, *, by: float) -> bool:
        return bool(world.pose(thing).position_w[2] - world.bench_height > by)

`lifted(flask, by=0.2)` is the fact "flask lifted by 0.2 m". Judging goes by names, so the name of a
predicate shows every argument that its function takes: a template that lacks one is refused.
"""

import functools
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from string import Formatter
from types import MappingProxyType
from typing import Any, Concatenate

from labutopia_lerobot.world import World

type Arguments = tuple[tuple[Any, ...], Mapping[str, Any]]
"""Positional arguments, and the others by their names."""

_NO_ARGUMENTS: Arguments = ((), MappingProxyType({}))


class PredicateNameError(TypeError):
    """A predicate whose name does not show every argument; the message names those it lacks."""


@dataclass(frozen=True)
class Predicate:
    """A yes-or-no question about the present world.

    Two predicates are equal if they ask the same function with equal arguments.

    Attributes:
        name: How the fact appears in `info["facts"]` and in result files.
        question: Answers for a world and the arguments.
        arguments: What the question is about.
        measure: By how much the world misses what is asked for at its best, unit -> amount (`mm`,
            `deg`, `ml`), whether the fact holds or not; None where nothing is measured. It decides
            nothing: `labutopia-view` shows it of what did not hold, result rows have it.
        explain: What makes it hold just now, in words, for a person who looks at a failure.
        approach: How near the world has come to it, from 0 to 1; only `reward=dense` asks.
    """

    name: str
    question: Callable[..., bool]
    arguments: Arguments = _NO_ARGUMENTS
    measure: Callable[..., Mapping[str, float]] | None = field(default=None, compare=False)
    explain: Callable[..., str] | None = field(default=None, compare=False)
    approach: Callable[..., float] | None = field(default=None, compare=False)

    @property
    def about(self) -> tuple[object, ...]:
        """Everything among its arguments, without their names."""
        positional, named = self.arguments
        return (*positional, *named.values())

    def holds(self, world: World) -> bool:
        """Return the answer for a world."""
        positional, named = self.arguments
        return self.question(world, *positional, **named)

    def errors(self, world: World) -> Mapping[str, float]:
        """Return by how much a world misses what is asked for, unit -> amount."""
        positional, named = self.arguments
        return {} if self.measure is None else self.measure(world, *positional, **named)

    def reason(self, world: World) -> str:
        """Return what makes it hold just now, in words; empty if there is nothing to say."""
        positional, named = self.arguments
        return "" if self.explain is None else self.explain(world, *positional, **named)

    def nearness(self, world: World) -> float | None:
        """Return how near a world has come to it, from 0 to 1; None where nobody knows."""
        positional, named = self.arguments
        return None if self.approach is None else self.approach(world, *positional, **named)

    def __invert__(self) -> "Predicate":
        """Return the fact that this one does not hold: `~gripped(flask)`."""
        return Predicate(f"not ({self.name})", _neither, ((self,), {}))

    def __and__(self, other: "Predicate") -> "Predicate":
        """Return the fact that both hold."""
        return Predicate(f"{self.name} and {other.name}", _both, ((self, other), {}))

    def __or__(self, other: "Predicate") -> "Predicate":
        """Return the fact that this one holds, or the other, or both."""
        return Predicate(f"{self.name} or {other.name}", _either, ((self, other), {}))


def _neither(world: World, fact: Predicate) -> bool:
    return not fact.holds(world)


def _both(world: World, first: Predicate, second: Predicate) -> bool:
    return first.holds(world) and second.holds(world)


def _either(world: World, first: Predicate, second: Predicate) -> bool:
    return first.holds(world) or second.holds(world)


class PredicateFunction[**P]:
    """Makes predicates, one for each set of arguments; see `predicate`.

    Args:
        template: The name, with a field for every argument.
        question: Answers for a world and the arguments.

    Raises:
        PredicateNameError: If the template lacks an argument, or has a field that is none.
    """

    def __init__(self, template: str, question: Callable[Concatenate[World, P], bool]) -> None:
        functools.update_wrapper(self, question)
        self._template, self._question = template, question
        self._measure: Callable[Concatenate[World, P], Mapping[str, float]] | None = None
        self._explain: Callable[Concatenate[World, P], str] | None = None
        self._approach: Callable[Concatenate[World, P], float] | None = None
        _, *parameters = inspect.signature(question).parameters.values()
        self.__signature__ = inspect.Signature(parameters, return_annotation=Predicate)
        shown = {name for _, name, _, _ in Formatter().parse(template) if name is not None}
        taken = set(self.__signature__.parameters)
        if shown != taken:
            raise PredicateNameError(
                f"The name of {question.__name__}, '{template}', must show every argument and "
                f"nothing else. It lacks: {', '.join(sorted(taken - shown)) or 'nothing'}. It has "
                f"too much: {', '.join(sorted(shown - taken)) or 'nothing'}"
            )

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> Predicate:
        """Return the fact about these arguments."""
        bound = self.__signature__.bind(*args, **kwargs)
        bound.apply_defaults()
        arguments = bound.args, bound.kwargs
        name = _filled_in(self._template, bound.arguments)
        hooks = self._measure, self._explain, self._approach
        return Predicate(name, self._question, arguments, *hooks)

    def measure(
        self, function: Callable[Concatenate[World, P], Mapping[str, float]]
    ) -> Callable[Concatenate[World, P], Mapping[str, float]]:
        """Let a function of the same arguments be `Predicate.measure`; decorates it."""
        self._measure = function
        return function

    def explain(
        self, function: Callable[Concatenate[World, P], str]
    ) -> Callable[Concatenate[World, P], str]:
        """Let a function of the same arguments be `Predicate.explain`; decorates it."""
        self._explain = function
        return function

    def approach(
        self, function: Callable[Concatenate[World, P], float]
    ) -> Callable[Concatenate[World, P], float]:
        """Let a function of the same arguments be `Predicate.approach`; decorates it."""
        self._approach = function
        return function


def predicate[**P](
    template: str,
) -> Callable[[Callable[Concatenate[World, P], bool]], PredicateFunction[P]]:
    """Make predicates of a function of the world and of arguments; decorates it.

    Args:
        template: The name, with a field for every argument. Things and places are shown by their
            names, several of them joined by "or". The format `percent` shows a share in per cent;
            `of part` shows a joint position in the unit of the argument `part`.
    """
    return lambda question: PredicateFunction(template, question)


def _filled_in(template: str, arguments: Mapping[str, Any]) -> str:
    words = []
    for literal, name, spec, _ in Formatter().parse(template):
        words.append(literal)
        if name is not None:
            words.append(_shown(arguments[name], spec or "", arguments))
    return "".join(words)


def _shown(value: Any, spec: str, arguments: Mapping[str, Any]) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, frozenset):
        return _shown(tuple(sorted(value)), spec, arguments)
    if isinstance(value, tuple):
        return " or ".join(_shown(item, spec, arguments) for item in value) or "nothing"
    if spec == "percent":
        return f"{100 * value:g} %"
    if spec.startswith("of "):
        return str(arguments[spec.removeprefix("of ")].format_position(value))
    return str(getattr(value, "name", None) or format(value, spec))
