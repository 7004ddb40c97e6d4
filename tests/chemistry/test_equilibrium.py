"""The solver against another one, and the constants against each other."""

import math
import warnings
from collections import defaultdict
from typing import Any

import numpy as np
import pytest

from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.chemistry.equilibrium import NoEquilibriumError, solve
from labutopia_lerobot.chemistry.formula import parse
from labutopia_lerobot.chemistry.inventory import Inventory, Solute
from labutopia_lerobot.chemistry.network import PROTON, network
from labutopia_lerobot.chemistry.speciation import ph_of, settle

chempy = pytest.importorskip("chempy")

_LITRE = 1e-3

_WATER = 55.4
"""[mol/l]."""

# What is poured, by the ions and molecules that it gives: acids, bases and salts.
_SOLUTES: list[dict[str, int]] = [
    {"H^+(aq)": 1, "Cl^-(aq)": 1},
    {"H^+(aq)": 1, "HSO4^-(aq)": 1},
    {"CH3COOH(aq)": 1},
    {"HF(aq)": 1},
    {"H3PO4(aq)": 1},
    {"H2C2O4(aq)": 1},
    {"Na^+(aq)": 1, "OH^-(aq)": 1},
    {"NH3(aq)": 1},
    {"Na^+(aq)": 1, "CH3COO^-(aq)": 1},
    {"Na^+(aq)": 1, "HSO3^-(aq)": 1},
    {"NH4^+(aq)": 1, "Cl^-(aq)": 1},
    {"Na^+(aq)": 2, "HPO4^2-(aq)": 1},
    {"Na^+(aq)": 1, "H2PO4^-(aq)": 1},
    {"Na^+(aq)": 3, "PO4^3-(aq)": 1},
    {"Na^+(aq)": 1, "HCO3^-(aq)": 1},
    {"Na^+(aq)": 2, "CO3^2-(aq)": 1},
    {"Na^+(aq)": 1, "F^-(aq)": 1},
]

_STEPS = [
    ("OH^-(aq)", None),
    ("HSO4^-(aq)", "SO4^2-(aq)"),
    ("CH3COOH(aq)", "CH3COO^-(aq)"),
    ("HF(aq)", "F^-(aq)"),
    ("H3PO4(aq)", "H2PO4^-(aq)"),
    ("H2PO4^-(aq)", "HPO4^2-(aq)"),
    ("HPO4^2-(aq)", "PO4^3-(aq)"),
    ("H2C2O4(aq)", "HC2O4^-(aq)"),
    ("HC2O4^-(aq)", "C2O4^2-(aq)"),
    ("NH4^+(aq)", "NH3(aq)"),
    ("HSO3^-(aq)", "SO3^2-(aq)"),
    ("SO2(aq)", "HSO3^-(aq)"),
    ("HCO3^-(aq)", "CO3^2-(aq)"),
    ("CO2(aq)", "HCO3^-(aq)"),
]


def _chempy_ph(poured: dict[str, float]) -> float | None:
    """Return the pH that chempy solves for with the same constants; None where it gives up."""
    from chempy import Equilibrium
    from chempy.chemistry import Species
    from chempy.equilibria import EqSystem

    made = network().species
    present = {part for key in poured for part in made[key].components}
    reactions, names = [], {"H2O", "H+"}
    for acid, base in _STEPS:
        if base is None:
            reactions.append(Equilibrium({"H2O": 1}, {"H+": 1, "OH-": 1}, 10.0 ** made[acid].log_k))
            names.add("OH-")
            continue
        if not present.issuperset(set(made[acid].components) - {PROTON, "H2O(l)"}):
            continue
        left = {_plain(acid): 1}
        extra = made[acid].components.get("H2O(l)", 0) - made[base].components.get("H2O(l)", 0)
        if extra:
            left["H2O"] = 1
        constant = 10.0 ** (made[base].log_k - made[acid].log_k)
        reactions.append(Equilibrium(left, {_plain(base): 1, "H+": 1}, constant))
        names |= {_plain(acid), _plain(base)}
    system = EqSystem(reactions, {name: Species.from_formula(name) for name in sorted(names)})
    start: dict[str, float] = defaultdict(float, {"H2O": 1.0, "H+": 1e-7, "OH-": 1e-7})
    for key, molar in poured.items():
        if _plain(key) in names:
            start[_plain(key)] += molar
    # chempy counts water as a solute: its constants are divided by the concentration of water.
    for one in reactions:
        if "H2O" in one.reac:
            one.param = one.param / _WATER
    start["H2O"] = _WATER
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            answer, _, sane = system.root(start)
        except ValueError:  # it finds no way to write the equations
            return None
    if not sane:
        return None
    return -math.log10(float(answer[system.as_substance_index("H+")]))


