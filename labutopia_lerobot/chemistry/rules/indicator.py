"""Indicators: weak acids whose two forms differ in colour.

Source of the rule: Harris, Quantitative Chemical Analysis, acid-base indicators. The pKa are those
of the table of substances; the bands of both forms are in `data/species.json`.
"""

from collections.abc import Mapping, Sequence

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network

KIND = "indicator"


def changes(
    compounds: Sequence[Compound], before: Mapping[str, float], after: Mapping[str, float]
) -> list[Change]:
    """Return how each indicator shows the acidity; empty for one that stays in the form it had."""
    made = network()
    shown = []
    for one in compounds:
        if "indicator" not in one.reactivity or not one.acidity:
            continue
        acid, base = (made.same(f, "aq") for f in (one.acidity[-1].acid, one.acidity[-1].base))
        if acid is None or base is None:
            continue
        gained = after.get(base, 0.0) - before.get(base, 0.0)
        numbers = (
            {acid: -1, HYDROXIDE: -1, base: 1, WATER: 1}
            if gained > 0
            else {base: -1, PROTON: -1, acid: 1}
        )
        form = "basic" if gained > 0 else "acid"
        total = after.get(base, 0.0) + after.get(acid, 0.0)
        if total > 0 and abs(gained) / total > 0.05:
            why = f"{one.name} takes its {form} form (pKa {one.acidity[-1].pka:g})."
            shown.append(Change(numbers, abs(gained), KIND, why, used=abs(gained) / total))
    return shown
