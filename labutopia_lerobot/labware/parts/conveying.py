"""Conveying: what a pump draws in at the end of one hose and gives out at the end of the other."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.labware.parts.drive import Pumping
from labutopia_lerobot.processes import Apparatus


@dataclass(frozen=True)
class Conveying(Pumping):
    """A pump whose hoses are full from the start: what goes in at one end comes out at the other.

    Its reading is what its drive would deliver; it delivers no liquid while its inlet is in air.

    Attributes:
        piece: Name of the pump.
        inlet: Name of the frame at the end of its suction hose.
        outlet: Name of the frame at the end of its delivery hose, z the way that liquid leaves.
        radius: Inside of the hose [m].
    """

    piece: str
    inlet: str
    outlet: str
    radius: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """What the head has squeezed on and no whole particle has followed yet [m^3]."""
        return ("due",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with nothing due."""
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Move the particles that are due."""
        memory, liquid = apparatus.memory(self), apparatus.liquid
        flow = self.reading(apparatus).value * 1e-6 / 60.0  # m^3/s
        if liquid is None or not flow:
            return
        inlet, outlet = apparatus.site(self.inlet).position_w, apparatus.site(self.outlet)
        if liquid.near(inlet) is None:
            memory[0] = 0.0  # air
            return
        memory[0] += flow * apparatus.period
        count = int(memory[0] / liquid.particle)
        if count:
            drawn = liquid.draw(self.piece, count, inlet)
            liquid.let_out(self.piece, inlet, drawn, outlet, flow / (math.pi * self.radius**2))
            memory[0] -= count * liquid.particle
