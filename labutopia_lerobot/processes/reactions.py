"""Reactions: what is dissolved mixes and reacts by itself."""

from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes.process import Apparatus, Process

_EVERY = 8
"""Control steps from one mixing to the next, almost four in a second; ours: every layer of a vessel
is an equilibrium to solve, which takes 0.12 ms."""


@dataclass(frozen=True)
class Reactions(Process):
    """All that happens in the solutions of a scene.

    Attributes:
        name: What it is called; it has no reading.
    """

    name: str = "reactions"

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("steps",)

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin just after a mixing."""
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        memory[0] = (memory[0] + 1.0) % _EVERY
        if apparatus.liquid is not None and memory[0] == 0.0:
            apparatus.liquid.react(_EVERY * apparatus.period)
