"""The properties of a compound, and the table of all of them.

`data/substances.json` is the one file of truth. What it says is checked against the classes below
when it is read: units, ranges, that every number names its source, that ions balance.
"""

from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from labutopia_lerobot.chemistry.formula import Formula, parse

Matter = Literal["solid", "liquid", "gas"]
"""Phase of a pure compound."""

ReactivityClass = Literal[
    "strong acid",
    "weak acid",
    "strong base",
    "weak base",
    "salt",
    "acidic oxide",
    "basic oxide",
    "amphoteric oxide",
    "neutral oxide",
    "amphoteric hydroxide",
    "metal",
    "nonmetal",
    "noble gas",
    "oxidiser",
    "reducer",
    "complex",
    "indicator",
    "hydrocarbon",
    "halocarbon",
    "alcohol",
    "phenol",
    "ether",
    "aldehyde",
    "ketone",
    "carboxylic acid",
    "ester",
    "amine",
    "amide",
    "nitrile",
    "nitro compound",
    "amino acid",
    "carbohydrate",
    "sulfoxide",
    "heterocycle",
    "explosive",
]

Colour = Annotated[str, Field(pattern=r"^#[0-9a-f]{6}$")]
"""sRGB."""

Miscible = Literal["miscible"]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Dissociation(_Record):
    """One step of an acid: ``acid`` gives a proton away and ``base`` stays.

    Attributes:
        acid: Formula of the acid form.
        base: Formula of what stays.
        pka: At 25 C and no ionic strength.
    """

    acid: str
    base: str
    pka: float = Field(ge=-12, le=50)

    @property
    def pkb(self) -> float:
        """Of ``base``, at 25 C, with the ion product of water 1e-14."""
        return 14.0 - self.pka

    @model_validator(mode="after")
    def _one_proton(self) -> Self:
        acid, base = parse(self.acid), parse(self.base)
        left = {e: n - base.atoms.get(e, 0) for e, n in acid.atoms.items()}
        lost = {e: n for e, n in left.items() if n}
        if lost != {"H": 1} or acid.charge != base.charge + 1 or set(base.atoms) - set(left):
            raise ValueError(f"{self.acid} -> {self.base} is not the loss of one proton")
        return self


class Band(_Record):
    """One maximum of absorption in water.

    Attributes:
        wavelength: Of the maximum [m].
        absorptivity: Molar, decadic, at the maximum [m^2/mol]; 1 m^2/mol is 10 l/(mol cm).
    """

    wavelength: float = Field(gt=150e-9, lt=1500e-9)
    absorptivity: float = Field(gt=0, lt=2e4)


class MeasuredPh(_Record):
    """pH of a stated solution.

    Attributes:
        value: At 25 C.
        concentration: Of the compound [mol/m^3].
    """

    value: float = Field(ge=-2, le=16)
    concentration: float = Field(gt=0)


class Ion(_Record):
    """A dissolved species that compounds share.

    Attributes:
        name: What it is called, for example ``copper(II)``.
        colour: sRGB of a 0.1 mol/l solution in a vessel before white; None if colourless.
        absorption: Maxima of absorption, where known.
        formation_enthalpy: Of the ion in water at infinite dilution, H+ being 0 [J/mol].
        pka: Of the hydrated metal ion as an acid, first step; None if it is not one.
        provenance: Source of every number and colour above, by field.
    """

    name: str
    colour: Colour | None = None
    absorption: tuple[Band, ...] = ()
    formation_enthalpy: float | None = None
    pka: float | None = None
    provenance: Mapping[str, str] = {}


def _si(unit: str, *, above: float | None = None) -> Any:
    return Field(default=None, gt=above, json_schema_extra={"unit": unit})


