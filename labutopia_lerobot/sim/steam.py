"""Steam over what evaporates or boils in a vessel: a few puffs that rise, drawn only."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.processes import Apparatus, HeatExchange, Process, ThermalMass
from labutopia_lerobot.world.model import VISUAL_GROUP

_PUFFS = 16
"""How many there are over a vessel."""
_RISES, _SPEED = 0.16, 0.12
"""How high steam is seen over the mouth [m], and how fast it rises [m/s]; ours: free jets of moist
air over a beaker are as slow."""
_WIDENS = 1.6
"""By how much a puff is wider where it vanishes than at the mouth; ours."""
_DENSE, _LEAST = 40.0, 2.5
"""Power that leaves a vessel as vapour where its steam is densest, and below which nothing is seen
[W]; ours: 18 and 1 mg/s. The mist over water begins to show between 40 and 60 degrees C."""
_OPACITY = 0.10
"""Of the densest puff; ours."""
_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
"""Angle from puff to puff about the axis [rad]: no two rise above each other."""
_PARKED = (0.0, 0.0, 1.0)
"""Where they are while nothing is to be seen [m]."""


@dataclass(frozen=True)
class Steam(Process):
    """The visible part of the vapour over a vessel; it remembers nothing, and nothing feels it.

    Attributes:
        name: Beginning of the names of its puffs.
        vessel: What evaporates or boils in it.
        mouth: Name of the frame in the middle of its mouth.
        radius: Of its mouth [m].
        exchange: What moves the heat.
    """

    name: str
    vessel: ThermalMass
    mouth: str
    radius: float
    exchange: HeatExchange

    @override
    def show(self, apparatus: Apparatus) -> None:
        vapour = self.exchange.vapour(apparatus, self.vessel)
        dense = min(1.0, math.sqrt(max(0.0, vapour - _LEAST) / (_DENSE - _LEAST)))
        mouth, seconds = apparatus.site(self.mouth).position_w, apparatus.data.time
        for number in range(_PUFFS):
            geom = apparatus.model.geom(f"{self.name}_{number}")
            way = (seconds * _SPEED / _RISES + number / _PUFFS) % 1.0
            wide = 0.55 * self.radius * (1.0 + (_WIDENS - 1.0) * way)
            geom.size = (wide, wide, 1.3 * wide)
            # It comes into being over the mouth, and dissolves as it mixes with the room's air.
            geom.rgba[3] = _OPACITY * dense * math.sin(math.pi * math.sqrt(way))
            turn, aside = _GOLDEN * number + 2.0 * way, 0.45 * self.radius * (0.6 + way)
            drift = (aside * math.cos(turn), aside * math.sin(turn), way * _RISES)
            apparatus.data.geom_xpos[int(geom.id)] = mouth + drift

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build what is seen of it into a scene, still invisible."""
        spec.add_material(name=self.name, emission=0.35, specular=0.0, shininess=0.0)
        for number in range(_PUFFS):
            spec.worldbody.add_geom(
                name=f"{self.name}_{number}",
                type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
                size=(self.radius, self.radius, 0.3 * _RISES),
                pos=_PARKED,
                material=self.name,
                rgba=(0.93, 0.94, 0.95, 0.0),
                group=VISUAL_GROUP,
                contype=0,
                conaffinity=0,
                mass=0,
            )


def steam_over(processes: Iterable[Process]) -> tuple[Steam, ...]:
    """Return the steam over every vessel of the processes of a scene that holds heat."""
    order = tuple(processes)
    exchanges = [process for process in order if isinstance(process, HeatExchange)]
    return tuple(
        Steam(
            f"{mass.body}_steam",
            mass,
            f"{mass.body}_rim",
            mass.wall.outer[-1][0],
            exchange,
        )
        for exchange in exchanges
        for mass in exchange.masses
        if mass.wall is not None
    )
