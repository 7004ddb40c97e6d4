"""Drawing in: what a pipette or a syringe takes in at its tip and gives out, through its air."""

import math
from dataclasses import dataclass
from typing import override

import numpy as np

from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.processes.liquid_handling import LiquidHandling, Stock
from labutopia_lerobot.world import Pose, Reading

_PRESSURE = 101325.0
"""Of the room [Pa] (standard atmosphere)."""
_TEMPERATURE = 293.15
"""Of the room [K] (20 C, at which volumetric ware is adjusted, ISO 384; from memory)."""
_GRAVITY = 9.81
"""Acceleration of free fall [m/s^2], as in MuJoCo."""


@dataclass(frozen=True)
class Drawing(Process):
    """The liquid in a pipette [ml], below a cushion of air that its piston moves.

    The cushion obeys Boyle's and Gay-Lussac's laws: it carries the column, so that a pipette that
    is raised from a slant, or warmed, pushes some of it out. In air the meniscus at the tip holds
    as much as Laplace's pressure, 2 * surface tension / radius, either way.

    Attributes:
        name: What its reading is called.
        piece: Name of the pipette.
        joints: Slides whose positions add up to the stroke [m].
        area: By how much the cushion's room grows with the stroke [m^2]; negative where pressing
            empties it.
        room: The cushion's room at stroke 0, without liquid [m^3].
        tip: Name of the frame at the end of the tip, z the way that liquid leaves.
        radius: Inside of the tip [m].
        section: Mean cross-section of the column [m^2].
        gives: By how much what encloses the cushion grows with its pressure [m^3/Pa]: a bulb.
    """

    name: str
    piece: str
    joints: tuple[str, ...]
    area: float
    room: float
    tip: str
    radius: float
    section: float
    gives: float = 0.0

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        """Liquid, and air below it [m^3]; gas of the cushion [J/K]; its temperature [K]."""
        return ("liquid", "gap", "gas", "temperature")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with air, as warm as the room."""
        gas = _PRESSURE * self._room(apparatus) / _TEMPERATURE
        apparatus.memory(self)[:] = 0.0, 0.0, gas, _TEMPERATURE

    @override
    def step(self, apparatus: Apparatus) -> None:
        """Let the cushion push or pull what is below it."""
        memory, tip, liquid = apparatus.memory(self), apparatus.site(self.tip), apparatus.liquid
        inside, gap, gas, temperature = memory.tolist()
        near = None if liquid is None else liquid.near(tip.position_w)
        held = None if liquid is None else liquid.stock(self.piece, tip.position_w)
        room, per_gas = self._room(apparatus), _PRESSURE / temperature
        if near is not None and gap:  # the air at the tip rises to the cushion
            gas, gap = gas + per_gas * gap, 0.0
        change = self._change(room, inside, gap, gas * temperature, tip, near, held)
        if not inside and near is None:
            gas, gap = per_gas * room, 0.0
        elif change > 0.0 and near is not None:
            inside += change
        elif change > 0.0:
            gap += change
        else:
            first = min(gap, -change)
            out = min(inside, -change - first)
            gas -= per_gas * (-change - first - out)
            gap, inside = gap - first, inside - out
        if liquid is not None:
            short = self._move(liquid, inside, tip)
            if near is None and short > liquid.particle:  # it drew air
                inside, gap = inside - short, gap + short
        memory[:] = inside, gap, gas, temperature

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[0]) * 1e6, "ml", 0.001)

    def _room(self, apparatus: Apparatus) -> float:
        """Return what is above the tip [m^3]."""
        # A stop gives way by some hundredths of a millimetre, which is no stroke.
        stroke = sum(max(0.0, apparatus.joint(joint)) for joint in self.joints)
        return self.room + self.area * stroke

    def _change(
        self,
        room: float,
        inside: float,
        gap: float,
        energy: float,
        tip: Pose,
        near: Stock | None,
        held: Stock | None,
    ) -> float:
        """Return by how much what is below the cushion grows [m^3]; `energy` is its p V [J]."""
        below, head, meniscus = inside + gap, 0.0, 0.0
        if held is not None:
            head = held.density * _GRAVITY * inside / self.section * -float(tip.z_axis[2])
            if near is None:
                meniscus = 2 * held.surface_tension / self.radius
        least = room - energy / (_PRESSURE - head - meniscus) - self.gives * (head + meniscus)
        most = room - energy / (_PRESSURE - head + meniscus) - self.gives * (head - meniscus)
        return min(max(below, least), most) - below

    def _move(self, liquid: LiquidHandling, inside: float, tip: Pose) -> float:
        """Move whole particles, so that they are what is inside, rounded.

        Returns:
            Volume that is missing of it [m^3].
        """
        stock = liquid.stock(self.piece, tip.position_w)
        volume = 0.0 if stock is None else stock.volume
        count = round((inside - volume) / liquid.particle)
        if count > 0:
            volume += liquid.particle * liquid.draw(self.piece, count, tip.position_w)
        elif count < 0:
            speed = min(1.0, -count * liquid.particle * 30 / (math.pi * self.radius**2))
            liquid.let_out(self.piece, tip.position_w, -count, tip, speed)
            return 0.0
        return inside - volume
