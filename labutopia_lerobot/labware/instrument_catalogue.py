"""Finding instruments: `muffle_furnace` is the class in `instruments/**/muffle_furnace.py`.

There is nothing to register: a module below `labware/instruments/`, in whatever folder, defines one
public frozen dataclass that is a piece and needs nothing but a name.
"""

import difflib
import importlib
import inspect
import pkgutil
from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from types import MappingProxyType, ModuleType
from typing import TYPE_CHECKING

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware import instruments

if TYPE_CHECKING:
    from labutopia_lerobot.labware.piece import Piece

    type Maker = Callable[[str], Piece]
    """Makes an instrument of a name."""


class UnknownInstrumentError(UserError, ValueError):
    """An instrument that does not exist; the message lists those that do."""


class CatalogueError(TypeError):
    """A module that does not define one instrument, or two that define the same."""


@cache
def catalogue() -> "MappingProxyType[str, Maker]":
    """Return what makes each kind of instrument, by kind, in alphabetical order.

    Raises:
        CatalogueError: If a module does not define one instrument, or two have the same name.
    """
    makers: dict[str, Maker] = {}
    for module in pkgutil.walk_packages(instruments.__path__, f"{instruments.__name__}."):
        if not module.ispkg:
            kind = module.name.rpartition(".")[2]
            if kind in makers:
                raise CatalogueError(f"Two modules are called {kind}: rename {module.name}")
            makers[kind] = _instrument_of(importlib.import_module(module.name))
    return MappingProxyType(dict(sorted(makers.items())))


def instrument(kind: str, name: str | None = None) -> "Piece":
    """Return an instrument of a kind.

    Args:
        kind: Such as `muffle_furnace`.
        name: Of its body and prefix of all its elements; as its kind if not said.

    Raises:
        UnknownInstrumentError: If there is none of this kind.
    """
    known = catalogue()
    if kind not in known:
        near = difflib.get_close_matches(kind, known, n=1, cutoff=0.5)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise UnknownInstrumentError(
            f"Unknown instrument '{kind}'.{hint} Instruments: {', '.join(known)}"
        )
    return known[kind](name or kind)


def _instrument_of(module: ModuleType) -> "Maker":
    """Return the one instrument that a module defines."""
    kinds = [
        member
        for name, member in vars(module).items()
        if inspect.isclass(member)
        and member.__module__ == module.__name__
        and not name.startswith("_")
        and hasattr(member, "add_to")
    ]
    if len(kinds) != 1 or not _is_frozen(kinds[0]) or not _needs_only_a_name(kinds[0]):
        raise CatalogueError(
            f"{module.__name__} must define one public frozen dataclass with `add_to` that needs "
            f"nothing but a name; it defines: {', '.join(k.__name__ for k in kinds) or 'none'}"
        )
    maker: Maker = kinds[0]  # type: ignore[assignment]  # tests find what it lacks of one
    return maker


def _is_frozen(kind: type) -> bool:
    return is_dataclass(kind) and bool(vars(kind)["__dataclass_params__"].frozen)


def _needs_only_a_name(kind: type) -> bool:
    needed = [
        field.name
        for field in fields(kind)
        if field.default is MISSING and field.default_factory is MISSING
    ]
    return needed == ["name"]
