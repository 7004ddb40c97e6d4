"""A power supply: it drives a current through a bath, which gets warm."""

from dataclasses import dataclass
from typing import override

from labutopia_lerobot.labware.parts.drive import all_on, set_value
from labutopia_lerobot.processes import Apparatus, Process, ThermalMass
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class PowerSupply(Process):
    """A supply of constant voltage; its reading is the current [mA], by Ohm's law.

    All its power becomes heat in what the current goes through (Joule).

    Attributes:
        name: What its reading is called.
        voltage: What it is set to [V].
        resistance: Of what the current goes through [ohm].
        heats: What that is.
        on: Names of readings that must all be above 0: switch, lid.
    """

    name: str
    voltage: Process
    resistance: float
    heats: ThermalMass
    on: tuple[str, ...]

    @override
    def step(self, apparatus: Apparatus) -> None:
        amperes = self.reading(apparatus).value / 1000.0
        if amperes:
            watt = self.resistance * amperes**2
            apparatus.memory(self.heats)[1] += watt * apparatus.period

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        volts = set_value(self.voltage, apparatus) if all_on(apparatus, self.on) else 0.0
        return Reading(1000.0 * volts / self.resistance, "mA", 1.0)
