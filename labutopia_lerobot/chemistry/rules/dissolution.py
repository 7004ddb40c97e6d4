"""Dissolution: a solid or a gas goes into solution as it is, or as its ions.

Source of the rule: Atkins, Jones and Laverman, Chemical Principles, enthalpy of solution.
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network

KIND = "dissolution"


def explains(change: Change) -> str | None:
    """Return that something dissolves here, or None if it does not."""
    made = network().species
    pure = [key for key in change.reactants if made[key].phase != "aq" and key != WATER]
    others = [key for key in change.reactants if key not in pure and key != WATER]
    ions = [key for key in change.products if key != WATER]
    if len(pure) != 1 or others or any(made[key].phase != "aq" for key in ions):
        return None
    if WATER in change.reactants and (HYDROXIDE in ions or PROTON in ions):
        return None
    return f"{made[pure[0]].name} dissolves."
