"""A plan as text: JSON, one piece a line, the same bytes for the same plan."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, fields
from typing import TYPE_CHECKING, Any

from labutopia_lerobot.scenes.plan import Plan

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

DIGITS = 3
"""Lengths are written to the millimetre."""


def text_of(plan: Plan) -> str:
    """Return a plan as JSON: keys as in `Plan`, what is as usual left out; lengths in mm steps."""
    lines = (f"  {json.dumps(key)}: {_value(value)}" for key, value in _written(plan).items())
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _value(value: Any) -> str:
    """Return a value on one line; a list of things with one thing on each."""
    if isinstance(value, tuple) and value and hasattr(value[0], "__dataclass_fields__"):
        things = ",\n".join(f"    {_line(_written(thing))}" for thing in value)
        return f"[\n{things}\n  ]"
    return _line(value)


def _line(value: Any) -> str:
    return json.dumps(_rounded(value), ensure_ascii=False)


def _written(thing: "DataclassInstance") -> dict[str, Any]:
    """Return the fields of a value that are not as they are when nothing is said."""
    return {
        field.name: value
        for field in fields(thing)
        if (value := getattr(thing, field.name)) != field.default or field.default is MISSING
    }


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, DIGITS) + 0.0  # no -0.0
    if isinstance(value, Mapping):
        return {key: _rounded(part) for key, part in value.items()}
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [_rounded(part) for part in value]
    return value
