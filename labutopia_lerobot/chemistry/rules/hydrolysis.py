"""Hydrolysis: an ion of a salt, or an oxide, takes a proton from water or gives one to it.

Source of the rule: Atkins, Jones and Laverman, Chemical Principles, salts in water.
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network

KIND = "hydrolysis"


def explains(change: Change) -> str | None:
    """Return why water acts on something here, or None if it does not."""
    made = network().species
    others = [key for key in change.reactants if key != WATER]
    if len(others) != 1 or PROTON in change.reactants or HYDROXIDE in change.reactants:
        return None
    moved = PROTON in change.products or HYDROXIDE in change.products
    if not moved or not (WATER in change.reactants or made[others[0]].phase == "aq"):
        return None
    return f"{made[others[0]].name} exchanges a proton with water."
