"""What a person sees and feels of a reaction, in plain words."""

from collections.abc import Mapping, Sequence
from functools import cache

from labutopia_lerobot.chemistry import colour
from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.chemistry.network import WATER, network

_FELT = 0.5
"""Smallest change of temperature that is worth a word [K]; an estimate of ours."""


def of_reaction(change: Change) -> list[str]:
    """Return the precipitates, gases, metals and dissolving solids of one reaction."""
    made = network().species
    metals = {key for key in change.products if key[:-3].isalpha() and len(key) <= 5}
    words: list[str] = []
    for key in change.products:
        one = made[key]
        look = colour.word(colour.rgb(one.colour), clear="white") if one.colour else "white"
        if one.phase == "s":
            if key in metals and change.kind == "redox":
                words.append(f"{_with_article(look)} deposit of {name_of(key).lower()}")
            elif any(made[k].phase == "aq" for k in change.reactants):
                words.append(f"{_with_article(look)} precipitate of {name_of(key).lower()}")
            else:
                words.append(f"{_with_article(look)} solid, {name_of(key).lower()}, is left")
        elif one.phase == "g" and key != "H2O(g)":
            words.append(
                f"bubbles of {name_of(key).lower()}"
                if _is_wet(change)
                else f"{name_of(key).lower()} escapes"
            )
        elif key == "H2O(g)":
            words.append("steam escapes")
    words += [
        f"{name_of(key).lower()} dissolves"
        for key in change.reactants
        if made[key].phase == "s" and any(made[k].phase == "aq" for k in change.products)
    ]
    if change.slow:
        words.append("slow: nothing is seen at once")
    return words


def _with_article(look: str) -> str:
    return f"{'an' if look[0] in 'aeiou' else 'a'} {look}"


def _is_wet(change: Change) -> bool:
    return any(key.endswith("(aq)") or key == WATER for key in change.coefficients)


def of_mixture(before: colour.Rgb, after: colour.Rgb, warming: float) -> list[str]:
    """Return the change of colour and of temperature of the whole mixture.

    Args:
        before: sRGB before.
        after: sRGB afterwards.
        warming: Change of temperature [K].
    """
    first, last = colour.word(before), colour.word(after)
    words = []
    if first != last:
        words.append(f"the solution changes from {first} to {last}")
    elif last != "colourless":
        words.append(f"the solution stays {last}")
    if abs(warming) >= _FELT:
        words.append(f"it {'warms' if warming > 0 else 'cools'} by about {abs(warming):.0f} K")
    return words


def is_turbid(amounts: Mapping[str, float], volume: float) -> bool:
    """Whether solid other than a piece of metal floats in it: more than 10 micromol per litre."""
    made = network().species
    floating = sum(
        amount
        for key, amount in amounts.items()
        if key.endswith("(s)") and not (key in made and key[:-3].isalpha() and len(key) <= 5)
    )
    return volume > 0 and floating / (volume * 1000.0) > 1e-5


@cache
def _names() -> dict[str, str]:
    return {one.formula: one.name for one in reversed(list(substances().values()))}


def name_of(key: str) -> str:
    """Return the name of a species: its substance's, else its own."""
    formula = key[: key.rindex("(")]
    if formula in _names():
        return _names()[formula]
    one = network().species.get(key)
    return one.name if one is not None else formula


__all__: Sequence[str] = ["is_turbid", "name_of", "of_mixture", "of_reaction"]
