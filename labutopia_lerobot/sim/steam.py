"""Steam over what evaporates or boils in a vessel: a few puffs that rise, drawn only."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.puffs import Puffs
from labutopia_lerobot.processes import Apparatus, HeatExchange, Process, ThermalMass

_RISES, _SPEED = 0.16, 0.12
"""How high steam is seen over the mouth [m], and how fast it rises [m/s]; ours: free jets of moist
air over a beaker are as slow."""
_ASIDE = 0.45 * 0.6, 0.45 * 1.6
"""How far from the axis a puff begins and ends, in radii of the mouth; ours."""
_DENSE, _LEAST = 40.0, 2.5
"""Power that leaves a vessel as vapour where its steam is densest, and below which nothing is seen
[W]; ours: 18 and 1 mg/s. The mist over water begins to show between 40 and 60 degrees C."""
_PARKED = (0.0, 0.0, 1.0)
"""Where its puffs are while nothing is to be seen [m]."""


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

    @property
    def puffs(self) -> Puffs:
        """How it is drawn."""
        return Puffs(self.name, self.radius, _RISES, _SPEED, _ASIDE)

    @override
    def show(self, apparatus: Apparatus) -> None:
        vapour = self.exchange.vapour(apparatus, self.vessel)
        dense = min(1.0, math.sqrt(max(0.0, vapour - _LEAST) / (_DENSE - _LEAST)))
        self.puffs.show(apparatus, apparatus.site(self.mouth).position_w, dense)

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Build it into a scene, still invisible."""
        self.puffs.add_to(spec, spec.worldbody, _PARKED)


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
