"""Finding ware: `glassware("beaker_low", "250 ml")` is a row of the tables in `glass.ware`.

There is nothing to register: every module of `glass.ware` has a `SERIES`.
"""

import difflib
import importlib
import pkgutil
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from labutopia_lerobot.labware.glass import ware as tables
from labutopia_lerobot.labware.glass.closure import Closure
from labutopia_lerobot.labware.glass.series import (
    ClosureSeries,
    Series,
    UnknownGlasswareError,
    UtensilSeries,
)
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel

type Kind = Series | UtensilSeries
"""A kind of ware: of vessels, of utensils, of closures."""


@cache
def catalogue() -> Mapping[str, Kind]:
    """Return every kind of ware by its name, in alphabetical order.

    Raises:
        TypeError: Two tables have a kind of the same name.
    """
    kinds: dict[str, Kind] = {}
    for module in pkgutil.iter_modules(tables.__path__, f"{tables.__name__}."):
        for series in importlib.import_module(module.name).SERIES:
            if series.kind in kinds:
                raise TypeError(f"Two kinds of ware are called {series.kind}: rename one")
            kinds[series.kind] = series
    return MappingProxyType(dict(sorted(kinds.items())))


@cache
def vessels() -> Mapping[str, Series]:
    """Return every kind of vessel by its name, in alphabetical order."""
    series_of_vessels = {kind: one for kind, one in catalogue().items() if isinstance(one, Series)}
    return MappingProxyType(series_of_vessels)


def glassware(kind: str, size: str, name: str | None = None) -> Vessel:
    """Return a vessel of a kind and a size; docs/glassware.md shows all.

    Args:
        kind: Such as `beaker_low`.
        size: Such as "250 ml".
        name: Of its body and prefix of all its elements; as its kind if not said.

    Raises:
        UnknownGlasswareError: There is no such kind, or it has no such size.
    """
    return _known(kind, vessels()).vessel(size, name or kind)


def ware(kind: str, size: str, name: str | None = None) -> Vessel | Utensil:
    """Return a piece of any kind of ware; see `glassware`, which makes the vessels."""
    return _known(kind, catalogue()).make(size, name or kind)


def closed(kind: str, size: str, name: str | None = None) -> tuple[Vessel, Closure]:
    """Return a vessel and the closure that it comes with, called `<name>_closure`.

    The closure goes onto it in `Inside(vessel, at=(0, 0, closure.seat(vessel)))`.

    Raises:
        UnknownGlasswareError: There is no such vessel, or it comes without a closure.
    """
    vessel = glassware(kind, size, name)
    closure = vessels()[kind].closure
    if not closure:
        with_one = ", ".join(one.kind for one in vessels().values() if one.closure)
        raise UnknownGlasswareError(
            f"{kind} comes without a closure; kinds that come with one: {with_one}"
        )
    series = catalogue()[closure]
    assert isinstance(series, ClosureSeries)
    return vessel, series.fitting(vessel, f"{vessel.name}_closure")


def _known[K: Kind](kind: str, known: Mapping[str, K]) -> K:
    if kind not in known:
        near = difflib.get_close_matches(kind, known, n=1, cutoff=0.5)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise UnknownGlasswareError(f"Unknown ware '{kind}'.{hint} Kinds: {', '.join(known)}")
    return known[kind]
