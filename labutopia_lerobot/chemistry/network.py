"""Every species that the engine knows and what it is made of: ions, molecules, complexes, phases.

`data/species.json` says what forms in solution; the table of substances adds its acids, its
sparingly soluble salts and what their ions look like. Where both have a number, a test holds them
equal.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from labutopia_lerobot.chemistry.compound import Band, Colour, Compound, substances, table
from labutopia_lerobot.chemistry.formula import Formula, parse

SpeciesPhase = Literal["aq", "s", "l", "g"]

WATER = "H2O(l)"
PROTON = "H^+(aq)"
HYDROXIDE = "OH^-(aq)"

LETTERS: Mapping[str, SpeciesPhase] = {"solid": "s", "liquid": "l", "gas": "g"}

MOLAR_GAS = 8.314462618
"""Gas constant [J/(mol K)] (CODATA 2018)."""
STANDARD_K = 298.15
"""Temperature of tabulated constants [K]."""

_LN10 = math.log(10)


class SpeciesRecord(BaseModel):
    """One line of the file.

    Attributes:
        formula: As `formula.parse` writes it.
        phase: Dissolved, solid, liquid or gas.
        name: What it is called.
        made_of: Species that it forms from, with their numbers; empty for a component.
        log_k: Decimal logarithm of that formation's constant at 25 C, in mol/l and bar.
        enthalpy: Of formation from the elements [J/mol]; None if not known: then no heat is
            counted when it forms.
        colour: sRGB, of a solid as it looks, of a solution 1 cm thick at 0.1 mol/l.
        absorption: Maxima of absorption in water.
        complex: Whether ligands are bound to a metal or a halogen in it.
        only_dissolves: Whether it never forms in water, though it dissolves: an oxide.
        provenance: Key of the source of each number.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    formula: str
    phase: SpeciesPhase
    name: str
    made_of: Mapping[str, int] = {}
    log_k: float = 0.0
    enthalpy: float | None = None
    colour: Colour | None = None
    absorption: tuple[Band, ...] = ()
    complex: bool = False
    only_dissolves: bool = False
    provenance: Mapping[str, str] = {}


