"""Drains: the hole in the floor of a basin, and what has gone down it."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.processes.liquid_handling import Pool
from labutopia_lerobot.world import Reading
from labutopia_lerobot.world.model import COLLISION_GROUP

_DISCHARGE = 0.6
"""Of a sharp-edged hole (White, "Fluid Mechanics", section on obstruction meters)."""
_GRAVITY = 9.81
"""Acceleration of free fall [m/s^2], as in MuJoCo."""
_SLOPE = 0.01
"""Of a floor towards its drain; ours: usual, and a beaker on it still counts as level."""
_THICK = 0.006
"""Of a sloping floor [m]."""


@dataclass(frozen=True)
class Drain(Process):
    """A hole in the floor of a basin; its reading is what has gone down it [ml].

    The account of the liquid has it as a place of its own, by its name: what is there does not come
    back. All that stands in the basin and in no vessel is one pool, as deep as on a flat floor; it
    leaves by Torricelli's law under that head. Whole particles go when they are due, the nearest
    first: on such a slope water is at the hole within a second, and our particles creep there.

    Attributes:
        name: Of its reading, its place in the account, its frame.
        area: Of the basin's floor [m^2].
        low: Least corner of the basin in its piece's frame [m].
        high: Greatest corner [m].
        at: Middle of the hole [m].
        diameter: Of the hole [m].
    """

    name: str
    area: float
    low: Vector
    high: Vector
    at: Vector
    diameter: float

    @property
    def draws_at(self) -> str:
        """Name of the frame in the middle of the hole, z up."""
        return self.name

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return "due", "left"  # share of the next particle, volume that has left [m^3]

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        liquid = apparatus.liquid
        if liquid is None:
            return
        memory, frame = apparatus.memory(self), apparatus.site(self.name)
        low, high = np.subtract(self.low, self.at), np.subtract(self.high, self.at)
        pool = Pool(frame, low, high, self.area, _SLOPE * float(high[:2].max()))
        volume = liquid.lying_in(pool)
        if not volume:
            memory[0] = 0.0
            return
        memory[0] = min(memory[0] + self.rate(volume) * apparatus.period, volume)
        gone = liquid.run_down(self.name, int(memory[0] / liquid.particle + 1e-6), pool)
        memory += np.array([-1.0, 1.0]) * gone * liquid.particle

    def rate(self, volume: float) -> float:
        """Return how fast a volume in the basin [m^3] runs down [m^3/s]."""
        head = volume / self.area
        return _DISCHARGE * math.pi / 4 * self.diameter**2 * math.sqrt(2.0 * _GRAVITY * head)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(1e6 * float(apparatus.memory(self)[1]), "ml", 1.0)

    def add_to(self, body: mujoco.MjsBody) -> None:
        """Add its frame to the piece."""
        body.add_site(name=self.name, pos=self.at, group=COLLISION_GROUP)

    def forms(self, look: str, facets: int = 4) -> list[Form]:
        """Return a floor that slopes down to it from all sides, and what is seen of the hole.

        Args:
            look: Finish of the floor.
            facets: Flat pieces around the hole: 4 reach the walls of a rectangular basin, more the
                wall of a round one.
        """
        x, y, z = self.at
        reach = [self.high[0] - x, self.high[1] - y, x - self.low[0], y - self.low[1]]
        floor: list[Form] = []
        for facet in range(facets):
            far = reach[facet] if facets == 4 else reach[0]
            wide = reach[1 - facet % 2] if facets == 4 else far * math.tan(math.pi / facets)
            floor.append(self._slope(2 * math.pi * facet / facets, far, wide, look))
        above = z + _SLOPE * self.diameter
        rim = Rod((x, y, z - 0.002), (x, y, above), 1.5 * self.diameter, "chrome", touch=False)
        hole = Rod((x, y, z), (x, y, above + 0.0005), self.diameter, "black", touch=False)
        return [*floor, rim, hole]

    def _slope(self, angle: float, far: float, wide: float, look: str) -> Block:
        """Return a piece of the floor, from the hole outwards at an angle [rad]."""
        tilt = math.atan(_SLOPE)
        along, up = far / 2, _SLOPE * far / 2 - _THICK / 2
        x, y = self.at[0] + along * math.cos(angle), self.at[1] + along * math.sin(angle)
        z, half = self.at[2] + up, along / math.cos(tilt)
        turn = Rotation.from_euler("z", angle) * Rotation.from_euler("y", -tilt)
        a, b, c, d = (float(part) for part in turn.as_quat(scalar_first=True))
        spans = (x - half, x + half), (y - wide, y + wide), (z - _THICK / 2, z + _THICK / 2)
        return Block(*spans, look, edge=0.0, turn=(a, b, c, d))
