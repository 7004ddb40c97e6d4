"""Reading a plan: what is wrong in a file is told by its place in it."""

import json
import types
import typing
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any, Literal

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.finishes import FLOOR_FINISHES, WALL_FINISHES
from labutopia_lerobot.scenes.plan import Plan


class PlanError(UserError, ValueError):
    """A room that cannot be; the message names what is wrong and where."""


def read_plan(path: Path) -> Plan:
    """Return the plan in a file; whether it can be furnished so, `proof.faults` tells.

    Raises:
        PlanError: If it cannot be read, is no plan, or names what does not exist.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise PlanError(f"{path} cannot be read: {error}") from error
    return plan_from(text, str(path))


def plan_from(text: str, source: str) -> Plan:
    """Return the plan that a text describes.

    Args:
        text: JSON, as `text_of` writes it.
        source: Where it is from, for messages.

    Raises:
        PlanError: If it is no plan, or names what does not exist.
    """
    try:
        said = json.loads(text)
    except json.JSONDecodeError as error:
        raise PlanError(f"{source} is no JSON: {error}") from error
    plan: Plan = _value(Plan, said, source)
    _check_names(plan, source)
    return plan


def _check_names(plan: Plan, source: str) -> None:
    from labutopia_lerobot.labware.catalogue import catalogue, instrument  # here: mujoco

    for look, finishes in (("floor", FLOOR_FINISHES), ("wall", WALL_FINISHES)):
        if (name := getattr(plan, look)) not in finishes:
            raise PlanError(f"{source}: {look} '{name}' is unknown. Choose: {', '.join(finishes)}")
    known: set[str] = set()
    for place, piece in enumerate(plan.pieces):
        where = f"{source}, pieces[{place}]"
        if piece.kind not in catalogue():
            try:
                instrument(piece.kind)
            except UserError as error:
                raise PlanError(f"{where}: {error}") from error
        if piece.name in known:
            raise PlanError(f"{where}: the name '{piece.name}' is taken; give it another")
        if piece.on is not None and piece.on not in known:
            raise PlanError(
                f"{where}: '{piece.name}' stands on '{piece.on}', which is no piece before it"
            )
        known.add(piece.name)
    benches = {piece.name for piece in plan.pieces if piece.kind == "work_bench"}
    for number, work in enumerate(plan.work_places):
        if work.bench not in benches:
            raise PlanError(
                f"{source}, work_places[{number}]: '{work.bench}' is no work bench of this room; "
                f"it has: {', '.join(sorted(benches)) or 'none'}"
            )
    if not any(opening.kind == "door" for opening in plan.openings[:1]):
        raise PlanError(f"{source}: the first of openings must be the door by which one enters")


def _value(kind: Any, said: Any, where: str) -> Any:
    """Return what was said as a value of a type: a dataclass, tuple, literal or plain value."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if isinstance(kind, type) and is_dataclass(kind):
        return _thing(kind, said, where)
    if origin is tuple and isinstance(said, list):
        if arguments[-1] is Ellipsis:
            return tuple(_value(arguments[0], one, f"{where}[{n}]") for n, one in enumerate(said))
        if len(said) == len(arguments):
            parts = enumerate(zip(arguments, said, strict=True))
            return tuple(_value(one, part, f"{where}[{n}]") for n, (one, part) in parts)
    elif origin is Literal and said in arguments and not isinstance(said, bool):
        return said
    elif origin is types.UnionType:
        return None if said is None else _value(arguments[0], said, where)
    elif kind is float and isinstance(said, int | float) and not isinstance(said, bool):
        return float(said)
    elif isinstance(kind, type) and type(said) is kind:
        return said
    wanted = f"one of {list(arguments)}" if origin is Literal else _spelt(kind)
    raise PlanError(f"{where}: {json.dumps(said)} should be {wanted}")


def _thing(kind: type, said: Any, where: str) -> Any:
    """Return a dataclass from what was said of its fields."""
    if not isinstance(said, Mapping):
        raise PlanError(f"{where}: {json.dumps(said)} should be {_spelt(kind)}")
    types_of = typing.get_type_hints(kind)
    known = {field.name: field for field in fields(kind)}
    for key in said:
        if key not in known:
            raise PlanError(f"{where}: unknown key '{key}'. Keys: {', '.join(known)}")
    for key, field in known.items():
        if key not in said and field.default is MISSING:
            raise PlanError(f"{where}: '{key}' is missing")
    where = f"{where}, " if kind is Plan else f"{where}."
    return kind(**{key: _value(types_of[key], said[key], f"{where}{key}") for key in said})


def _spelt(kind: Any) -> str:
    names = {float: "a number", int: "a whole number", str: "a text"}
    if kind in names:
        return names[kind]
    arguments = typing.get_args(kind)
    if arguments and arguments[-1] is not Ellipsis:
        return f"{len(arguments)} numbers in brackets"
    return "a list in brackets" if arguments else "a list of keys in braces"