def _plain(key: str) -> str:
    formula = parse(key.removesuffix("(aq)"))
    body = formula.text.split("^")[0]
    if not formula.charge:
        return body
    size = abs(formula.charge)
    return f"{body}{'+' if formula.charge > 0 else '-'}{size if size > 1 else ''}"


@pytest.mark.parametrize(
    "mixtures", [15, pytest.param(200, marks=pytest.mark.slow)], ids=["some", "all"]
)
def test_ph_agrees_with_chempy_on_random_mixtures(mixtures: int) -> None:
    rng = np.random.default_rng(20)
    compared = given_up = 0
    while compared < mixtures:
        poured: dict[str, float] = {}
        for index in rng.choice(len(_SOLUTES), rng.integers(1, 5), replace=False):
            molar = 10.0 ** rng.uniform(-3.0, -0.3)
            for key, n in _SOLUTES[index].items():
                poured[key] = poured.get(key, 0.0) + n * molar
        # Gases stay in and no solid forms: chempy is asked for the solution alone.
        ours = settle(poured, _LITRE, 298.15, open_system=False)
        if any(not key.endswith(("(aq)", "(l)")) for key in ours):
            continue
        theirs = _chempy_ph(poured)
        if theirs is None:
            given_up += 1
            continue
        assert ph_of(ours, _LITRE) == pytest.approx(theirs, abs=0.05), poured
        compared += 1
    assert given_up <= mixtures // 5


def test_phases_are_saturated_or_absent() -> None:
    made = network()
    poured = {"Ba^2+(aq)": 0.01, "Ca^2+(aq)": 0.01, "SO4^2-(aq)": 0.012, "CO3^2-(aq)": 0.005}
    settled = settle(poured, _LITRE, 298.15, open_system=True)
    for key in ("BaSO4(s)", "BaCO3(s)", "CaCO3(s)", "CaSO4·2H2O(s)"):
        one = made.species[key]
        product = sum(
            n * math.log10(settled[part] / (_LITRE * 1000.0))
            for part, n in one.components.items()
            if part != "H2O(l)"
        )
        if settled.get(key, 0.0) > 0.0:
            assert product == pytest.approx(-one.log_k, abs=1e-6)
        else:
            assert product < -one.log_k
    assert settled["BaSO4(s)"] > 0.0


def test_totals_that_nothing_holds_are_an_error() -> None:
    one = np.array([[1.0]])
    with pytest.raises(NoEquilibriumError, match="no equilibrium"):
        solve(np.zeros(1), one, np.zeros(0), np.zeros((0, 1)), np.array([np.nan]))


def _printed() -> list[Any]:
    made = network()
    cases = []
    for substance in substances().values():
        if substance.log_ksp is None or substance.phase != "solid":
            continue
        key = made.same(substance.formula, "s")
        if key is not None and not made.species[key].is_component:
            cases.append(pytest.param(substance.id, key, id=substance.id))
    return cases


@pytest.mark.parametrize(("name", "key"), _printed())
def test_solubility_products_are_those_of_the_table(name: str, key: str) -> None:
    made, substance = network(), substances()[name]
    ions = sum(
        n * (made.dissolved(ion).log_k if ion != "H2O" else 0.0)
        for ion, n in substance.ions.items()
    )
    assert substance.log_ksp is not None
    assert made.species[key].log_k - ions == pytest.approx(-substance.log_ksp, abs=0.011)


def test_acid_constants_are_those_of_the_table() -> None:
    made = network()
    for substance in substances().values():
        for step in substance.acidity:
            acid, base = made.same(step.acid, "aq"), made.same(step.base, "aq")
            if acid is None or base is None or step.pka < 0 or step.acid == "H2O":
                continue
            pka = made.species[acid].log_k - made.species[base].log_k
            assert pka == pytest.approx(step.pka, abs=0.011), (substance.id, step.acid)


def test_every_species_has_the_atoms_of_what_it_is_made_of() -> None:
    made = network().species
    for key, one in made.items():
        atoms: dict[str, float] = {}
        charge = 0.0
        for part, n in one.components.items():
            charge += n * made[part].composition.charge
            for element, count in made[part].composition.atoms.items():
                atoms[element] = atoms.get(element, 0.0) + n * count
        assert {e: n for e, n in atoms.items() if n} == dict(one.composition.atoms), key
        assert charge == one.composition.charge, key


@pytest.mark.parametrize(("of", "molar"), [("sucrose", 1.0), ("glucose", 1.0), ("urea", 5.0)])
def test_what_dissolves_well_stays_dissolved_in_a_room_of_20_degrees(of: str, molar: float) -> None:
    """2000, 909 and 1079 g/l dissolve (CRC Handbook); their enthalpy in water is not known."""
    solutes = (Solute(of, molar),)
    inventory = Inventory.of([solutes])
    held = inventory.amounts(inventory.filled(solutes, 1e-3))
    assert max(held[key] for key in held if key.endswith("(aq)")) == pytest.approx(molar)
