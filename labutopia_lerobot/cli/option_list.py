"""The options of a program that takes `name=value`, as its `--help` lists them."""

import inspect
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields
from typing import Any

from labutopia_lerobot.setting import option_help

_WIDTH = 22
"""Columns of `name=default`; what is longer has its explanation on the next line."""


def option_list(options: type, *, prefix: str = "", but: tuple[str, ...] = ()) -> str:
    """Return one entry per field of a dataclass of options: name, default and explanation.

    Args:
        options: The dataclass; those that it declares itself come before those of every program.
        prefix: What the names begin with on the command line, such as `policy.`.
        but: Fields that are left out.
    """
    return "\n".join(_entries(options, prefix, but))


def _entries(options: type, prefix: str, but: tuple[str, ...]) -> Iterator[str]:
    helps = option_help(options)
    declared = {option.name: option for option in fields(options)}
    for name in dict.fromkeys([*inspect.get_annotations(options), *declared]):
        if name in but:
            continue
        option = declared[name]
        shown = f"{prefix}{name}={_default(option)}"
        gap = " " * (_WIDTH - len(shown)) if len(shown) < _WIDTH else f"\n  {' ' * _WIDTH}"
        yield f"  {shown}{gap}{helps[name]}"


def _default(option: Field[Any]) -> str:
    """Return a default as it is typed; nothing where there is none, or it depends."""
    default = option.default if option.default is not MISSING else None
    if option.default_factory is not MISSING:
        default = option.default_factory()
    if isinstance(default, tuple):
        return f"[{','.join(default)}]"
    return "" if default in (None, "???") else str(default)
