"""An ice bath: a shallow pan with melting ice, in foam."""

import math
from dataclasses import dataclass

from labutopia_lerobot.labware.instruments.storage.ice_bucket import lumps
from labutopia_lerobot.labware.parts.form import Form, Ring, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import HeatZone, Process, ThermalMass
from labutopia_lerobot.processes.hot_surface import IN_WATER

_FLOOR, _RIM = 0.050, 0.060
"""Heights of the pan's bottom and of its rim [m]; ours: so low that a hand sets a beaker down over
it sideways."""
_DEEP, _BEAKER = 0.010, 0.033
"""How deep it stands in the ice water, and the radius of a beaker of 150 ml [m]."""


@dataclass(frozen=True)
class IceBath(Instrument):
    """A round pan of steel in foam, 10 mm deep in ice water: a beaker is cooled in it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.180, 0.180, 0.060)
    mass = 0.8
    source = "180 mm across, 60 mm high, ours: no maker's"

    @property
    def pan(self) -> Seat:
        """The middle of the pan."""
        return Seat(f"{self.name}_pan", self.name, (0.0, 0.0, _FLOOR), width=0.100)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.pan,)

    @property
    def works(self) -> tuple[Process, ...]:
        """The ice: 0.3 kg of it, 2050 J/kg K, which 334 kJ/kg melt (CRC Handbook); leak ours.

        Its water takes heat from the base of a vessel and from 10 mm of its wall.
        """
        reach, beside = 0.060, 1.0 + 2.0 * _DEEP / _BEAKER
        low, high = (-reach, -reach, _FLOOR - 0.002), (reach, reach, _FLOOR + 0.003)
        ice = ThermalMass(
            f"{self.name}_ice_temperature",
            self.name,
            0.3 * 2050.0,
            leak=0.3,
            zone=HeatZone(low, high, beside * IN_WATER, base=True),
            begins=0.0,
            latent=0.3 * 334e3,
        )
        return (ice,)

    def _forms(self) -> list[Form]:
        around = lumps(
            [
                ((0.056 + 0.011 * (n % 2)) * math.cos(a), (0.056 + 0.011 * (n % 2)) * math.sin(a))
                for n, a in enumerate(2.0 * math.pi * k / 22 for k in range(22))
            ],
            _FLOOR + 0.004,
            half=0.005,
        )
        return [
            Rod((0, 0, 0), (0, 0, _FLOOR - 0.002), 0.180, "blue"),
            Rod((0, 0, _FLOOR - 0.002), (0, 0, _FLOOR), 0.160, "steel"),
            Rod((0, 0, _FLOOR), (0, 0, _FLOOR + 0.0012), 0.156, "glass_edge", touch=False),
            Ring(0.156, 0.180, (_FLOOR - 0.002, _RIM), "blue"),
            *around,
        ]
