"""Questions to the engine and its answers: portions, conditions, reactions, amounts."""

from dataclasses import dataclass
from typing import Literal

Phase = Literal["aq", "solid", "gas"]
"""The paper's three. A liquid counts as ``aq``: it is, or mixes with, the solvent."""

Yield = Literal["high", "medium", "low"]


@dataclass(frozen=True)
class Reactant:
    """Some of a compound that is poured in.

    Attributes:
        compound: Name, formula, synonym or id, as a person writes it.
        amount: Amount of substance [mol]; None for ``Conditions.concentration * volume``.
        volume: Volume of the solution that brings it [m^3]; 0 for a pure solid or gas. Of water
            that has an amount it follows from that.
    """

    compound: str
    amount: float | None = None
    volume: float = 1e-4


@dataclass(frozen=True)
class Conditions:
    """How it is done. The defaults are the paper's example (appendix, listing of the prompt).

    Attributes:
        solvent: Compound that the others are dissolved in.
        temperature: Temperature of everything before it meets [K].
        concentration: Of each portion whose amount is not said [mol/m^3]; 100 is 0.1 M.
        open_system: Whether gas leaves.
        catalysts: Compounds that are present and come out unchanged.
        ph: What the mixture is kept at, by a buffer that is not modelled; None to work it out.
    """

    solvent: str = "water"
    temperature: float = 298.15
    concentration: float = 100.0
    open_system: bool = True
    catalysts: tuple[str, ...] = ()
    ph: float | None = None


@dataclass(frozen=True)
class Product:
    """A compound that a reaction makes, in the paper's words."""

    compound_name: str
    chemical_formula: str
    phase: Phase
    qualitative_yield: Yield | None


@dataclass(frozen=True)
class Reaction:
    """One reaction, in the paper's words and order (appendix, "Process Reasoning Pipeline")."""

    reaction_id: str
    reaction_type: str
    stoichiometry: str
    expected_products: tuple[Product, ...]
    observable_changes: tuple[str, ...]
    confidence_score: float
    rationale: str


@dataclass(frozen=True)
class Amounts:
    """The numbers behind the reactions, which the paper's form has no place for.

    Attributes:
        before: Amount of each species before anything reacts, by formula with charge and phase,
            for example ``Cu^2+(aq)`` [mol].
        after: The same, afterwards [mol].
        extents: Extent of each reaction, by ``reaction_id`` [mol].
        heat: Heat that is given off, at constant pressure [J].
        temperature: Temperature afterwards, nothing lost to the vessel [K].
        volume: Volume of the liquid afterwards [m^3].
        ph: pH afterwards; None without water.
        colour: sRGB of 1 cm of the clear solution before white, each in [0, 1].
        turbid: Whether solid floats in it.
    """

    before: dict[str, float]
    after: dict[str, float]
    extents: dict[str, float]
    heat: float
    temperature: float
    volume: float
    ph: float | None
    colour: tuple[float, float, float]
    turbid: bool


@dataclass(frozen=True)
class Outcome:
    """What happens, and how much of it.

    Attributes:
        reactions: In the paper's form; empty where nothing happens.
        amounts: The numbers.
        note: What a reader should know of how this was inferred; empty if nothing.
    """

    reactions: tuple[Reaction, ...]
    amounts: Amounts
    note: str = ""
