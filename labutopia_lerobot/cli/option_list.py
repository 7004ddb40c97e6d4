"""The options of a program that takes `name=value`, as its `--help` lists them."""

from collections.abc import Iterator
from dataclasses import MISSING, Field
from typing import Any

from labutopia_lerobot.setting import option_help, options_of

_WIDTH = 22
"""Columns of `name=default`; what is longer has its explanation on the next line."""


def option_list(options: type, *, prefix: str = "", but: tuple[str, ...] = ()) -> str:
    """Return one entry per field of a dataclass of options: name, default and explanation.

    Args:
        options: The dataclass; `option_help` explains every field.
        prefix: What the names begin with on the command line, such as `policy.`.
        but: Fields that are left out.
    """
    return "\n".join(_entries(options, prefix, but))


def _entries(options: type, prefix: str, but: tuple[str, ...]) -> Iterator[str]:
    helps = option_help(options)
    for option in options_of(options):
        if option.name in but:
            continue
        shown = f"{prefix}{option.name}={_default(option)}"
        gap = " " * (_WIDTH - len(shown)) if len(shown) < _WIDTH else f"\n  {' ' * _WIDTH}"
        yield f"  {shown}{gap}{helps[option.name]}"


def _default(option: Field[Any]) -> str:
    """Return a default as it is typed; nothing where there is none, or it depends."""
    default = option.default if option.default is not MISSING else None
    if option.default_factory is not MISSING:
        default = option.default_factory()
    if isinstance(default, tuple):
        return f"[{','.join(default)}]"
    return "" if default in (None, "???") else str(default)
