"""A thermometer with a sensor on an arm."""

from dataclasses import dataclass

from labutopia_lerobot.labware.instruments.measuring.ph_meter import TIP, PhMeter
from labutopia_lerobot.labware.parts.form import Form, Rod
from labutopia_lerobot.processes import TemperatureSensor


@dataclass(frozen=True)
class DigitalThermometer(PhMeter):
    """A thermometer, built as a pH meter: its sensor is pushed down into a beaker.

    It shows how warm the liquid around the sensor's tip is, or else the room.
    """

    source = "180 x 200 x 80 mm, Pt1000 in a sheath of 3 mm, as usual; from memory"

    @property
    def reads(self) -> TemperatureSensor:
        """What its display shows."""
        return TemperatureSensor(f"{self.name}_temperature", f"{self.name}_tip")

    def _probe(self) -> list[Form]:
        return [
            Rod((0, 0, TIP), (0, 0, 0.090), 0.003, "steel"),
            Rod((0, 0, 0.090), (0, 0, 0.160), 0.012, "anthracite"),
            Rod((0, 0, 0.160), (0, 0, 0.175), 0.006, "black"),
        ]
