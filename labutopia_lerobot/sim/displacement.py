"""Volume that a squeezed bottle dispenses: the fall of the volume inside its wall."""

from typing import Protocol, runtime_checkable

import mujoco

from labutopia_lerobot.labware.soft.elastic_shell import Shell, enclosed_volume
from labutopia_lerobot.substances.filling import Dispenser
from labutopia_lerobot.world import FloatArray


@runtime_checkable
class SqueezeBottle(Dispenser, Protocol):
    """A bottle with a wall that can be pressed in."""

    @property
    def shell(self) -> Shell:
        """The wall."""
        ...

    @property
    def wall(self) -> str:
        """Name of the flex of the wall."""
        ...

    @property
    def spout_volume(self) -> float:
        """Volume of the spout's bore, which fills before anything leaves [m^3]."""
        ...


class Displacement:
    """The liquid that has left a bottle, from the deformed wall of a simulation.

    Liquid is incompressible: once the spout is full, as much leaves as the enclosed volume falls.
    When the wall comes back, the spout empties first, and after that air enters through it: nothing
    that has left returns, and each further stroke gives as much as it takes the wall in, less the
    spout's volume.

    It keeps two numbers in the state of the simulation: the enclosed volume at which the liquid
    stands at the end of the spout, and what has left [m^3].
    """

    def __init__(self, model: mujoco.MjModel, bottle: SqueezeBottle) -> None:
        self.bottle = bottle
        self._triangles = bottle.shell.triangles
        flex = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_FLEX, bottle.wall)
        first = model.flex_vertadr[flex]
        self._vertices = slice(first, first + model.flex_vertnum[flex])

    def start(self, state: FloatArray, data: mujoco.MjData) -> None:
        """Begin with an empty spout and nothing given away; `state` has shape (2,)."""
        state[:] = self.enclosed(data) - self.bottle.spout_volume, 0.0

    def update(self, state: FloatArray, data: mujoco.MjData) -> None:
        """Bring the state, shape (2,), up to the present deformation of the wall."""
        level, displaced = state
        volume = self.enclosed(data)
        leaving = max(0.0, level - volume)
        # The spout holds liquid over a play of its own volume: full at `level`, empty above it.
        state[0] = max(level - leaving, volume - self.bottle.spout_volume)
        state[1] = min(displaced + leaving, self.bottle.contents)

    def enclosed(self, data: mujoco.MjData) -> float:
        """Return the volume inside the wall now [m^3]."""
        return enclosed_volume(data.flexvert_xpos[self._vertices], self._triangles)
