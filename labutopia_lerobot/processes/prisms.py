"""Prisms of a refractometer: the refractive index of what lies between them."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.chemistry.refraction import refractive_index
from labutopia_lerobot.processes.process import Apparatus, Process
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class Prisms(Process):
    """The index of the film between two prisms, which a drop on the lower one becomes.

    While they are open it takes note of what lies on the lower one; what lay there when they were
    shut stays between them as a film, thinner than a particle of liquid, until they are opened.
    Dashes while they are open, where nothing lay there, and where the index is not known.

    Attributes:
        name: What its reading is called.
        stage: Name of the frame in the middle of the lower prism's surface.
        hinge: Joint of the upper one [rad].
        shut_within: Where that counts as shut [rad].
    """

    name: str
    stage: str
    hinge: str
    shut_within: float = math.radians(5.0)

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("between",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = self._lying(apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        if not self._shut(apparatus):
            apparatus.memory(self)[:] = self._lying(apparatus)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        (between,) = apparatus.memory(self)
        index = float(between) if between and self._shut(apparatus) else math.nan
        return Reading(index, "nD", 0.0001)

    def _shut(self, apparatus: Apparatus) -> bool:
        return apparatus.joint(self.hinge) <= self.shut_within

    def _lying(self, apparatus: Apparatus) -> float:
        """Return the index of what lies on the lower prism; 0 for nothing, or nothing known."""
        if apparatus.liquid is None:
            return 0.0
        drop = apparatus.liquid.drop_at(apparatus.site(self.stage).position_w)
        if drop is None:
            return 0.0
        index = refractive_index(drop.concentrations, drop.temperature)
        return 0.0 if math.isnan(index) else index
