"""How heat goes from thing to thing, into liquids, into the room, and onto the hand."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, override

import mujoco
import numpy as np

from labutopia_lerobot.processes.heat import CELSIUS, HeatZone, ThermalMass
from labutopia_lerobot.processes.process import Apparatus, Process
from labutopia_lerobot.substances.substance import WATER, ZERO_C
from labutopia_lerobot.world import FloatArray, Reading

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.profile import Profile

_INTO_LIQUID = 500.0
"""From a wall to the liquid in it [W/m^2 K]: free convection of liquids is 50 to 1000 (Incropera,
Fundamentals, 6th edition, table 1.1)."""
_VAPOUR = 5.0 / (1.19 * 1007.0) / 0.85 ** (2 / 3)
"""How fast vapour leaves a free surface [m/s]: from 5 W/m^2 K of free convection of air by the
analogy of heat and mass transfer, Lewis number 0.85 (Incropera, section 6.7)."""
_EVAPORATION = 2.43e6
"""Latent heat of water at 30 C [J/kg] (Incropera, table A.6)."""
_COLDER = 2.36e3
"""Less of it for every kelvin more [J/kg K]: 2.50e6 at 0 C, 2.26e6 at 100 C (ibid.)."""
_WATER_VAPOUR = 461.5
"""Gas constant of water vapour [J/kg K]."""
_HUMIDITY = 0.5
"""Of the room's air, relative; ours."""
_BOILS = 0.05
"""How far below its boiling point a liquid counts as boiling [K]; ours: a step's rounding."""


