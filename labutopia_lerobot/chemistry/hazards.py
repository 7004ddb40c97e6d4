"""Refusals: mixtures that burn, explode or poison, each with its chemical name.

Source: Urben (ed.), Bretherick's Handbook of Reactive Chemical Hazards.
"""

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass

from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.refusals import HazardRefusedError

_AUTOIGNITION = 500.0
"""Temperature from which what burns is not heated in air or with an oxidiser [K]; ours, below the
autoignition temperatures of most vapours."""

_EXPLOSIVE_METALS = {"Ag", "Pb", "Cu", "Hg"}

_ORGANIC = {
    "hydrocarbon", "halocarbon", "alcohol", "ether", "aldehyde", "ketone", "ester", "amine",
    "carboxylic acid", "carbohydrate", "nitrile", "phenol", "amide", "heterocycle", "sulfoxide",
}  # fmt: skip

_STRONG_OXIDISERS = {"KMnO4", "KClO3", "NaClO3", "KClO4", "NaClO4", "NH4ClO4", "CrO3", "Na2O2"}


@dataclass(frozen=True)
class Charge:
    """What the vessel is charged with, as far as dangers go.

    Attributes:
        compounds: Everything in it, catalysts too.
        temperature: [K].
        ph: None without water.
        undiluted: Formulas of what is not in solution.
    """

    compounds: Sequence[Compound]
    temperature: float
    ph: float | None
    undiluted: Set[str]

    @property
    def formulas(self) -> set[str]:
        return {one.formula for one in self.compounds}

    @property
    def ions(self) -> set[str]:
        return {ion for one in self.compounds for ion in one.ions}

    @property
    def kinds(self) -> set[str]:
        return {kind for one in self.compounds for kind in one.reactivity}

    def of_kind(self, *kinds: str) -> list[Compound]:
        """Return the compounds of any of these classes."""
        return [one for one in self.compounds if set(kinds) & set(one.reactivity)]


def refuse(charge: Charge) -> None:
    """Raise if a mixture is dangerous.

    Raises:
        HazardRefusedError: It is; the message names what would form or happen.
    """
    for danger in _dangers(charge):
        names = ", ".join(one.name for one in charge.compounds)
        raise HazardRefusedError(
            f"{names}: {danger}. This engine works out no such mixture; leave one of them out"
        )


def _dangers(charge: Charge) -> Iterator[str]:
    yield from _explosives(charge)
    yield from _poisons(charge)
    yield from _fires(charge)


def _explosives(charge: Charge) -> Iterator[str]:
    formulas, ions = charge.formulas, charge.ions
    metals = {ion.split("^")[0].rstrip("2") for ion in ions} & _EXPLOSIVE_METALS
    explosive = [one for one in charge.of_kind("explosive") if "N3^-" not in one.ions]
    if explosive and len(charge.compounds) > 1:
        yield f"{explosive[0].name} is an explosive"
    if "N3^-" in ions and metals:
        yield f"the azide of {', '.join(sorted(metals))} explodes at a touch"
    if explosive:
        yield f"{explosive[0].name} is an explosive"
    if "I2" in formulas and "NH3" in formulas:
        yield "nitrogen triiodide explodes at a touch"
    if {"HNO3", "H2SO4"} <= formulas and charge.of_kind(*_ORGANIC):
        organic = charge.of_kind(*_ORGANIC)[0].name
        yield f"mixed acid nitrates {organic}; glycerol would give nitroglycerin"
    organic_fuel = charge.of_kind(*_ORGANIC)
    if "HNO3" in charge.undiluted and organic_fuel:
        yield f"nitric acid that is not diluted oxidises {organic_fuel[0].name} violently"
    if "H2O2" in formulas and charge.of_kind("ketone") and _acid(charge):
        yield "peroxides of acetone and other ketones explode"
    if "NH4NO3" in formulas and charge.temperature > 440.0:
        yield "ammonium nitrate explodes when it is heated"
    if "ClO3^-" in ions and "H2SO4" in charge.undiluted:
        yield "chlorine dioxide explodes"


def _acid(charge: Charge) -> bool:
    return bool(charge.of_kind("strong acid")) or (charge.ph is not None and charge.ph < 4.0)


def _poisons(charge: Charge) -> Iterator[str]:
    ions, formulas = charge.ions, charge.formulas
    acid = charge.of_kind("strong acid")
    if "ClO^-" in ions and acid:
        yield "hypochlorite and a strong acid give chlorine, a poisonous gas"
    if "ClO^-" in ions and ("NH3" in formulas or "NH4^+" in ions or charge.of_kind("amine")):
        yield "hypochlorite and ammonia or an amine give chloramines, which are poisonous"
    if "CN^-" in ions and (acid or (charge.ph is not None and charge.ph < 8.0)):
        yield "cyanide and an acid give hydrogen cyanide, a deadly gas"
    if "N3^-" in ions and acid:
        yield "azide and an acid give hydrazoic acid, which is poisonous and explodes"


def _fires(charge: Charge) -> Iterator[str]:
    formulas = charge.formulas
    hot = charge.temperature > _AUTOIGNITION
    fuel = [
        one
        for one in charge.compounds
        if set(one.reactivity) & _ORGANIC or one.formula in ("H2", "C", "S", "P4", "P", "CO", "S8")
    ]
    metals = [one for one in charge.of_kind("metal") if one.formula in ("Mg", "Al", "Zn", "Ti")]
    if hot and fuel:
        yield f"{fuel[0].name} burns: combustion is not worked out"
    if hot and "O2" in formulas and (metals or charge.of_kind("metal")):
        yield f"{charge.of_kind('metal')[0].name} burns: combustion is not worked out"
    if hot and metals and any(kind.endswith("oxide") for kind in charge.kinds):
        yield f"{metals[0].name} and a metal oxide burn as thermite"
    strong = charge.undiluted & _STRONG_OXIDISERS
    dry_fuel = [one for one in (*fuel, *metals) if one.formula in charge.undiluted]
    if strong and dry_fuel:
        yield f"{dry_fuel[0].name} takes fire with {', '.join(sorted(strong))}"
    if dry_fuel and hot and "NO3^-" in charge.ions:
        yield f"{dry_fuel[0].name} takes fire with a nitrate"


__all__ = ["Charge", "refuse"]
