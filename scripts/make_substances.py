"""`python scripts/make_substances.py`: `docs/substances.md`, every compound of the table."""

from collections.abc import Iterator
from pathlib import Path

from labutopia_lerobot.chemistry.chem_db import record
from labutopia_lerobot.chemistry.compound import Compound, table

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "substances.md"

_HEAD = (
    "name, `id`",
    "formula",
    "CAS",
    "molar mass",
    "density",
    "melts",
    "boils, sublimes (s)",
    "solubility",
    "gives in water",
    "pKa",
    "log Ksp",
    "looks",
    "class",
)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


def page() -> str:
    """Return the page in Markdown."""
    return "\n".join(_lines()).rstrip() + "\n"


def _lines() -> Iterator[str]:
    everything = table()
    yield "# Compounds"
    yield ""
    yield "[To the README](../README.md)"
    yield ""
    yield "Made by `python scripts/make_substances.py` from"
    yield "`labutopia_lerobot/chemistry/data/substances.json`; do not edit. The file has more"
    yield "of each: enthalpies of formation, heat capacities, viscosities, absorption maxima,"
    yield "colours as sRGB, synonyms, hazard statements, and the source of every value."
    yield ""
    count = f"{len(everything.substances)} compounds, {len(everything.ions)} dissolved species."
    yield f"{count} All is at 25 °C and"
    yield "101,325 Pa; solubilities are per litre of water. What is not known is left out."
    for title, chosen in _chapters(everything.substances):
        yield from ("", f"## {title}", "", f"| {' | '.join(_HEAD)} |", "| --- " * len(_HEAD) + "|")
        for one in sorted(chosen, key=lambda one: one.name.lower()):
            yield f"| {' | '.join(_row(one))} |"
    yield from ("", "## Dissolved species", "")
    yield "Colours are of 1 cm of a 0.1 mol/l solution."
    yield ""
    yield "| species | name | enthalpy of formation [kJ/mol] | pKa | maxima [nm] | colour |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for formula, ion in everything.ions.items():
        heat = "" if ion.formation_enthalpy is None else f"{ion.formation_enthalpy / 1000:.2f}"
        maxima = ", ".join(f"{band.wavelength * 1e9:.0f}" for band in ion.absorption)
        pka = "" if ion.pka is None else f"{ion.pka:g}"
        yield f"| {formula} | {ion.name} | {heat} | {pka} | {maxima} | {ion.colour or ''} |"
    yield from ("", "## Sources", "")
    for key, source in everything.sources.items():
        yield f"- `{key}`: {source}."


def _chapters(all_of_them: tuple[Compound, ...]) -> Iterator[tuple[str, list[Compound]]]:
    """Yield the compounds in two parts: with carbon chains or rings, and without."""
    organic = [one for one in all_of_them if one.composition.atoms.keys() >= {"C", "H"}]
    yield "Organic, and salts of organic acids", organic
    yield "Inorganic", [one for one in all_of_them if one not in organic]


def _row(one: Compound) -> Iterator[str]:
    printed = record(one)
    yield f"{one.name}<br>`{one.id}`"
    yield one.formula
    yield one.cas or ""
    yield printed["molar_mass"] or ""
    yield printed["density"] or ""
    yield printed["melting_point"] or ""
    sublimes = printed["sublimation_point"]
    yield printed["boiling_point"] or (f"{sublimes} (s)" if sublimes else "")
    yield printed["solubility"] or ""
    yield ", ".join(ion if n == 1 else f"{n} {ion}" for ion, n in one.ions.items())
    yield ", ".join(f"{step.pka:g}" for step in one.acidity)
    yield "" if one.log_ksp is None else f"{one.log_ksp:g}"
    yield one.appearance or ""
    yield ", ".join(one.reactivity)


if __name__ == "__main__":
    main()
