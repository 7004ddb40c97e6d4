"""An energy regulator: it feeds a heater a share of its power, and measures nothing."""

from dataclasses import dataclass
from typing import override

from labutopia_lerobot.processes.heat import ThermalMass
from labutopia_lerobot.processes.process import Apparatus, Process, ProcessError
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class EnergyRegulator(Process):
    """What a knob without a thermometer does: its reading is the power that it lets through [W].

    A real one switches all the power on and off every half minute or so; this gives its mean.

    Attributes:
        name: What its reading is called.
        heats: Name of the thermal mass that its heater is in.
        watt: Power of the heater [W].
        switch: Name of the reading that is 1 while it is on, or the time [s] that it stays on.
        share: Name of the reading, from 0 to 1, that says which share of it is wanted; all of it
            if none is named.
    """

    name: str
    heats: str
    watt: float
    switch: str
    share: str = ""

    @override
    def step(self, apparatus: Apparatus) -> None:
        heated = apparatus.processes.get(self.heats)
        if not isinstance(heated, ThermalMass):
            raise ProcessError(f"'{self.name}' heats '{self.heats}', which is no ThermalMass")
        apparatus.memory(heated)[1] += self.reading(apparatus).value * apparatus.period

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        on = apparatus.reading(self.switch).value > 0.5
        share = apparatus.reading(self.share).value if self.share else 1.0
        return Reading(self.watt * share if on else 0.0, "W")
