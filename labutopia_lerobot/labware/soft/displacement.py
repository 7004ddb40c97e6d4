"""Squeezing: what leaves a bottle as the volume inside its wall falls."""

from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.soft.elastic_shell import Shell, enclosed_volume
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import Reading


@dataclass(frozen=True)
class Squeezing(Process):
    """The liquid that has left a bottle, from its deformed wall [ml].

    Liquid is incompressible: once the spout is full, as much leaves as the enclosed volume falls.
    When the wall comes back, the spout empties first, and after that air enters through it: nothing
    that has left returns, and each further stroke gives as much as it takes the wall in, less the
    spout's volume.

    Attributes:
        name: What its reading is called.
        bottle: The bottle.
        shell: Its wall.
        wall: Name of the flex of the wall.
        spout_volume: Volume of the spout's bore, which fills before anything leaves [m^3].
    """

    name: str
    bottle: Dispenser
    shell: Shell
    wall: str
    spout_volume: float

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """The enclosed volume at which the liquid stands at the spout's end; what has left."""
        return ("level", "left")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with an empty spout and nothing given away."""
        apparatus.memory(self)[:] = self._enclosed(apparatus) - self.spout_volume, 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let out what the wall has displaced since the last step."""
        memory = apparatus.memory(self)
        level, left = memory
        volume = self._enclosed(apparatus)
        leaving = max(0.0, level - volume)
        # The spout holds liquid over a play of its own volume: full at `level`, empty above it.
        memory[0] = max(level - leaving, volume - self.spout_volume)
        memory[1] = min(left + leaving, self.bottle.contents)
        if apparatus.liquid is not None:
            spout = apparatus.site(self.bottle.spout)
            apparatus.liquid.dispense(self.bottle, memory[1], spout, apparatus.period)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[1]) * 1e6, "ml", 0.1)

    def _enclosed(self, apparatus: Apparatus) -> float:
        """Return the volume inside the wall now [m^3]."""
        model = apparatus.model
        flex = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_FLEX, self.wall)
        first = model.flex_vertadr[flex]
        vertices = apparatus.data.flexvert_xpos[first : first + model.flex_vertnum[flex]]
        return enclosed_volume(vertices, self.shell.triangles)
