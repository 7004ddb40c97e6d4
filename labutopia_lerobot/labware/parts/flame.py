"""A flame: it burns while gas or vapour gets to it, heats what stands above it, and is seen."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, HeatZone, Process, ThermalMass
from labutopia_lerobot.world import Reading
from labutopia_lerobot.world.model import VISUAL_GROUP

_ABOVE_ROOM = 1930.0
"""Adiabatic flame temperature above that of the room [K]: methane and ethanol in air burn at some
1950 degrees C (Glassman, Combustion, 4th edition, table 1.2; from memory)."""
_ONTO_GLASS = 80.0
"""From the gases to what they strike from below [W/m^2 K]; ours: jets of flame have 50 to 150, and
a third of the heat then gets into a beaker."""
_GASES = 5.0
"""Heat that warms gases and gauze by 1 K [J/K]; ours: a wire gauze glows within seconds."""
_ASIDE = 0.03
"""How far from the axis of the flame the middle of a vessel may stand [m]; ours."""
_LEAST = 0.02
"""Share of its fuel below which a flame goes out; ours."""
_BLUE, _LUMINOUS = (0.25, 0.45, 1.0, 0.45), (1.0, 0.72, 0.25, 0.75)
"""With air mixed in, and without, when soot glows."""


@dataclass(frozen=True)
class Flame(Process):
    """A flame; its reading is the power with which it burns [W].

    Who lights it is not simulated: it burns as soon as fuel flows and nothing covers it.

    Attributes:
        name: What its reading is called, and the geom that is seen of it.
        gases: Its hot gases, which it heats.
        watt: Power at full flow [W].
        fuel: From 0 to 1, which share of its fuel flows.
        open: 1 where nothing covers it, if there is a cap.
        air: From 0 to 1, how much air is mixed in before it burns, if any can be.
    """

    name: str
    gases: ThermalMass
    watt: float
    fuel: Process
    open: Process | None = None
    air: Process | None = None

    @override
    def step(self, apparatus: Apparatus) -> None:
        power = self.reading(apparatus).value
        if power:
            apparatus.memory(self.gases)[1] += power * apparatus.period

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        share = _share(apparatus, self.fuel)
        burns = share > _LEAST and (self.open is None or _share(apparatus, self.open) > 0.5)
        return Reading(self.watt * share if burns else 0.0, "W")

    @override
    def show(self, apparatus: Apparatus) -> None:
        mixed = 0.0 if self.air is None else _share(apparatus, self.air)
        *colour, opacity = (
            (1.0 - mixed) * yellow + mixed * blue
            for yellow, blue in zip(_LUMINOUS, _BLUE, strict=True)
        )
        burns = self.reading(apparatus).value > 0.0
        apparatus.model.geom(self.name).rgba = (*colour, opacity if burns else 0.0)

    def add_to(self, spec: mujoco.MjSpec, body: mujoco.MjsBody, foot: Vector, size: Vector) -> None:
        """Build what is seen of it, unlit.

        Args:
            spec: What the body is in.
            body: What carries it.
            foot: Where it burns, in the frame of the body [m].
            size: Its half axes [m].
        """
        spec.add_material(name=self.name, emission=1.0)
        body.add_geom(
            name=self.name,
            type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
            size=size,
            pos=(foot[0], foot[1], foot[2] + size[2]),
            material=self.name,
            rgba=(*_LUMINOUS[:3], 0.0),
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )


def hot_gases(piece: str, watt: float, foot: Vector, reach: float) -> ThermalMass:
    """Return what a flame heats: gases that take its power away as they rise.

    Args:
        piece: Name of the burner, and of its body.
        watt: Power of the flame [W].
        foot: Where it burns, in the frame of the body [m].
        reach: How high above that it still heats what stands there [m].
    """
    x, y, z = foot
    low, high = (x - _ASIDE, y - _ASIDE, z + 0.1 * reach), (x + _ASIDE, y + _ASIDE, z + reach)
    zone = HeatZone(low, high, _ONTO_GLASS, base=True)
    return ThermalMass(f"{piece}_gases", piece, _GASES, leak=watt / _ABOVE_ROOM, zone=zone)


def _share(apparatus: Apparatus, process: Process) -> float:
    reading = process.reading(apparatus)
    return 0.0 if reading is None else reading.value
