"""What solutions are once they have been poured together: what a task is judged by, beforehand."""

from collections.abc import Iterable, Sequence

import numpy as np

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Inventory, Solute
from labutopia_lerobot.chemistry.speciation import ph_of

_ZERO_C = 273.15
_ROOM = 20.0
"""Temperature of the room [degrees C]."""


def ph_together(
    parts: Iterable[tuple[Sequence[Solute], float]], celsius: float | None = None
) -> float:
    """Return the pH of solutions in water that have been poured together and stirred.

    Args:
        parts: Of each its solutes and its volume [ml].
        celsius: How warm they are [degrees C]; None for as warm as the room.

    Raises:
        NotDissolvedError: A compound does not dissolve, or not as much of it.
    """
    held = [(solutes, 1e-6 * ml) for solutes, ml in parts]
    inventory = Inventory.of([solutes for solutes, _ in held])
    rows = [inventory.filled(solutes, volume) for solutes, volume in held]
    total = sum(volume for _, volume in held)
    settled, _ = inventory.settled(
        np.sum(rows, axis=0), total, (_ROOM if celsius is None else celsius) + _ZERO_C
    )
    return ph_of(inventory.amounts(settled), total)


def density(solutes: Sequence[Solute]) -> float:
    """Return the mass of a volume of a solution in water [kg/m^3], as `Solutions.masses` has it.

    Args:
        solutes: Those of the solution.

    Raises:
        NotDissolvedError: A compound does not dissolve, or not as much of it.
    """
    inventory = Inventory.of([solutes])
    return float(inventory.filled(solutes, 1.0) @ inventory.molar_masses)


def solid_at(solutes: Sequence[Solute], crystals: Crystals, ml: float, celsius: float) -> float:
    """Return how much of some crystals is left in a solution in the end, or comes back [mol].

    Args:
        solutes: Those of the solution.
        crystals: Those that lie in it.
        ml: Its volume [ml].
        celsius: How warm it is [degrees C].

    Raises:
        NotDissolvedError: A compound does not dissolve, or not as much of it.
    """
    volume, inventory = 1e-6 * ml, Inventory.of([solutes], [crystals.species])
    row = inventory.filled(solutes, volume) + inventory.row({crystals.species: crystals.mol})
    settled, _ = inventory.settled(row, volume, celsius + _ZERO_C)
    return inventory.amounts(settled).get(crystals.species, 0.0)
