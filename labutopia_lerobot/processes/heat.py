"""Heat: things of one temperature each, what they hold, lose, glow with and stand on."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, override

import numpy as np

from labutopia_lerobot.processes.process import Apparatus, Process
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.world import Reading

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.profile import Profile

CELSIUS = "\u00b0C"
"""Unit of readings of temperature."""
UPWARDS, UPRIGHT = 1.32, 1.42
"""Free convection of air, laminar, h = c (dT / L)^(1/4) [W/m^2 K]: of a hot plate that faces up,
and of an upright one (Holman, Heat Transfer, 10th edition, table 7-2)."""

_STEFAN_BOLTZMANN = 5.670e-8
"""W/m^2 K^4 (CODATA)."""
_DISCHARGE = 0.61
"""Discharge coefficient of a doorway through which air goes out above and in below (Brown and
Solvason, Int. J. Heat Mass Transfer 5, 1962: 0.6 to 1.0); that of a sharp edge."""
_GRAVITY = 9.81
_AIR = 1.19 * 1007.0
"""Heat capacity of air at 20 C [J/m^3 K] (Incropera, Fundamentals, 6th edition, table A.4)."""
_WARM, _HOT = 60.0, 300.0
"""Where what is printed on a hot surface begins to turn red, and where it has [degrees C]; ours:
from 60 on it burns who touches it."""
_GLOWS, _BRIGHT = 500.0, 1000.0
"""Where a surface begins to glow, and where it is orange [degrees C] (Draper point: 525)."""
_RED, _DULL, _ORANGE = (0.80, 0.16, 0.10), (0.35, 0.02, 0.0), (1.0, 0.45, 0.10)


@dataclass(frozen=True)
class HeatZone:
    """A box in which things that stand or hang are warmed by a thermal mass, or cooled.

    A thing is in it when the centre of its base is.

    Attributes:
        low: Least corner in the frame of the body [m].
        high: Greatest corner [m].
        conductance: To the surface of the thing [W/m^2 K].
        base: Whether only the base of the thing counts, as on a plate; else all its outside, which
            then loses nothing to the room.
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    conductance: float
    base: bool = False


@dataclass(frozen=True)
class DoorGap:
    """An opening through which a chamber's air changes places with that of the room.

    Attributes:
        joint: Hinge of its door [rad]; at 0 it is shut.
        area: Of the open doorway [m^2].
        height: Of the doorway [m].
        share: Of the flow through an upright doorway; less for a lid.
        emissivity: Of what is behind it, which radiates out; a deep hot chamber is nearly black.
    """

    joint: str
    area: float
    height: float
    share: float = 1.0
    emissivity: float = 0.0

    def conductance(self, apparatus: Apparatus, own: float, room: float) -> float:
        """Return the heat that goes through it now, per difference of temperature [W/K].

        Warm air leaves above, cold comes in below: a third of the area times the speed that the
        difference of their weights gives (Brown and Solvason, 1962).

        Args:
            apparatus: The processes at work.
            own: Temperature inside [K].
            room: And outside [K].
        """
        opening = math.sin(min(max(apparatus.joint(self.joint), 0.0), math.pi / 2))
        speed = math.sqrt(_GRAVITY * self.height * abs(own - room) / ((own + room) / 2))
        flow = self.share * _AIR * _DISCHARGE / 3.0 * self.area * opening * speed
        if not self.emissivity:
            return flow
        return flow + self.area * opening * _radiated(own, room, self.emissivity)


