"""Precipitation: ions meet whose solubility product is exceeded.

Source of the rule: Brown, LeMay et al., Chemistry: The Central Science, solubility equilibria; the
products are those of the CRC Handbook and of Lange's Handbook.
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import network

KIND = "precipitation"


def explains(change: Change) -> str | None:
    """Return why this is a precipitation, or None if it is none."""
    made = network().species
    solids = [made[key] for key in change.products if made[key].phase == "s"]
    if not solids or all(made[key].phase == "s" for key in change.reactants):
        return None
    names = " and ".join(one.name for one in solids)
    return f"The solubility product of {names} is exceeded."
