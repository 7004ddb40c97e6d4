"""Files that others made: nothing in them names a place outside their folder, or is of any type.

Datasets, results, checkpoints and rooms come from downloads. Their JSON is read here, checked
against the type that it should have, and what they say of places is joined to a folder here only.
"""

import json
import types
import typing
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, NotRequired

from labutopia_lerobot.errors import UserError

LARGEST_TEXT = 1_000_000_000
"""Bytes of a text file that is read at all; a result of 30 tasks in 1,000 seeds has a tenth."""

_SHOWN = 80
"""Characters of a wrong value that a message repeats."""

_BLOBS, _SNAPSHOTS = "blobs", "snapshots"
"""Folders of the Hugging Face cache: what lies in the second is links into the first."""


def inside(folder: Path, name: str | Path, refusal: type[UserError]) -> Path:
    """Return a file of a folder, wherever links may lead.

    Args:
        folder: The folder.
        name: What the file is called in it.
        refusal: Exception to raise otherwise.

    Raises:
        UserError: Of the kind `refusal`, if it lies elsewhere.
    """
    root = folder.resolve()
    file = folder / name
    homes = [root]
    if root.parent.name == _SNAPSHOTS:
        homes.append(root.parents[1] / _BLOBS)
    try:
        place = file.resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise refusal(f"{_shown(str(name))} of {folder} is no file: {error}") from None
    if not any(place.is_relative_to(home) for home in homes):
        raise refusal(f"{file} is refused: it leads out of {folder}, to {place}")
    return file


def read_text(file: Path, refusal: type[UserError]) -> str:
    """Return what a text file holds.

    Raises:
        UserError: Of the kind `refusal`, if it is no readable file of a reasonable size.
    """
    try:
        if file.exists() and not file.is_file():
            raise refusal(f"{file} cannot be read: it is no file")
        if file.stat().st_size > LARGEST_TEXT:
            raise refusal(f"{file} cannot be read: it has more than {LARGEST_TEXT:,} bytes")
        return file.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise refusal(f"{file} cannot be read: {error}") from None


def parse_json(text: str, source: object, refusal: type[UserError]) -> Any:
    """Return what JSON says.

    Args:
        text: The JSON.
        source: Where it is from, for messages.
        refusal: Exception to raise otherwise.

    Raises:
        UserError: Of the kind `refusal`, if it is no JSON, or nested without end.
    """
    try:
        return json.loads(text)
    except RecursionError:
        raise refusal(f"{source} cannot be read: it is nested too deeply") from None
    except ValueError as error:
        raise refusal(f"{source} cannot be read: it is no JSON ({error})") from None


def read_json[Kind](file: Path, kind: type[Kind], refusal: type[UserError]) -> Kind:
    """Return what a JSON file holds, of a type (see `checked`).

    Raises:
        UserError: Of the kind `refusal`, if it cannot be read or holds something else.
    """
    said = parse_json(read_text(file, refusal), file, refusal)
    content: Kind = checked(kind, said, str(file), refusal)
    return content


def read_json_object(file: Path, refusal: type[UserError]) -> dict[str, Any]:
    """Return the object that a JSON file holds.

    Raises:
        UserError: Of the kind `refusal`, if it cannot be read or holds something else.
    """
    content = parse_json(read_text(file, refusal), file, refusal)
    if not isinstance(content, dict):
        raise refusal(f"{file} is no JSON object")
    return content


def printable(text: str) -> str:
    """Return a text in one line that sends nothing to a terminal but characters."""
    return "".join(c if c.isprintable() else " " for c in text)


