"""Kinds of laboratories: `organic` is the family in `organic.py`; there is nothing to register."""

import difflib
import importlib
import pkgutil
from functools import cache
from types import MappingProxyType

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.generation.family import Family


class UnknownFamilyError(UserError, ValueError):
    """A family that does not exist; the message lists those that do."""


@cache
def families() -> "MappingProxyType[str, Family]":
    """Return every family by its name, in alphabetical order."""
    names = sorted(module.name for module in pkgutil.iter_modules(__path__))
    family_of = {name: importlib.import_module(f"{__name__}.{name}").FAMILY for name in names}
    return MappingProxyType(family_of)


def family(name: str) -> Family:
    """Return a family.

    Raises:
        UnknownFamilyError: If there is none of this name.
    """
    known = families()
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise UnknownFamilyError(f"Unknown family '{name}'.{hint} Families: {', '.join(known)}")
    return known[name]
