"""A conductivity meter with a cell on an arm."""

from dataclasses import dataclass

from labutopia_lerobot.labware.instruments.measuring.ph_meter import TIP, PhMeter
from labutopia_lerobot.labware.parts.form import Form, Rod
from labutopia_lerobot.processes import ConductivityCell


@dataclass(frozen=True)
class ConductivityMeter(PhMeter):
    """A conductivity meter, built as a pH meter: its cell is pushed down into a beaker.

    It shows the conductivity around the cell's tip at 25 C, dashes while that is in no solution.
    """

    source = "180 x 200 x 80 mm, cell of 12 x 160 mm, as usual; from memory"

    @property
    def reads(self) -> ConductivityCell:
        """What its display shows."""
        return ConductivityCell(f"{self.name}_conductivity", f"{self.name}_tip")

    def _probe(self) -> list[Form]:
        return [
            Rod((0, 0, TIP), (0, 0, 0.140), 0.012, "black"),
            Rod((0, 0, TIP + 0.006), (0, 0, TIP + 0.010), 0.0124, "steel"),
            Rod((0, 0, TIP + 0.016), (0, 0, TIP + 0.020), 0.0124, "steel"),
            Rod((0, 0, 0.140), (0, 0, 0.160), 0.014, "anthracite"),
            Rod((0, 0, 0.160), (0, 0, 0.175), 0.006, "black"),
        ]
