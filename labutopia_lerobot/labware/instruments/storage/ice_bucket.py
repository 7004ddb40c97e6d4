"""An ice bucket."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned, about
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import HeatZone, Process, ThermalMass
from labutopia_lerobot.processes.hot_surface import IN_ICE


def lumps(places: Iterable[tuple[float, float]], height: float, half: float = 0.010) -> list[Form]:
    """Return lumps of ice, which are seen but not touched.

    Args:
        places: Where they lie [m].
        height: Of their middles [m].
        half: Half their width [m].
    """
    low = 0.9 * half
    return [
        Block(
            (x - half, x + half),
            (y - half, y + half),
            (height - low, height + low),
            "glass_edge",
            0.3 * half,
            about((0.6, 0.64, 0.48), 47.0 * n),
            touch=False,
        )
        for n, (x, y) in enumerate(places)
    ]


@dataclass(frozen=True)
class IceBucket(Instrument):
    """A bucket of blue foam, full of ice: its bail is swung up to carry it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.276, 0.264, 0.230)
    mass = 2.4
    source = "240 mm across, 230 mm high, 4 l, as usual; from memory"
    movable = True

    @property
    def bail(self) -> Rotor:
        """The handle, which lies in front; it is swung up."""
        return Rotor(f"{self.name}_bail", friction=0.1, effort=0.8, widest=math.radians(90.0))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.bail,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middle of the ice."""
        return (Seat(f"{self.name}_ice", self.name, (0.0, 0.0, 0.168), width=0.120),)

    @property
    def works(self) -> tuple[Process, ...]:
        """The ice: 1.5 kg of it, 2050 J/kg K, which 334 kJ/kg melt (CRC Handbook); leak ours.

        What stands on it is cooled through its base: nothing sinks into the ice.
        """
        zone = HeatZone((-0.09, -0.09, 0.160), (0.09, 0.09, 0.190), IN_ICE, base=True)
        ice = ThermalMass(
            f"{self.name}_ice_temperature",
            self.name,
            1.5 * 2050.0,
            leak=0.3,
            zone=zone,
            begins=0.0,
            latent=1.5 * 334e3,
        )
        return (ice,)

    def _forms(self) -> list[Form]:
        spiral = [(2.4 * n, 0.016 * math.sqrt(n + 0.5)) for n in range(24)]
        ice = lumps([(r * math.cos(a), r * math.sin(a)) for a, r in spiral], 0.166)
        wall = ((0.098, 0.004), (0.105, 0.100), (0.112, 0.210), (0.120, 0.214), (0.120, 0.230))
        return [
            Turned((*wall, (0.100, 0.230)), "blue", edge=0.003, touch=False),
            Turned(((0.100, 0.230), (0.092, 0.120)), "light_blue", edge=0.0, touch=False),
            Ring(0.190, 0.212, (0.004, 0.212), "blue", touch=True),
            Ring(0.200, 0.238, (0.212, 0.2295), "blue", touch=True),
            Rod((0, 0, 0.0), (0, 0, 0.020), 0.196, "blue"),
            Rod((0, 0, 0.020), (0, 0, 0.168), 0.188, "ceramic"),
            *ice,
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        axis = (0.0, 1.0, 0.0)
        bail = self.bail.add_to(spec, body, (0.0, 0.0, 0.222), axis, balanced=True)
        y, reach = 0.126, 0.150
        forms: list[Form] = [
            *(Rod((0, s * 0.1215, 0), (0, s * 0.132, 0), 0.014, "white") for s in (-1, 1)),
            *(Rod((0, s * y, 0), (-reach, s * y, 0), 0.008, "white") for s in (-1, 1)),
            Rod((-reach, -y - 0.004, 0), (-reach, y + 0.004, 0), 0.012, "white"),
        ]
        assemble(spec, bail, self.name, forms, mass=0.08)