class Compound(_Record):
    """A compound; None where a value is not known.

    Attributes:
        id: Ours: small letters, digits and underscores.
        name: The paper's ``compound_name``.
        formula: The paper's ``chemical_formula``, as `formula.parse` writes it.
        cas: Registry number of the Chemical Abstracts Service.
        pubchem_cid: PubChem's number.
        synonyms: Further names and formulas.
        smiles: Structure of a molecule.
        ions: What a formula unit gives in water, by formula of the ion or of a molecule; empty if
            it dissolves as it is, or not at all, or reacts.
        appearance: What one sees, in words.
        phase: At 25 C and 101,325 Pa; None for what exists only in water.
        density: At 25 C, of a gas at 101,325 Pa [kg/m^3].
        melting_point: [K].
        boiling_point: At 101,325 Pa [K].
        sublimation_point: At 101,325 Pa, of what does not melt there [K].
        solubility: What dissolves in 1000 kg of water, which is a cubic metre, at 25 C [kg/m^3]; 0
            for what handbooks call insoluble and give no number for.
        log_ksp: Decimal logarithm of the solubility product, ``ions`` being the products.
        acidity: Its own steps as an acid, or of its conjugate acid, the strongest first.
        ph: Of a stated solution.
        formation_enthalpy: By phase, ``aq`` for the dissolved molecule or the sum of its ions
            [J/mol].
        heat_capacity: At constant pressure, 25 C, of the phase at 25 C [J/(mol K)].
        viscosity: Dynamic, of the liquid at 25 C [Pa s].
        surface_tension: Of the liquid against air at 25 C [N/m].
        colour: sRGB of the pure compound; None if colourless and clear.
        solution_colour: sRGB of a 0.1 mol/l solution in a vessel before white (an indicator: 20
            micromol/l, as its neutral form); None if colourless.
        absorption: Maxima of absorption in water, where known.
        reactivity: Classes that it belongs to.
        ghs: Hazard statements of the Globally Harmonised System, for example ``H314``.
        provenance: Source of every value, by field (enthalpies: field, a dot, phase), as a key of
            the table's ``sources``.
    """

    id: str = Field(pattern=r"^[a-z0-9]+(_[a-z0-9]+)*$")
    name: str = Field(min_length=2)
    formula: str
    cas: str | None = Field(default=None, pattern=r"^\d{2,7}-\d{2}-\d$")
    pubchem_cid: int | None = Field(default=None, gt=0)
    synonyms: tuple[str, ...] = ()
    smiles: str | None = None
    ions: Mapping[str, int] = {}
    appearance: str | None = None
    phase: Matter | None
    density: float | None = _si("kg/m^3", above=0)
    melting_point: float | None = _si("K", above=0)
    boiling_point: float | None = _si("K", above=0)
    sublimation_point: float | None = _si("K", above=0)
    solubility: Annotated[float, Field(ge=0)] | Miscible | None = _si("kg/m^3")
    log_ksp: float | None = Field(default=None, lt=1, json_schema_extra={"unit": "1"})
    acidity: tuple[Dissociation, ...] = ()
    ph: MeasuredPh | None = None
    formation_enthalpy: Mapping[Literal["solid", "liquid", "gas", "aq"], float] = Field(
        default={}, json_schema_extra={"unit": "J/mol"}
    )
    heat_capacity: float | None = _si("J/(mol K)", above=0)
    viscosity: float | None = _si("Pa s", above=0)
    surface_tension: float | None = _si("N/m", above=0)
    colour: Colour | None = None
    solution_colour: Colour | None = None
    absorption: tuple[Band, ...] = ()
    reactivity: tuple[ReactivityClass, ...] = Field(min_length=1)
    ghs: tuple[Annotated[str, Field(pattern=r"^H[2-4]\d\d[A-Za-z]{0,2}$")], ...] = ()
    provenance: Mapping[str, str] = {}

    @property
    def composition(self) -> Formula:
        """Atoms of its formula."""
        return parse(self.formula)

    @property
    def molar_mass(self) -> float:
        """From its formula and the atomic weights [kg/mol]."""
        return self.composition.molar_mass

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.composition.text != self.formula or self.composition.charge:
            raise ValueError(f"{self.id}: write its formula as {self.composition.text}, uncharged")
        if self.ions and sum(parse(ion).charge * n for ion, n in self.ions.items()):
            raise ValueError(f"{self.id}: the charges of its ions {dict(self.ions)} do not cancel")
        return self


class CompoundTable(_Record):
    """The whole file.

    Attributes:
        units: Of every field that has one.
        sources: What the keys in ``provenance`` stand for.
        ions: Dissolved species by formula.
        substances: All compounds.
    """

    units: Mapping[str, str]
    sources: Mapping[str, str]
    ions: Mapping[str, Ion]
    substances: tuple[Compound, ...]

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if dict(self.units) != units():
            raise ValueError(f"the units are to be {units()}")
        ids = [substance.id for substance in self.substances]
        twice = {one for one in ids if ids.count(one) > 1}
        if twice:
            raise ValueError(f"several substances have the id {', '.join(sorted(twice))}")
        for one in self.substances:
            given = {field for field in _SOURCED if getattr(one, field) not in (None, ())}
            given |= {f"formation_enthalpy.{phase}" for phase in one.formation_enthalpy}
            if given != set(one.provenance):
                odd = ", ".join(sorted(given ^ set(one.provenance)))
                raise ValueError(f"{one.id}: a value without source or the reverse: {odd}")
        used = {key for one in self.substances for key in one.provenance.values()}
        used |= {key for ion in self.ions.values() for key in ion.provenance.values()}
        if used != set(self.sources):
            raise ValueError(f"sources are unknown or unused: {sorted(used ^ set(self.sources))}")
        return self


_SOURCED = (
    "density",
    "melting_point",
    "boiling_point",
    "sublimation_point",
    "solubility",
    "log_ksp",
    "acidity",
    "ph",
    "heat_capacity",
    "viscosity",
    "surface_tension",
    "colour",
    "solution_colour",
    "absorption",
    "ghs",
)
"""Fields whose values name their source; identity and words are common knowledge."""


def units() -> dict[str, str]:
    """Return the unit of every field of a substance that has one."""
    extras = {name: field.json_schema_extra for name, field in Compound.model_fields.items()}
    return {name: str(extra["unit"]) for name, extra in extras.items() if isinstance(extra, dict)}


@cache
def table() -> CompoundTable:
    """Return everything that the file says."""
    text = (files(__package__) / "data" / "substances.json").read_text(encoding="utf-8")
    return CompoundTable.model_validate_json(text)


@cache
def substances() -> Mapping[str, Compound]:
    """Return all compounds by id."""
    return {substance.id: substance for substance in table().substances}
