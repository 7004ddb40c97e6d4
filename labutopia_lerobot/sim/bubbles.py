"""Bubbles where gas leaves a solution: they rise, and lie as foam on its surface; drawn only."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.chemistry.inventory import Inventory
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world.model import VISUAL_GROUP

_RISING, _FOAM = 40, 140
"""How many there are at most in the liquid of a vessel, and in the foam on it."""
_SPEED = 0.20
"""How fast one rises [m/s]: 2 to 4 mm across, in water (Clift, Grace and Weber, "Bubbles, Drops,
and Particles", 1978, figure 7.3: 0.2 to 0.25)."""
_SMALL, _LARGE, _FROTH = 0.0010, 0.0020, 0.0035
"""Radius of the smallest and the largest that rise, and of those of foam, which have joined [m];
ours: about what is seen on carbonates."""
_DENSEST = 2e-4
"""Gas that leaves when all of them rise [mol/s]; ours: 5 ml of gas in a second."""
_LEAST = 1e-7
"""Gas that leaves below which nothing is seen [mol/s]; ours: a bubble in a second."""
_SMOOTHED = 0.3
"""Time over which the gas that leaves is averaged [s]: that in which a bubble rises 60 mm."""
_LIVES = 1.5
"""Time after which foam has burst [s]; ours: without soap it lives for one to two seconds."""
_MOLAR_VOLUME = 0.0241
"""Of a gas at 20 degrees C and 101325 Pa [m^3/mol]: R T / p."""
_PACKED = 0.64
"""Share of a foam's room that balls fill: dense random packing."""
_WHITE, _OPACITY = (0.96, 0.97, 0.98), 0.75
_PARKED = (0.0, 0.0, 1.0)
"""Where they are while nothing is to be seen [m]."""

_NUMBERS = np.arange(1, _RISING + _FOAM + 1)
_OUT, _TURN, _UP = (np.sqrt(_NUMBERS * 0.819173 % 1.0), _NUMBERS * 2.399963, _NUMBERS * 0.754878)
"""Where each is across, about and along the axis, in parts: scattered, as Roberts' sequences and
the seeds of a sunflower are, so that no two rise above each other."""


@dataclass(frozen=True)
class Bubbles(Process):
    """The gas that leaves the solution in a vessel, as it is seen; nothing feels it.

    Attributes:
        vessel: What holds the solution.
    """

    vessel: Vessel

    @property
    def name(self) -> str:
        return f"{self.vessel.name}_bubbles"

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return "given off", "rate", "foam"

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        """Begin with what has been given off while the vessels were filled, and no bubbles."""
        apparatus.memory(self)[:] = self._given_off(apparatus), 0.0, 0.0

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory, period = apparatus.memory(self), apparatus.period
        before, rate, foam = memory
        given_off = self._given_off(apparatus)
        rate -= math.expm1(-period / _SMOOTHED) * ((given_off - before) / period - rate)
        foam = (foam + rate * period * _MOLAR_VOLUME) * math.exp(-period / _LIVES)
        memory[:] = given_off, rate, foam

    @override
    def show(self, apparatus: Apparatus) -> None:
        _, rate, foam = apparatus.memory(self)
        held = None if apparatus.liquid is None else apparatus.liquid.warmth(self.vessel.name)
        first = int(apparatus.model.geom(self._bubble(0)).id)
        mine = slice(first, first + _RISING + _FOAM)
        opacities = apparatus.model.geom_rgba[mine, 3]
        opacities[:] = 0.0
        if held is None:
            return
        profile, rim = self.vessel.profile, apparatus.site(f"{self.vessel.name}_rim")
        level = profile.bottom + profile.depth(held.volume)
        dense = math.sqrt(rate / _DENSEST) if rate > _LEAST else 0.0
        rising = math.ceil(_RISING * min(1.0, dense))
        frothing = min(_FOAM, int(foam * _PACKED / (4 / 3 * math.pi * _FROTH**3)))
        opacities[:rising] = opacities[_RISING : _RISING + frothing] = _OPACITY
        across = profile.inner_radius(level) - _FROTH
        deep, room = level - profile.bottom, profile.height - level
        thick = min(foam / (math.pi * across**2), room)
        along = (_UP + apparatus.data.time * _SPEED / deep) % 1.0
        heights = profile.bottom + along * deep
        heights[_RISING:] = level + _UP[_RISING:] % 1.0 * max(thick - _FROTH, 0.0)
        sides, below = across * _OUT, heights - profile.height
        places = np.column_stack([sides * np.cos(_TURN), sides * np.sin(_TURN), below])
        apparatus.data.geom_xpos[mine] = rim.position_w + places @ rim.rotation_w.T

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build what is seen of it into a scene, still invisible."""
        spec.add_material(name=self.name, specular=0.4, shininess=0.6)
        radii = [*np.linspace(_SMALL, _LARGE, _RISING), *[_FROTH] * _FOAM]
        for number, radius in enumerate(radii):
            spec.worldbody.add_geom(
                name=self._bubble(number),
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(radius, 0.0, 0.0),
                pos=_PARKED,
                material=self.name,
                rgba=(*_WHITE, 0.0),
                group=VISUAL_GROUP,
                contype=0,
                conaffinity=0,
                mass=0,
            )

    def _given_off(self, apparatus: Apparatus) -> float:
        liquid = apparatus.liquid
        return 0.0 if liquid is None else liquid.gas_from(self.vessel.name)

    def _bubble(self, number: int) -> str:
        return f"{self.name}_{number}"


def bubbles_in(pieces: Iterable[Piece], contents: Mapping[Piece, Filling]) -> tuple[Bubbles, ...]:
    """Return the bubbles in every vessel of a scene, where gas may leave what is filled in."""
    reacting = [filling for filling in contents.values() if filling.reacts]
    solids = [one.species for filling in reacting for one in filling.crystals]
    dissolved = [filling.dissolved for filling in reacting]
    if not reacting or not Inventory.of(dissolved, solids).gaseous.any():
        return ()
    return tuple(Bubbles(piece) for piece in pieces if isinstance(piece, Vessel))
