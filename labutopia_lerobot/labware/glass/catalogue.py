"""Finding ware: `glassware("beaker_low", "250 ml")` is a row of the tables in `glass.ware`."""

import difflib
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from labutopia_lerobot.labware.glass.series import Series, UnknownGlasswareError
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.glass.ware import beakers, bottles, dishes, flasks, tubes

_TABLES = (beakers.SERIES, bottles.SERIES, dishes.SERIES, flasks.SERIES, tubes.SERIES)


@cache
def catalogue() -> Mapping[str, Series]:
    """Return every series by its kind, in alphabetical order."""
    series = sorted((one for table in _TABLES for one in table), key=lambda one: one.kind)
    return MappingProxyType({one.kind: one for one in series})


def glassware(kind: str, size: str, name: str | None = None) -> Vessel:
    """Return a vessel of a kind and a size; docs/glassware.md shows all.

    Args:
        kind: Such as `beaker_low`.
        size: Such as "250 ml".
        name: Of its body and prefix of all its elements; as its kind if not said.

    Raises:
        UnknownGlasswareError: There is no such kind, or it has no such size.
    """
    known = catalogue()
    if kind not in known:
        near = difflib.get_close_matches(kind, known, n=1, cutoff=0.5)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        raise UnknownGlasswareError(f"Unknown ware '{kind}'.{hint} Kinds: {', '.join(known)}")
    return known[kind].vessel(size, name or kind)