def checked(kind: Any, said: Any, where: str, refusal: type[UserError]) -> Any:
    """Return what JSON said as a value of a type.

    Args:
        kind: A dataclass, which knows every key; a `TypedDict`, which may have more; a tuple, list
            or dict of such, a union, `Literal`, plain type or `Any`. Whole numbers pass as `float`.
        said: What `json.loads` returned.
        where: Its place in the file, for messages.
        refusal: Exception to raise otherwise.

    Raises:
        UserError: Of the kind `refusal`, if it is of another type; the message names the place.
    """
    if isinstance(kind, typing.TypeAliasType):
        kind = kind.__value__
    if kind is Any or type(said) is kind:
        return said
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if kind is None or kind is types.NoneType:
        if said is None:
            return None
    elif origin is NotRequired:
        return checked(arguments[0], said, where, refusal)
    elif isinstance(kind, type) and is_dataclass(kind):
        return _dataclass(kind, said, where, refusal)
    elif typing.is_typeddict(kind):
        return _typed_dict(kind, said, where, refusal)
    elif origin in (tuple, list) and isinstance(said, list):
        if origin is list or arguments[-1] is Ellipsis:
            values = (
                checked(arguments[0], one, f"{where}[{n}]", refusal) for n, one in enumerate(said)
            )
            return origin(values)
        if len(said) == len(arguments):
            parts = enumerate(zip(arguments, said, strict=True))
            return tuple(checked(one, part, f"{where}[{n}]", refusal) for n, (one, part) in parts)
    elif origin is dict and isinstance(said, dict):
        return {k: checked(arguments[1], v, f"{where}.{k}", refusal) for k, v in said.items()}
    elif origin is Literal:
        if not isinstance(said, list | dict | bool) and said in arguments:
            return said
    elif origin in (types.UnionType, typing.Union):
        for one in arguments:
            if _fits(one, said):
                return checked(one, said, where, refusal)
    elif kind is float and isinstance(said, int) and not isinstance(said, bool):
        return _float(said, where, refusal)
    raise refusal(f"{where}: {_shown(said)} should be {_wanted(kind)}")


@cache
def types_of(kind: Any) -> dict[str, Any]:
    """Return field -> type of a dataclass or `TypedDict`; to resolve them takes long."""
    return typing.get_type_hints(kind)


def _dataclass(kind: type, said: Any, where: str, refusal: type[UserError]) -> Any:
    if not isinstance(said, Mapping):
        raise refusal(f"{where}: {_shown(said)} should be {_wanted(kind)}")
    hints = types_of(kind)
    known = {field.name: field for field in fields(kind)}
    for key in said:
        if key not in known:
            raise refusal(f"{where}: unknown key '{printable(key)}'. Keys: {', '.join(known)}")
    for key, field in known.items():
        if key not in said and field.default is field.default_factory is MISSING:
            raise refusal(f"{where}: '{key}' is missing")
    return kind(**{key: checked(hints[key], said[key], f"{where}.{key}", refusal) for key in said})


def _typed_dict(kind: Any, said: Any, where: str, refusal: type[UserError]) -> dict[str, Any]:
    if not isinstance(said, dict):
        raise refusal(f"{where}: {_shown(said)} should be {_wanted(kind)}")
    for key in sorted(kind.__required_keys__):
        if key not in said:
            raise refusal(f"{where}: '{key}' is missing")
    hints = types_of(kind)
    return {
        key: checked(hints[key], value, f"{where}.{key}", refusal) if key in hints else value
        for key, value in said.items()
    }


def _fits(kind: Any, said: Any) -> bool:
    """Return whether a value may be meant as a member of a union."""
    if isinstance(kind, typing.TypeAliasType):
        kind = kind.__value__
    plain = typing.get_origin(kind) or kind
    if typing.is_typeddict(kind) or (isinstance(kind, type) and is_dataclass(kind)):
        return isinstance(said, dict)
    if plain is float:
        return isinstance(said, int | float) and not isinstance(said, bool)
    if plain is tuple:
        return isinstance(said, list)
    if plain is Literal:
        return not isinstance(said, list | dict | bool) and said in typing.get_args(kind)
    return said is None if plain in (None, types.NoneType) else type(said) is plain


def _float(said: int, where: str, refusal: type[UserError]) -> float:
    try:
        return float(said)
    except OverflowError:
        raise refusal(f"{where}: {_shown(said)} is too large a number") from None


def _wanted(kind: Any) -> str:
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    names: dict[Any, str] = {
        float: "a number",
        int: "a whole number",
        str: "a text",
        bool: "true or false",
        None: "null",
        types.NoneType: "null",
    }
    if kind in names:
        return names[kind]
    if origin is Literal:
        return f"one of {list(arguments)}"
    if origin in (types.UnionType, typing.Union):
        return " or ".join(map(_wanted, arguments))
    if origin is tuple and arguments[-1] is not Ellipsis:
        return f"{len(arguments)} numbers in brackets"
    return "a list in brackets" if origin in (tuple, list) else "a list of keys in braces"


def _shown(said: object) -> str:
    """Return a value as a message repeats it: in one line, short, without control characters."""
    try:
        text = json.dumps(said, ensure_ascii=False)
    except (RecursionError, TypeError, ValueError):
        text = type(said).__name__
    text = printable(text)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."
