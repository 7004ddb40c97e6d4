"""Quantities as a chemist types them, `0.1M`, `25 C`, `50 ml`, and portions made of them."""

import math
import re
from collections.abc import Mapping

from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.reaction import Reactant
from labutopia_lerobot.chemistry.refusals import ImpossibleConditionsError

_VOLUMES = {"l": 1e-3, "ml": 1e-6, "cm3": 1e-6, "ul": 1e-9, "m3": 1.0}
_CONCENTRATIONS = {"M": 1e3, "mM": 1.0, "uM": 1e-3, "mol/l": 1e3, "mmol/l": 1.0, "mol/m3": 1.0}
_AMOUNTS = {"mol": 1.0, "mmol": 1e-3, "umol": 1e-6}
_MASSES = {"kg": 1.0, "g": 1e-3, "mg": 1e-6}

_QUANTITY = re.compile(
    r"(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(?P<unit>[^\d\s]\S*)?"
)
_FREEZING_POINT = 273.15
"""0 C [K]."""


def volume(text: str) -> float:
    """Return a volume such as `50ml` [m^3].

    Raises:
        ImpossibleConditionsError: If it is none, or less than nothing.
    """
    return _quantity(text, _VOLUMES, "volume", "50ml")


def concentration(text: str) -> float:
    """Return a concentration such as `0.1M` [mol/m^3].

    Raises:
        ImpossibleConditionsError: If it is none, or less than nothing.
    """
    return _quantity(text, _CONCENTRATIONS, "concentration", "0.1M")


def temperature(text: str) -> float:
    """Return a temperature such as `25C` or `298 K` [K].

    Raises:
        ImpossibleConditionsError: If it is none, or below absolute zero.
    """
    number, unit = _split(text, "temperature", ("C", "°C", "K"), "25C or 298K")
    kelvin = number if unit == "K" else number + _FREEZING_POINT
    if kelvin < 0.0:
        raise ImpossibleConditionsError(f"temperature={text} is below absolute zero, -273.15 C")
    return kelvin


def portion(text: str, usual_volume: float, usual_concentration: float) -> Reactant:
    """Return a portion such as `hydrochloric acid: 0.2M 50ml` or `zinc: 0.5g`.

    Args:
        text: A compound, and behind a colon how much of it: the concentration and volume of its
            solution; or a mass or amount of it, pure, or dissolved if a volume is given too.
        usual_volume: Of a solution whose volume is not given [m^3].
        usual_concentration: Of one whose concentration is not given [mol/m^3].

    Raises:
        ChemistryError: If the compound is unknown, or a quantity is impossible.
    """
    name, colon, said = (part.strip() for part in text.rpartition(":"))
    if not colon:
        return Reactant(text, volume=usual_volume)
    kinds = {"volume": _VOLUMES, "concentration": _CONCENTRATIONS}
    kinds |= {"amount": _AMOUNTS, "mass": _MASSES}
    given: dict[str, float] = {}
    for word in re.sub(r"(?<=\d)\s+(?=[^\d\s])", "", said).replace(",", " ").split():
        kind = next((kind for kind, units in kinds.items() if _unit(word) in units), None)
        if kind is None or kind in given:
            raise ImpossibleConditionsError(
                f"'{text}': {word} is no quantity, or there are two of its kind. Write "
                f"'{name}: 0.2M 50ml', '{name}: 0.5g' or '{name}: 0.01mol'"
            )
        given[kind] = _quantity(word, kinds[kind], kind, "0.5g")
    pure = given.keys() & {"amount", "mass"}
    if len(pure | given.keys() & {"concentration"}) > 1:
        raise ImpossibleConditionsError(f"'{text}' says twice how much: {', '.join(sorted(given))}")
    if "mass" in given:
        given["amount"] = given["mass"] / resolve(name).molar_mass
    own_volume = given.get("volume", 0.0 if pure else usual_volume)
    if pure:
        return Reactant(name, given["amount"], own_volume)
    return Reactant(name, given.get("concentration", usual_concentration) * own_volume, own_volume)


def _quantity(text: str, units: Mapping[str, float], kind: str, example: str) -> float:
    number, unit = _split(text, kind, tuple(units), example)
    if number < 0.0:
        raise ImpossibleConditionsError(f"{kind}={text} is impossible: it is less than nothing")
    return number * units[unit]


def _split(text: str, kind: str, units: tuple[str, ...], example: str) -> tuple[float, str]:
    match = _QUANTITY.fullmatch(text.strip())
    unit = _unit(text)
    if match is None or unit not in units or not math.isfinite(float(match["number"])):
        raise ImpossibleConditionsError(
            f"{kind}={text} is no {kind}: write a number with its unit, such as {example}. "
            f"Units: {', '.join(units)}"
        )
    return float(match["number"]), unit


def _unit(text: str) -> str:
    """Return a unit as the tables have it: `mL` is `ml`, but `M` is not `m`."""
    match = _QUANTITY.fullmatch(text.strip())
    unit = (match["unit"] or "") if match else ""
    unit = (
        unit.replace("L", "l")
        .replace("³", "3")
        .replace("^3", "3")
        .replace("\N{GREEK SMALL LETTER MU}", "u")
    )
    return unit.replace("\N{MICRO SIGN}", "u")