class SpeciesTable(BaseModel):
    """The whole file, with what the keys of the sources stand for."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    sources: Mapping[str, str]
    species: tuple[SpeciesRecord, ...] = Field(min_length=1)


@dataclass(frozen=True)
class Species:
    """A species in terms of components.

    Attributes:
        key: Formula and phase, ``Cu^2+(aq)``.
        name: What it is called.
        composition: Atoms and charge.
        phase: Dissolved, solid, liquid or gas.
        components: How many of each component's key it is made of; itself if it is one.
        log_k: Decimal logarithm of its formation constant from the components at 25 C.
        enthalpy: Of formation [J/mol].
        colour: sRGB as in `SpeciesRecord`.
        absorption: Maxima of absorption.
        is_complex: Whether ligands are bound in it.
        only_dissolves: Whether it never forms in water.
    """

    key: str
    name: str
    composition: Formula
    phase: SpeciesPhase
    components: Mapping[str, float]
    log_k: float
    enthalpy: float
    colour: str | None = None
    absorption: tuple[Band, ...] = ()
    is_complex: bool = False
    only_dissolves: bool = False

    @property
    def is_component(self) -> bool:
        return self.key in self.components


@dataclass
class Network:
    """All species by key; `network` builds it once."""

    species: dict[str, Species] = field(default_factory=dict)
    by_composition: dict[tuple[frozenset[tuple[str, int]], int, str], str] = field(
        default_factory=dict
    )
    heatless: set[str] = field(default_factory=set)
    """Keys of components whose enthalpy is not known: what they make forms without heat."""

    def add(self, record: SpeciesRecord) -> Species:
        """Return the species of a record, in terms of components, after adding it."""
        composition = parse(record.formula)
        key = f"{record.formula}({record.phase})"
        enthalpy = record.enthalpy
        components: dict[str, float] = {}
        log_k = record.log_k
        if record.made_of:
            formed = 0.0
            for part, count in record.made_of.items():
                one = self.dissolved(part)
                log_k += count * one.log_k
                formed += count * one.enthalpy
                for component, number in one.components.items():
                    components[component] = components.get(component, 0) + count * number
            heatless = self.heatless & components.keys()
            enthalpy = formed if enthalpy is None or heatless else enthalpy
        else:
            components[key] = 1.0
            if enthalpy is None:
                self.heatless.add(key)
        one = Species(
            key=key,
            name=record.name,
            composition=composition,
            phase=record.phase,
            components={name: n for name, n in components.items() if n},
            log_k=log_k,
            enthalpy=0.0 if enthalpy is None else enthalpy,
            colour=record.colour,
            absorption=record.absorption,
            is_complex=record.complex,
            only_dissolves=record.only_dissolves,
        )
        self.species[key] = one
        if record.provenance:  # of the file: a substance that is only an isomer is another one
            self.by_composition.setdefault(_fingerprint(composition, record.phase), key)
        return one

    def dissolved(self, formula: str) -> Species:
        """Return a dissolved species, or water, by formula; an unknown one becomes a component."""
        key = WATER if formula == "H2O" else self.same(formula, "aq")
        if key is not None:
            return self.species[key]
        return self.add(_ion_record(formula))

    def same(self, formula: str, phase: SpeciesPhase) -> str | None:
        """Return the key of the species of this formula, or of the same atoms written otherwise."""
        key = f"{formula}({phase})"
        if key in self.species:
            return key
        return self.by_composition.get(_fingerprint(parse(formula), phase))


def _fingerprint(composition: Formula, phase: str) -> tuple[frozenset[tuple[str, int]], int, str]:
    return frozenset(composition.atoms.items()), composition.charge, phase


def _ion_record(formula: str) -> SpeciesRecord:
    ion = table().ions.get(formula)
    if ion is None:
        owners = [one for one in substances().values() if one.formula == formula]
        if not owners:
            return SpeciesRecord(formula=formula, phase="aq", name=formula)
        return SpeciesRecord(
            formula=formula,
            phase="aq",
            name=owners[0].name,
            enthalpy=owners[0].formation_enthalpy.get("aq"),
            colour=owners[0].solution_colour,
            absorption=owners[0].absorption,
        )
    return SpeciesRecord(
        formula=formula,
        phase="aq",
        name=ion.name,
        enthalpy=ion.formation_enthalpy,
        colour=ion.colour,
        absorption=ion.absorption,
    )


@cache
def network() -> Network:
    """Return all species that can form, from the file and from the table of substances."""
    made = Network()
    text = (files(__package__) / "data" / "species.json").read_text(encoding="utf-8")
    records = list(SpeciesTable.model_validate_json(text).species)
    for record in records:
        if not record.made_of:
            made.add(record)
    for record in records:
        if record.made_of:
            made.add(record)
    for formula, ion in table().ions.items():
        made.dissolved(formula)
        if ion.pka is not None and ion.pka < _WEAKEST_METAL_ACID:
            _add_first_hydrolysis(made, formula, ion.pka)
    for substance in substances().values():
        _add_acid(made, substance)
    for substance in substances().values():
        _add_pure(made, substance)
    return made


_WEAKEST_METAL_ACID = 9.0
"""pKa above which the hydrated metal ion is not counted as an acid: its hydroxide comes first."""


def _add_first_hydrolysis(made: Network, formula: str, pka: float) -> None:
    ion = parse(formula)
    metal, charge = formula.split("^")[0], ion.charge - 1
    shown = f"[{metal}(OH)]^{charge if charge > 1 else ''}+"
    if metal.isalpha() and made.same(shown, "aq") is None:
        made.add(
            SpeciesRecord(
                formula=shown,
                phase="aq",
                name=f"hydroxo{made.dissolved(formula).name}",
                made_of={formula: 1, "H2O": 1, "H^+": -1},
                log_k=-pka,
                colour=table().ions[formula].colour,
                absorption=table().ions[formula].absorption,
            )
        )


def _add_acid(made: Network, substance: Compound) -> None:
    """Add what a substance's own steps as an acid give, the most basic form as a component."""
    for step in reversed(substance.acidity):
        if step.acid == "H2O" or step.pka < 0:
            continue
        if made.same(step.acid, "aq") is None and not _is_hydrate_of_known(made, step.acid):
            base = made.same(step.base, "aq")
            own = step.acid == substance.formula
            made.add(
                SpeciesRecord(
                    formula=step.acid,
                    phase="aq",
                    name=substance.name if own else step.acid,
                    made_of={base.removesuffix("(aq)") if base else step.base: 1, "H^+": 1},
                    log_k=step.pka,
                    enthalpy=substance.formation_enthalpy.get("aq") if own else None,
                    colour=substance.solution_colour if own else None,
                    absorption=substance.absorption if own else (),
                )
            )