@dataclass(frozen=True)
class HeatExchange(Process):
    """Everything that is warm in a scene: the one process that moves heat.

    Pairs exchange exactly what lets their difference decay over a step: what one gives the other
    gets, and no conductance is too large for the step. Its reading is the temperature of the
    hottest surface that the hand touches, no number where it touches none.

    Attributes:
        masses: All that has a temperature.
        hand: Body that the fingers hang on.
        name: What its reading is called.
    """

    masses: tuple[ThermalMass, ...]
    hand: str
    name: str = "surface_at_hand"

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("supplied", "lost", "touched", "evaporated")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        apparatus.memory(self)[:] = 0.0
        if apparatus.liquid is not None:
            apparatus.liquid.warm_to(apparatus.ambient)
            if not apparatus.liquid.all_at(apparatus.ambient):
                self._begin_with_the_liquid(apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        if self._calm(apparatus):
            return
        memory = apparatus.memory(self)
        self._take_supply(apparatus, memory)
        for mass in self.masses:
            for name, conductance in mass.links:
                self._exchange(apparatus, mass, self._by_name[name], conductance)
        for mass in self.masses:
            around = self._meet(apparatus, mass) if mass.wall is not None else False
            if mass.wall is not None:
                latent = self._into_liquid(apparatus, mass, around)
                memory[1] += latent
                if latent:
                    memory[3] += self._shrink(apparatus, mass, latent)
            if not around:
                memory[1] += self._lose(apparatus, mass)
        if apparatus.liquid is not None:
            apparatus.liquid.mix(apparatus.period)
        memory[2] = self._touched(apparatus)

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        touched = float(apparatus.memory(self)[2])
        return Reading(touched - ZERO_C if touched else math.nan, CELSIUS, 0.1)

    def _begin_with_the_liquid(self, apparatus: Apparatus) -> None:
        """Let every vessel begin as warm as what it holds."""
        for mass in self.masses:
            held = None if apparatus.liquid is None else apparatus.liquid.warmth(mass.body)
            if mass.wall is not None and held is not None:
                apparatus.memory(mass)[0] = held.temperature

    @cached_property
    def _by_name(self) -> dict[str, ThermalMass]:
        return {mass.name: mass for mass in self.masses}

    def _calm(self, apparatus: Apparatus) -> bool:
        """Return whether nothing is warmer than the room, and nothing is heated."""
        for mass in self.masses:
            memory = apparatus.memory(mass)
            if memory[0] != apparatus.ambient or memory[1] != 0.0:
                return False
        return apparatus.liquid is None or apparatus.liquid.all_at(apparatus.ambient)

    def _take_supply(self, apparatus: Apparatus, memory: FloatArray) -> None:
        for mass in self.masses:
            given = apparatus.memory(mass)
            heat, given[1] = float(given[1]), 0.0
            if heat:
                mass.warm(apparatus, heat)
                memory[0] += heat

    def _exchange(
        self, apparatus: Apparatus, a: ThermalMass, b: ThermalMass, conductance: float
    ) -> None:
        first, second = a.temperature(apparatus), b.temperature(apparatus)
        common = a.capacity * b.capacity / (a.capacity + b.capacity)
        heat = common * (first - second) * _decayed(conductance * apparatus.period / common)
        a.warm(apparatus, -heat)
        b.warm(apparatus, heat)

    def _meet(self, apparatus: Apparatus, vessel: ThermalMass) -> bool:
        """Let a vessel and what it stands on or in exchange heat; return whether it is inside."""
        assert vessel.wall is not None
        around = False
        for mass, zone in self._zones_at(apparatus, apparatus.data.body(vessel.body).xpos):
            foot = math.pi * vessel.wall.outer[0][0] ** 2
            area = foot if zone.base else foot + vessel.area
            self._exchange(apparatus, mass, vessel, zone.conductance * area)
            around |= not zone.base
        return around

    def _zones_at(
        self, apparatus: Apparatus, at: FloatArray
    ) -> Iterator[tuple[ThermalMass, HeatZone]]:
        for mass in self.masses:
            if mass.zone is not None:
                body = apparatus.data.body(mass.body)
                local = body.xmat.reshape(3, 3).T @ (at - body.xpos)
                if (local >= mass.zone.low).all() and (local <= mass.zone.high).all():
                    yield mass, mass.zone

    def _into_liquid(self, apparatus: Apparatus, vessel: ThermalMass, inside: bool) -> float:
        """Let a vessel warm what it holds; return what left its surface with vapour [J]."""
        liquid, wall = apparatus.liquid, vessel.wall
        held = None if liquid is None else liquid.warmth(vessel.body)
        if liquid is None or wall is None or held is None:
            return 0.0
        radius, wetted = _surfaces(wall, held.volume)
        own = vessel.temperature(apparatus)
        common = vessel.capacity * held.capacity / (vessel.capacity + held.capacity)
        heat = common * (own - held.temperature)
        heat *= _decayed(_INTO_LIQUID * wetted * apparatus.period / common)
        vessel.warm(apparatus, -heat)
        surface = 0.0 if inside else math.pi * radius**2
        vapour = held.water * surface * evaporation(held.temperature, apparatus.ambient)
        lost = vapour * apparatus.period
        warmer = held.temperature + (heat - lost) / held.capacity
        if warmer > held.boiling:  # what would make it hotter boils away
            lost += held.capacity * (warmer - held.boiling)
        liquid.warm(vessel.body, heat - lost)
        return lost

    def _shrink(self, apparatus: Apparatus, vessel: ThermalMass, latent: float) -> float:
        """Let as much water leave a vessel as has evaporated, as whole particles.

        Nothing leaves mixtures: which of them does is not known.

        Args:
            apparatus: What it is in.
            vessel: The vessel.
            latent: Heat that vapour has taken since the last step [J].

        Returns:
            The heat that it had above 0 K, beside that of evaporation [J].
        """
        liquid, memory = apparatus.liquid, apparatus.memory(vessel)
        memory[3] += latent
        held = None if liquid is None else liquid.warmth(vessel.body)
        if liquid is None or held is None or held.water < 1.0:
            return 0.0
        each = WATER.density * liquid.particle * _latent(held.temperature)
        count = int(memory[3] / each)
        if not count:
            return 0.0
        memory[3] -= count * each
        return liquid.evaporate(vessel.body, count)

    def vapour(self, apparatus: Apparatus, vessel: ThermalMass) -> float:
        """Return the heat that leaves a vessel with vapour now [W]; none inside a chamber or bath.

        What boils away is what its wall gives to liquid that gets no hotter.
        """
        liquid, wall = apparatus.liquid, vessel.wall
        held = None if liquid is None else liquid.warmth(vessel.body)
        if wall is None or held is None:
            return 0.0
        here = self._zones_at(apparatus, apparatus.data.body(vessel.body).xpos)
        if any(not zone.base for _, zone in here):
            return 0.0
        radius, wetted = _surfaces(wall, held.volume)
        given = _INTO_LIQUID * wetted * (vessel.temperature(apparatus) - held.temperature)
        boils = held.temperature > held.boiling - _BOILS
        free = math.pi * radius**2 * evaporation(held.temperature, apparatus.ambient)
        return max(held.water * free, given if boils else 0.0)

    def _lose(self, apparatus: Apparatus, mass: ThermalMass) -> float:
        difference = mass.temperature(apparatus) - apparatus.ambient
        share = _decayed(mass.loss(apparatus) * apparatus.period / mass.capacity)
        heat = mass.capacity * difference * share
        mass.warm(apparatus, -heat)
        return heat

    def _touched(self, apparatus: Apparatus) -> float:
        """Return the hottest temperature that the hand touches [K], 0 where it touches nothing."""
        model, geoms = apparatus.model, apparatus.data.contact.geom
        if not len(geoms):
            return 0.0
        hand = _fingers(model, self.hand)
        bodies = model.geom_bodyid[geoms]
        held = hand[bodies] & (geoms >= 0)
        touched = {int(g) for g in geoms[held.any(axis=1)][~held[held.any(axis=1)]]}
        hottest = 0.0
        for mass in self.masses:
            if mass.wall is not None:
                own = np.flatnonzero(model.geom_bodyid == model.body(mass.body).id).tolist()
            else:
                own = [model.geom(name).id for name in mass.surfaces]
            if touched.intersection(own):
                hottest = max(hottest, mass.temperature(apparatus))
        return hottest


def _fingers(model: mujoco.MjModel, hand: str) -> FloatArray:
    """Return which bodies are the hand's, shape (bodies,), booleans."""
    root, line = model.body(hand).id, np.zeros(model.nbody, dtype=bool)
    line[root] = True
    for body in range(root + 1, model.nbody):  # parents come before their children
        line[body] = line[model.body_parentid[body]]
    return line


def _latent(temperature: float) -> float:
    """Return the latent heat of water [J/kg] at a temperature [K]."""
    return _EVAPORATION - _COLDER * (temperature - ZERO_C - 30.0)


def _surfaces(wall: "Profile", volume: float) -> tuple[float, float]:
    """Return the radius of the surface of a volume [m^3] in a vessel [m], and wetted wall [m^2]."""
    radius = wall.inner_radius(wall.bottom + wall.depth(volume))
    return radius, math.pi * radius**2 + 2.0 * volume / radius


def _decayed(exponent: float) -> float:
    """Return which share of a difference has gone after some time constants."""
    return -math.expm1(-exponent)


def evaporation(water: float, room: float) -> float:
    """Return the heat that evaporates from a free surface of water [W/m^2]; never below 0.

    Args:
        water: Its temperature [K].
        room: That of the air [K].
    """
    moist = saturated(water) / water - _HUMIDITY * saturated(room) / room
    return max(0.0, _VAPOUR * _EVAPORATION / _WATER_VAPOUR * moist)


def saturated(temperature: float) -> float:
    """Return the vapour pressure of water [Pa] (Alduchov and Eskridge, 1996)."""
    celsius = temperature - ZERO_C
    return 610.94 * math.exp(17.625 * celsius / (celsius + 243.04))
