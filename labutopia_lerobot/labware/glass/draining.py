"""Draining: what runs out through a stopcock, by its opening, the head above it and its outlet."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.processes.liquid_handling import Stock
from labutopia_lerobot.world import FloatArray, Pose, Reading
from labutopia_lerobot.world.model import COLLISION_GROUP

_DISCHARGE = 0.6
"""Discharge coefficient of a sharp-edged hole (0.60 to 0.62 in textbooks, such as White, "Fluid
Mechanics", section on obstruction meters)."""
_GRAVITY = 9.81
"""Acceleration of free fall [m/s^2], as in MuJoCo."""
_COVER = 0.004
"""How far above its rim a stopper or a lid closes a mouth [m]; ours."""
_PLUG_DEPTH = 0.040
"""How deep below the rim the search for a stopper begins [m]; ours."""


@dataclass(frozen=True)
class Bore:
    """The way through a stopcock and down to its outlet.

    Attributes:
        plug: Diameter of the plug [m].
        hole: Diameter of the hole through it [m].
        radius: Of the outlet's bore [m].
        length: Of the outlet's bore [m].
    """

    plug: float
    hole: float
    radius: float
    length: float

    def opening(self, angle: float) -> float:
        """Return what is open of the hole [m^2] at an angle of the wing [rad]; 0 is shut.

        The mouths of the hole move along the plug's surface; what two circles of one size have in
        common is open (the area of a lens).
        """
        apart = self.plug * abs(math.sin((math.pi / 2 - angle) / 2))
        half = self.hole / 2
        if apart >= self.hole:
            return 0.0
        lens = 2 * half**2 * math.acos(apart / self.hole)
        return lens - apart / 2 * math.sqrt(self.hole**2 - apart**2)

    def rate(self, opening: float, head: float, density: float, viscosity: float) -> float:
        """Return how much runs out [m^3/s].

        The pressure of the head goes into the hole (orifice), the outlet's friction
        (Hagen-Poiseuille) and the speed of the jet (Torricelli); all carry the same flow.

        Args:
            opening: Open part of the hole [m^2].
            head: From the outlet up to the surface [m].
            density: Of the liquid [kg/m^3].
            viscosity: Of the liquid, dynamic [Pa s].
        """
        if opening <= 0.0 or head <= 0.0:
            return 0.0
        outlet = math.pi * self.radius**2
        losses = density / 2 * (1 / (_DISCHARGE * opening) ** 2 + 1 / outlet**2)
        friction = 8 * viscosity * self.length / (math.pi * self.radius**4)
        pressure = density * _GRAVITY * head
        return 2 * pressure / (friction + math.sqrt(friction**2 + 4 * losses * pressure))


@dataclass(frozen=True)
class Draining(Process):
    """The liquid that has left a vessel through its stopcock [ml].

    The surface is as high as the vessel's volume says, not as the particles lie. The rate is exact;
    whole particles leave when they are due, and what is due of the next one is remembered.

    Attributes:
        name: What its reading is called.
        vessel: Name of the vessel; its frame `<vessel>_rim` lies in its mouth.
        profile: Of its wall.
        joint: Of the stopcock.
        inlet: Name of the frame where the liquid leaves the cavity.
        outlet: Name of the frame where it comes out, z the way that it leaves.
        bore: The way between them.
        graduation: Of its scale [ml]; 0 if it has none of what has left.
        column: Whether the vessel is narrow, see `Narrow`.
        vented: Whether air gets in when the mouth is closed.
    """

    name: str
    vessel: str
    profile: Profile
    joint: str
    inlet: str
    outlet: str
    bore: Bore
    graduation: float = 0.0
    column: bool = False
    vented: bool = False

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """Share of the next particle that is due, and volume that has left [m^3]."""
        return ("due", "left")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with nothing given away."""
        apparatus.memory(self)[:] = 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let out what runs through in a period."""
        liquid = apparatus.liquid
        if liquid is None:
            return
        if self.column:
            liquid.gather(self.vessel)
        opening = self.bore.opening(apparatus.joint(self.joint))
        if not opening or (not self.vented and self._closed(apparatus)):
            return
        inlet_w = apparatus.site(self.inlet).position_w
        stock = liquid.stock(self.vessel, inlet_w)
        if stock is None:
            return
        memory, outlet = apparatus.memory(self), apparatus.site(self.outlet)
        there = stock.volume - memory[0]
        head = self._surface(apparatus, there) - float(outlet.position_w[2])
        rate = self._rate(stock, opening, head)
        leaving = min(there, rate * apparatus.period)
        memory += leaving
        last = there - leaving < 1e-6 * liquid.particle
        count = round(stock.volume / liquid.particle) if last else 0
        count = max(count, int(memory[0] / liquid.particle + 1e-6))
        if count:
            speed = rate / (math.pi * self.bore.radius**2)
            moved = liquid.let_out(self.vessel, inlet_w, count, outlet, speed)
            memory[0] = max(0.0, memory[0] - moved * liquid.particle)

    @override
    def reading(self, apparatus: Apparatus) -> Reading | None:
        if not self.graduation:
            return None
        return Reading(float(apparatus.memory(self)[1]) * 1e6, "ml", self.graduation)

    def _rate(self, stock: Stock, opening: float, head: float) -> float:
        return self.bore.rate(opening, head, stock.density, stock.viscosity)

    def _surface(self, apparatus: Apparatus, volume: float) -> float:
        """Return how high the surface is on the axis [m], world frame."""
        rim = apparatus.site(f"{self.vessel}_rim")
        level = self.profile.fill_height(min(max(volume, 0.0), self.profile.capacity))
        surface: FloatArray = rim.position_w - (self.profile.height - level) * rim.z_axis
        return float(surface[2])

    def _closed(self, apparatus: Apparatus) -> bool:
        """Return whether a stopper or a lid closes the mouth.

        Five lines of sight go up through it, one in the middle; all must end on something.
        """
        rim, height = apparatus.site(f"{self.vessel}_rim"), self.profile.height
        out = 0.5 * self.profile.inner_radius(height)
        offsets = np.array([(0, 0), (out, 0), (-out, 0), (0, out), (0, -out)])
        return all(self._covered(apparatus, rim, rim.rotation_w[:, :2] @ at) for at in offsets)

    def _covered(self, apparatus: Apparatus, rim: Pose, aside_w: FloatArray) -> bool:
        """Return whether something lies over a point of the mouth."""
        groups = np.zeros(6, dtype=np.uint8)
        groups[COLLISION_GROUP] = 1
        start = rim.position_w + aside_w - _PLUG_DEPTH * rim.z_axis
        body, hit = apparatus.model.body(self.vessel).id, np.array([-1], dtype=np.int32)
        model, data = apparatus.model, apparatus.data
        distance: float = mujoco.mj_ray(model, data, start, rim.z_axis, groups, 1, body, hit)
        return 0.0 <= distance <= _PLUG_DEPTH + _COVER