@dataclass(frozen=True)
class ThermalMass(Process):
    """Something of one temperature: a plate, the air of a chamber, a bath, a vessel of glass.

    `HeatExchange` moves its heat. Its reading is what a thermometer in it reads: a vessel's is the
    temperature of the liquid in it, if there is any.

    Attributes:
        name: What its reading is called.
        body: Name of the MuJoCo body that it is part of.
        capacity: Heat that warms it by 1 K [J/K].
        area: Of its surface towards the room [m^2].
        length: Of that surface, along the flow of air [m].
        convection: `UPWARDS` or `UPRIGHT`.
        emissivity: Of that surface.
        leak: What goes to the room besides, through insulation [W/K].
        links: Names of others, and the conductance to each [W/K].
        zone: Where it warms what stands there.
        gap: What an open door lets through.
        begins: Temperature at the start [degrees C]; None for that of the room.
        latent: Heat that melts it at 0 degrees, if it is ice [J].
        surfaces: Geoms that burn a hand when they are hot; of a vessel all.
        print: Geom that turns red when it is hot.
        glows: Geoms that glow when it is very hot.
        wall: Of a vessel: its cross-section.
    """

    name: str
    body: str
    capacity: float
    area: float = 0.0
    length: float = 0.1
    convection: float = UPRIGHT
    emissivity: float = 0.9
    leak: float = 0.0
    links: tuple[tuple[str, float], ...] = ()
    zone: HeatZone | None = None
    gap: DoorGap | None = None
    begins: float | None = None
    latent: float = 0.0
    surfaces: tuple[str, ...] = ()
    print: str = ""
    glows: tuple[str, ...] = ()
    wall: "Profile | None" = None

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("temperature", "heat", "melted", "vapour")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        begins = apparatus.ambient if self.begins is None else self.begins + ZERO_C
        apparatus.memory(self)[:] = begins, 0.0, self.latent if begins > ZERO_C else 0.0, 0.0

    def temperature(self, apparatus: Apparatus) -> float:
        """Return its temperature [K]."""
        return float(apparatus.memory(self)[0])

    def warm(self, apparatus: Apparatus, heat: float) -> None:
        """Give it heat [J], which may melt it."""
        memory = apparatus.memory(self)
        if not self.latent:
            memory[0] += heat / self.capacity
            return
        content = self.capacity * (memory[0] - ZERO_C) + memory[2] + heat
        memory[2] = min(max(content, 0.0), self.latent)
        memory[0] = ZERO_C + (content - memory[2]) / self.capacity

    def loss(self, apparatus: Apparatus) -> float:
        """Return what goes to the room now, per difference of temperature [W/K]."""
        own, room = self.temperature(apparatus), apparatus.ambient
        through = self.leak
        if self.area:
            through += self.area * loss_of_surface(
                own, room, self.length, self.convection, self.emissivity
            )
        if self.gap is not None:
            through += self.gap.conductance(apparatus, own, room)
        return through

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        own = self.temperature(apparatus)
        if self.wall is not None and apparatus.liquid is not None:
            held = apparatus.liquid.warmth(self.body)
            own = own if held is None else held.temperature
        return Reading(own - ZERO_C, CELSIUS, 0.1)

    @override
    def show(self, apparatus: Apparatus) -> None:
        celsius = self.temperature(apparatus) - ZERO_C
        for geoms, least, most, first, last in (
            ((self.print,) if self.print else (), _WARM, _HOT, None, _RED),
            (self.glows, _GLOWS, _BRIGHT, _DULL, _ORANGE),
        ):
            share = min(max((celsius - least) / (most - least), 0.0), 1.0)
            for name in geoms:
                geom = apparatus.model.geom(name)
                own = apparatus.model.mat_rgba[int(geom.matid[0])]
                cold = own[:3] if first is None or celsius <= least else np.array(first)
                geom.rgba = (*((1.0 - share) * cold + share * np.array(last)), own[3])


def loss_of_surface(
    own: float, room: float, length: float, convection: float, emissivity: float
) -> float:
    """Return what a surface loses by free convection and radiation [W/m^2 K].

    Args:
        own: Its temperature [K].
        room: That of air and walls [K].
        length: Of the surface [m].
        convection: `UPWARDS` or `UPRIGHT`.
        emissivity: Of the surface.
    """
    convected: float = convection * (abs(own - room) / length) ** 0.25
    return convected + _radiated(own, room, emissivity)


def _radiated(own: float, room: float, emissivity: float) -> float:
    """Return what a surface radiates to a room, per difference of temperature [W/m^2 K]."""
    return emissivity * _STEFAN_BOLTZMANN * (own**2 + room**2) * (own + room)