def _is_hydrate_of_known(made: Network, formula: str) -> bool:
    """Whether this is a known species with water, as H2CO3 is of CO2."""
    return without_water(made, formula) is not None


def without_water(made: Network, formula: str) -> str | None:
    """Return the dissolved species that has one H2O less, as CO2 is of H2CO3; None without one."""
    composition = parse(formula)
    atoms = dict(composition.atoms)
    atoms["H"] = atoms.get("H", 0) - 2
    atoms["O"] = atoms.get("O", 0) - 1
    if atoms["H"] < 0 or atoms["O"] < 0:
        return None
    rest = frozenset((name, n) for name, n in atoms.items() if n)
    key = made.by_composition.get((rest, composition.charge, "aq"))
    return key if key in ("CO2(aq)", "SO2(aq)", "NH3(aq)", "B(OH)3(aq)") else None


def _add_pure(made: Network, substance: Compound) -> None:
    """Add the pure substance as a phase, with its solubility where that is known."""
    if substance.phase is None or substance.formula == "H2O":
        return
    phase = LETTERS[substance.phase]
    if made.same(substance.formula, phase) is not None:
        return
    parts: dict[str, int] = {}
    log_k = 0.0
    molar = None
    if substance.solubility == "miscible":
        molar = _MISCIBLE
    elif substance.solubility:
        molar = substance.solubility / substance.molar_mass / 1000.0
    if substance.ions:
        ions = dict(substance.ions)
        moving = {name: n for name, n in ions.items() if name != "H2O"}
        if substance.log_ksp is not None:
            parts, log_k = ions, -substance.log_ksp
        else:
            molar = molar or _ASSUMED_SOLUBILITY
            parts = ions
            log_k = -sum(n * math.log10(n * molar) for n in moving.values())
    elif molar is not None and not substance.ions:
        known = made.same(substance.formula, "aq") or without_water(made, substance.formula)
        name = known.removesuffix("(aq)") if known else substance.formula
        if parse(name).atoms == substance.composition.atoms:
            parts, log_k = {name: 1}, -math.log10(molar)
    made.add(
        SpeciesRecord(
            formula=substance.formula,
            phase=phase,
            name=substance.name,
            made_of=parts,
            log_k=log_k,
            enthalpy=substance.formation_enthalpy.get(substance.phase),
            colour=substance.colour,
        )
    )


_MISCIBLE = 100.0
"""Counts as the solubility of what mixes with water in every proportion [mol/l]."""

_ASSUMED_SOLUBILITY = 3.0
"""Of a salt that dissolves and whose solubility the table does not know [mol/l]; an estimate."""


def log_k_at(one: Species, temperature: float) -> float:
    """Return the decimal logarithm of a formation constant at a temperature.

    Van 't Hoff's equation with a constant enthalpy (Atkins and de Paula, Physical Chemistry).
    """
    made = network().species
    heat = one.enthalpy - sum(n * made[name].enthalpy for name, n in one.components.items())
    return one.log_k - heat / (MOLAR_GAS * _LN10) * (1.0 / temperature - 1.0 / STANDARD_K)
