"""Gas evolution: an acid frees a gas from a salt, or a base frees ammonia.

Source of the rule: Brown, LeMay et al., Chemistry: The Central Science, acid-base reactions with
gas formation; Henry's constants of Sander (2015).
"""

from labutopia_lerobot.chemistry.change import Change
from labutopia_lerobot.chemistry.network import network

KIND = "gas evolution"


def explains(change: Change) -> str | None:
    """Return why gas leaves here, or None if it does not."""
    made = network().species
    gases = [made[key].name for key in change.products if made[key].phase == "g"]
    if not gases:
        return None
    return f"{' and '.join(gases)} exceeds its solubility and leaves."
