"""Dosing: what a plunger pushes out of a syringe."""

from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class Dosing(Process):
    """The liquid that has left a syringe since the episode began [ml].

    Liquid is incompressible: as much leaves as the plunger goes further than it has been. A plunger
    that is drawn back takes in air, and gives nothing until it is where it was.

    Attributes:
        name: What its reading is called.
        syringe: What the liquid leaves.
        joint: Slide of the plunger [m].
        bore: Cross-section of the syringe's barrel [m^2].
    """

    name: str
    syringe: Dispenser
    joint: str
    bore: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """Where the plunger began, and the furthest that it has come [m]."""
        return ("began", "furthest")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with nothing given away."""
        apparatus.memory(self)[:] = apparatus.joint(self.joint)

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let out what the plunger has displaced since the last step."""
        memory = apparatus.memory(self)
        memory[1] = max(memory[1], apparatus.joint(self.joint))
        if apparatus.liquid is not None:
            spout = apparatus.site(self.syringe.spout)
            apparatus.liquid.dispense(self.syringe, self._given(apparatus), spout, apparatus.period)

    def _given(self, apparatus: Apparatus) -> float:
        """Return what the plunger has displaced [m^3]."""
        began, furthest = apparatus.memory(self)
        return min(self.bore * float(furthest - began), self.syringe.contents)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(1e6 * self._given(apparatus), "ml", 0.01)
