"""`python scripts/make_vocabulary.py`: `docs/vocabulary.md`, all words that a task can be made of.

Everything is read from the package: nothing is listed here but the chapters.
"""

import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from labutopia_lerobot import layout, places, predicates, skills, task, world
from labutopia_lerobot.setting import option_help
from labutopia_lerobot.skills import posture, skill
from labutopia_lerobot.substances import filling
from labutopia_lerobot.tasks import actions, mishaps
from piece_pictures import makers, needs_only_a_name, picture

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "vocabulary.md"
PICTURES = DOCS / "vocabulary"


def main() -> None:
    """Write the page and its pictures."""
    PAGE.write_text(page())
    PICTURES.mkdir(exist_ok=True)
    for file in PICTURES.glob("*.png"):
        file.unlink()
    for make in filter(needs_only_a_name, makers()):
        picture(make("thing")).save(PICTURES / f"{make.__name__}.png", optimize=True)


def page() -> str:
    """Return the page in Markdown."""
    return "\n".join(_chapters()).rstrip() + "\n"


def _chapters() -> Iterator[str]:
    yield "# Vocabulary"
    yield ""
    yield "Made by `python scripts/make_vocabulary.py` from the package; do not edit. How a task"
    yield "is made: [tutorial.md](tutorial.md). Metres and radians, unless a name says else."
    yield "Predicates, skills and pieces of your own may stand in your task file."
    yield ""
    yield from _chapter("Task, step, milestone", "labutopia_lerobot.task")
    for kind in (task.Task, task.Step, task.Milestone, predicates.Predicate, predicates.Count):
        yield from _with_attributes(kind)
    yield "`~fact` is the fact that a predicate does not hold."
    yield ""
    yield from _chapter("Pieces", "labutopia_lerobot", "the modules below of")
    yield from _pieces()
    yield from _chapter("Where pieces start", "labutopia_lerobot.layout")
    for kind in _dataclasses(layout, having="sample"):
        yield from _with_attributes(kind)
    yield from _chapter("What vessels hold", "labutopia_lerobot.substances.filling")
    yield from _with_attributes(filling.Filling)
    yield from _chapter("Places", "labutopia_lerobot.places")
    for kind in _dataclasses(places, having="position_w"):
        yield from _with_attributes(kind)
    yield from _chapter("Actions", "labutopia_lerobot.tasks.actions")
    yield from _functions(f for f in vars(actions).values() if _defined_in(f, actions))
    yield from _chapter("Mishaps", "labutopia_lerobot.tasks.mishaps")
    yield from _functions(f for f in vars(mishaps).values() if _defined_in(f, mishaps))
    yield from _chapter("Predicates", "labutopia_lerobot.predicates")
    yield from _functions(
        fact for name in predicates.__all__ if inspect.isfunction(fact := getattr(predicates, name))
    )
    yield from _chapter("Skills", "labutopia_lerobot.skills")
    for name in skills.__all__:
        yield from _with_attributes(getattr(skills, name))
    yield from _chapter("For predicates of your own: the world", "labutopia_lerobot.world")
    yield from _members(world.World)
    yield from _members(world.Pose)
    yield from _chapter("For skills of your own: phases", "labutopia_lerobot.skills.skill")
    yield from _with_attributes(skill.Phase)
    functions = (f for m in (skill, posture) for f in vars(m).values() if _defined_in(f, m))
    yield from _functions(functions)


def _chapter(title: str, module: str, where: str = "") -> list[str]:
    return [f"## {title}", "", f"From {where}{' ' * bool(where)}`{module}`.", ""]


def _dataclasses(module: ModuleType, having: str) -> list[type]:
    """Return the dataclasses that a module defines and that have a method of this name."""
    members = vars(module).values()
    return [m for m in members if is_dataclass(m) and _defined_in(m, module) and hasattr(m, having)]


def _defined_in(member: Any, module: ModuleType) -> bool:
    public = not getattr(member, "__name__", "_").startswith("_")
    return (
        public
        and callable(member)
        and member.__module__ == module.__name__
        and (inspect.isfunction(member) or is_dataclass(member))
    )


