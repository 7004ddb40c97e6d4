"""Neutralization: an acid gives protons to a base.

Source of the rule: Brown, LeMay et al., Chemistry: The Central Science, acid-base reactions; the
constants are those of the CRC Handbook and of Harris.
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import network

KIND = "neutralization"


def explains(change: Change) -> str | None:
    """Return who gives protons to whom; any other exchange in solution counts as well."""
    made = network().species
    names = " and ".join(made[key].name for key in change.reactants if key != "H2O(l)")
    return f"Protons go from acid to base: {names} react."
