"""Reactions: what is dissolved mixes and reacts by itself."""

from dataclasses import dataclass
from typing import override

from labutopia_lerobot.processes.process import Apparatus, Process


@dataclass(frozen=True)
class Reactions(Process):
    """All that happens in the solutions of a scene.

    Attributes:
        name: What it is called; it has no reading.
    """

    name: str = "reactions"

    @override
    def step(self, apparatus: Apparatus) -> None:
        if apparatus.liquid is not None:
            apparatus.liquid.react(apparatus.period)