def _functions(functions: Any) -> Iterator[str]:
    """Yield a table of functions."""
    yield "| call | meaning |"
    yield "| --- | --- |"
    for function in functions:
        if inspect.isfunction(function):
            yield f"| {_code(_call(function))} | {_cell(_summary(function))} |"
    yield ""


def _members(kind: type) -> Iterator[str]:
    """Yield a table of what a class can be asked."""
    yield f"`{kind.__name__}`: {_summary(kind)}"
    yield ""
    yield "| ask | answer |"
    yield "| --- | --- |"
    for field in fields(kind) if is_dataclass(kind) else ():
        yield f"| {_code(field.name)} | {_cell(option_help(kind)[field.name])} |"
    for name, member in vars(kind).items():
        if isinstance(member, property):
            yield f"| {_code(name)} | {_cell(_summary(member))} |"
        elif inspect.isfunction(member) and not name.startswith("_"):
            yield f"| {_code(_call(member))} | {_cell(_summary(member))} |"
    yield ""


def _with_attributes(kind: type) -> Iterator[str]:
    """Yield a dataclass with its fields."""
    helps = option_help(kind)
    yield f"### {kind.__name__}"
    yield ""
    yield _summary(kind)
    yield ""
    yield "| argument | default | meaning |"
    yield "| --- | --- | --- |"
    for field in fields(kind):
        argument = _code(f"{field.name}: {_type(field.type)}")
        yield f"| {argument} | {_code(_default(field))} | {_cell(helps.get(field.name, ''))} |"
    yield ""


def _pieces() -> Iterator[str]:
    yield "| | call | meaning | has |"
    yield "| --- | --- | --- | --- |"
    for make in makers():
        image = f"![{make.__name__}](vocabulary/{make.__name__}.png)"
        shown = image if needs_only_a_name(make) else ""
        module = make.__module__.removeprefix("labutopia_lerobot.")
        call = f"{_code(_call(make))}<br>from {_code(module)}"
        parts = ", ".join(map(_code, _parts(make)))
        yield f"| {shown} | {call} | {_cell(_summary(make))} | {parts} |"
    yield ""


def _parts(make: Callable[..., Any]) -> list[str]:
    """Return what a kind of piece has that not every piece has; of a factory nothing: see there."""
    if not inspect.isclass(make):
        return []
    own = {name for kind in make.__mro__[:-1] for name, p in vars(kind).items() if _asked(p)}
    return sorted(name for name in own - set(dir(layout.Piece)) if not name.startswith("_"))


def _asked(member: Any) -> bool:
    return isinstance(member, property | cached_property)


def _call(function: Callable[..., Any]) -> str:
    """Return how a function is called, with the kinds of its arguments and their defaults."""
    parts, keyword_only = [], False
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name == "self":
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not keyword_only:
            keyword_only = True
            parts.append("*")
        default = "" if parameter.default is parameter.empty else f" = {_value(parameter.default)}"
        star = "*" if parameter.kind is parameter.VAR_POSITIONAL else ""
        keyword_only = keyword_only or bool(star)
        parts.append(f"{star}{parameter.name}: {_type(parameter.annotation)}{default}")
    return f"{function.__name__}({', '.join(parts)})"


def _type(annotation: Any) -> str:
    """Return a type without the modules that its names come from."""
    plain = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    short = re.sub(r"\b(?:\w+\.)+(?=\w)", "", plain)
    return short.replace("ndarray[tuple[int, ...], dtype[float64]]", "FloatArray")


def _default(field: Any) -> str:
    if field.default is not MISSING:
        return _value(field.default)
    return "" if field.default_factory is MISSING else "none"


def _value(value: Any) -> str:
    """Return a default as one would type it, or `...` where that would be long."""
    if isinstance(value, tuple) and all(isinstance(item, float) for item in value):
        return f"({', '.join(f'{item:.4g}' for item in value)}{',' * (len(value) == 1)})"
    if isinstance(value, float):
        return f"{value:.4g}"
    return repr(value) if isinstance(value, str | int | tuple | frozenset | None) else "..."


def _summary(member: Any) -> str:
    """Return the first paragraph of a docstring."""
    return " ".join((inspect.getdoc(member) or "").partition("\n\n")[0].split())


def _code(text: str) -> str:
    return f"`{text}`".replace("|", "\\|") if text else ""


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


if __name__ == "__main__":
    main()
