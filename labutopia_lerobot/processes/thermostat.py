"""A thermostat: it feeds a heater, or a chiller, as its thermometer says."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes.heat import CELSIUS, ThermalMass
from labutopia_lerobot.processes.process import Apparatus, Process, ProcessError
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.world import Reading

_AJAR = math.radians(2.0)
"""Position up to which a door counts as shut [rad]."""


@dataclass(frozen=True)
class Thermostat(Process):
    """A thermometer and a proportional controller; its reading is what the thermometer says.

    The power falls from all to none over a band below the set point, as a controller's duty does.

    Attributes:
        name: What its reading is called.
        heats: Name of the thermal mass that its heater is in.
        watt: Power of the heater [W]; below 0 of a chiller.
        set_to: The set point [degrees C], or the name of the reading that gives it.
        switch: Name of the reading that is 1 while it is on; none for what is always on.
        senses: Name of the mass that its thermometer is in; that which it heats if none is named.
        band: Over which the power falls [K]; ours.
        lag: Time constant of the thermometer [s]; ours: a Pt100 of 3 mm in metal takes seconds.
        resolution: Step of the last digit [K].
        door: Hinge of a door [rad]; while it is open the display writes the warning instead.
        warning: That text.
    """

    name: str
    heats: str
    watt: float
    set_to: float | str
    switch: str = ""
    senses: str = ""
    band: float = 4.0
    lag: float = 2.0
    resolution: float = 1.0
    door: str = ""
    warning: str = ""

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("sensed", "duty")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        begins = _mass(apparatus, self.senses or self.heats).temperature(apparatus)
        apparatus.memory(self)[:] = begins, 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        now = _mass(apparatus, self.senses or self.heats).temperature(apparatus)
        if now != memory[0]:
            memory[0] += -math.expm1(-apparatus.period / self.lag) * (now - memory[0])
        memory[1] = 0.0
        if self.on(apparatus):
            short = math.copysign(1.0, self.watt) * (self.set_point(apparatus) - memory[0])
            memory[1] = min(max(short / self.band, 0.0), 1.0)
            heated = _mass(apparatus, self.heats)
            apparatus.memory(heated)[1] += self.watt * memory[1] * apparatus.period

    def on(self, apparatus: Apparatus) -> bool:
        """Return whether it is switched on."""
        return not self.switch or apparatus.reading(self.switch).value > 0.5

    def set_point(self, apparatus: Apparatus) -> float:
        """Return the temperature that it holds [K]."""
        given = self.set_to
        celsius = given if isinstance(given, int | float) else apparatus.reading(given).value
        return celsius + ZERO_C

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        memory = apparatus.memory(self)
        settled = abs(memory[0] - self.set_point(apparatus)) < self.band
        return Reading(float(memory[0] - ZERO_C), CELSIUS, self.resolution, bool(settled))

    @override
    def text(self, apparatus: Apparatus) -> str:
        if self.warning and apparatus.joint(self.door) > _AJAR:
            return self.warning
        return super().text(apparatus)


def _mass(apparatus: Apparatus, name: str) -> ThermalMass:
    mass = apparatus.processes.get(name)
    if not isinstance(mass, ThermalMass):
        raise ProcessError(f"A thermostat heats '{name}', which is no ThermalMass of its piece")
    return mass
