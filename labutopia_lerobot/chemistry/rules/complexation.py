"""Complexation: ligands take the place of water at a metal ion.

Source of the rule: Housecroft and Sharpe, Inorganic Chemistry, stability constants; their values
are those of Smith and Martell, Lange's Handbook and Harris (`data/species.json`).
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import network

KIND = "complexation"


def explains(change: Change) -> str | None:
    """Return why a complex forms here, or None if none does."""
    made = network().species
    names = [made[key].name for key in change.products if made[key].is_complex]
    if not names or any(made[key].is_complex for key in change.reactants):
        return None
    return f"{' and '.join(names)} is stable enough to form (its stability constant)."
