"""The paper's call for records of compounds, and its records: every value a string with its unit.

Source of the fields, of their order and of the strings' form: LabUtopia, appendix, "Database of
Chemical Substances" and "Process Reasoning Pipeline", step 2. What it prints no example of is ours:
solubility in g/L or in a word, four significant digits where four decimals would show fewer, and
the fields after the nine.
"""

import difflib
from collections.abc import Callable, Mapping, Sequence

from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.refusals import ChemistryError

type Record = dict[str, str | None]


class LookupQueryError(ChemistryError):
    """A query has other keys than ``compounds`` and ``fields``, or a field that there is not."""


def lookup(query: Mapping[str, Sequence[str]]) -> list[Record]:
    """Return the records of some compounds, in the order of the query.

    Args:
        query: ``compounds`` names them in any way that `names.resolve` takes; ``fields`` says what
            of them, and is the paper's nine if it is not there.

    Raises:
        LookupQueryError: The query is not of this form.
        UnknownCompoundError: A compound is not in the table.
        AmbiguousCompoundError: A name could be that of several.
    """
    compounds, fields = _checked(query)
    return [_record(resolve(compound), fields) for compound in compounds]


def record(compound: Compound) -> Record:
    """Return the paper's record of a compound."""
    return _record(compound, PAPER_FIELDS)


def _record(compound: Compound, fields: Sequence[str]) -> Record:
    return {field: _FORMS[field](compound) for field in fields}


def _checked(query: Mapping[str, Sequence[str]]) -> tuple[Sequence[str], Sequence[str]]:
    form = '{"compounds": ["Hydrochloric acid"], "fields": ["molar_mass"]}'
    if not isinstance(query, Mapping) or not {"compounds"} <= set(query) <= {"compounds", "fields"}:
        raise LookupQueryError(f"a query is of the form {form}, not {query!r}")
    for key, values in query.items():
        listed = isinstance(values, Sequence) and not isinstance(values, str | bytes)
        if not listed or not all(isinstance(value, str) for value in values):
            raise LookupQueryError(f"{key} is to be a list of texts, not {values!r}: {form}")
    fields = query.get("fields", PAPER_FIELDS)
    for field in fields:
        if field not in _FORMS:
            near = difflib.get_close_matches(field, _FORMS, n=1)
            hint = f" Did you mean {near[0]!r}?" if near else ""
            raise LookupQueryError(
                f"field {field!r} is unknown.{hint} Choose from: {', '.join(_FORMS)}"
            )
    return query["compounds"], fields


def _grams_per_cm3(density: float | None) -> str | None:
    if density is None:
        return None
    value = density / 1000
    return f"{value:,.4f} g/cm³" if value >= 0.1 else f"{value:#.4g} g/cm³"


def _celsius(kelvin: float | None) -> str | None:
    if kelvin is None:
        return None
    return f"{round(kelvin - 273.15, 2) + 0.0:,.2f} °C"  # + 0.0: no "-0.00"


def _solubility(compound: Compound) -> str | None:
    match compound.solubility:
        case None | "miscible" as word:
            return word
        case 0.0:
            return "insoluble"
        case value:
            return f"{value:,.2f} g/L" if value >= 0.1 else f"{value:.2g} g/L"


def _ph(compound: Compound) -> str | None:
    if compound.ph is None:
        return None
    return f"{compound.ph.value:.2f} at {compound.ph.concentration / 1000:g} mol/L"


def _molar_mass(compound: Compound) -> str:
    return f"{compound.composition.relative_mass.normalize():f} g/mol"


_FORMS: Mapping[str, Callable[[Compound], str | None]] = {
    "compound_name": lambda compound: compound.name,
    "chemical_formula": lambda compound: compound.formula,
    "molar_mass": _molar_mass,
    "density": lambda compound: _grams_per_cm3(compound.density),
    "melting_point": lambda compound: _celsius(compound.melting_point),
    "boiling_point": lambda compound: _celsius(compound.boiling_point),
    "solubility": _solubility,
    "sublimation_point": lambda compound: _celsius(compound.sublimation_point),
    "appearance": lambda compound: compound.appearance,
    "id": lambda compound: compound.id,
    "cas": lambda compound: compound.cas,
    "color": lambda compound: compound.colour,
    "solution_color": lambda compound: compound.solution_colour,
    "ph": _ph,
}

PAPER_FIELDS = tuple(_FORMS)[:9]
"""The fields of the paper's records, in its order."""
