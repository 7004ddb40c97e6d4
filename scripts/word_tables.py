"""Tables of words in Markdown, read from signatures and docstrings."""

import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from functools import cached_property
from typing import Any

from labutopia_lerobot import layout
from piece_pictures import makers, needs_only_a_name


def functions(functions: Any) -> Iterator[str]:
    """Yield a table of functions."""
    yield "| call | meaning |"
    yield "| --- | --- |"
    for function in functions:
        if callable(function):
            yield f"| {code(_call(function))} | {cell(_description(function))} |"
    yield ""


def members(kind: type) -> Iterator[str]:
    """Yield a table of what a class can be asked."""
    yield f"### {kind.__name__}"
    yield ""
    yield _description(kind)
    yield ""
    yield "| ask | answer |"
    yield "| --- | --- |"
    for field in fields(kind) if is_dataclass(kind) else ():
        yield f"| {code(field.name)} | {cell(attributes(kind)[field.name])} |"
    for name, member in vars(kind).items():
        if isinstance(member, property):
            yield f"| {code(name)} | {cell(summary(member))} |"
        elif inspect.isfunction(member) and not name.startswith("_"):
            yield f"| {code(_call(member))} | {cell(_description(member))} |"
    yield ""


def attributes(kind: type) -> dict[str, str]:
    """Return what the section `Attributes` of a docstring in Google form says of each."""
    section = (inspect.getdoc(kind) or "").partition("Attributes:\n")[2].partition("\n\n")[0]
    entries = re.findall(r"^ {4}(\w+): (.*(?:\n {8}.*)*)", section, re.MULTILINE)
    return {name: " ".join(text.split()) for name, text in entries}


def with_attributes(kind: type) -> Iterator[str]:
    """Yield a dataclass with its fields."""
    helps = attributes(kind)
    yield f"### {kind.__name__}"
    yield ""
    yield summary(kind)
    yield ""
    yield "| argument | default | meaning |"
    yield "| --- | --- | --- |"
    for field in fields(kind):
        argument = code(f"{field.name}: {_type(field.type)}")
        yield f"| {argument} | {code(_default(field))} | {cell(helps.get(field.name, ''))} |"
    yield ""


def pieces() -> Iterator[str]:
    """Yield a table of everything that makes a piece of labware."""
    yield "| | call | meaning | has |"
    yield "| --- | --- | --- | --- |"
    for make in makers():
        image = f"![{make.__name__}](vocabulary/{make.__name__}.png)"
        shown = image if needs_only_a_name(make) else ""
        module = make.__module__.removeprefix("labutopia_lerobot.")
        call = f"{code(_call(make))}<br>from {code(module)}"
        parts = ", ".join(_parts(make))
        yield f"| {shown} | {call} | {cell(summary(make))} | {parts} |"
    yield ""


def _parts(make: Callable[..., Any]) -> list[str]:
    """Return what a kind of piece has that not every piece has; of a factory, what it makes."""
    if not inspect.isclass(make):
        return [f"as {code(_type(inspect.signature(make).return_annotation))}"]
    return [part for name, part in asks(make).items() if name not in dir(layout.Piece)]


def asks(kind: type) -> dict[str, str]:
    """Return the public properties of a class by name, each as code with its unit, if it has one.

    The unit stands in brackets in the first line of its docstring.
    """
    own = {
        name: f"{code(name)}{_unit(member)}"
        for parent in reversed(kind.__mro__[:-1])
        for name, member in vars(parent).items()
        if _asked(member) and not name.startswith("_")
    }
    return dict(sorted(own.items()))


def _unit(member: Any) -> str:
    """Return the unit of a property, in brackets; of what is called by a name there is none."""
    unit = re.search(r" \[[^]]+\]", summary(member))
    return "" if unit is None or summary(member).startswith("Name") else unit[0]


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


def summary(member: Any) -> str:
    """Return the first paragraph of a docstring."""
    return " ".join((inspect.getdoc(member) or "").partition("\n\n")[0].split())


def _description(member: Any) -> str:
    """Return a docstring before its sections, as one paragraph."""
    return " ".join(re.split(r"\n\n(?=\w+:\n)", inspect.getdoc(member) or "")[0].split())


def code(text: str) -> str:
    """Return text as code that may stand in a table; nothing of nothing."""
    return f"`{text}`".replace("|", "\\|") if text else ""


def cell(text: str) -> str:
    """Return text that may stand in a table."""
    return text.replace("|", "\\|")
