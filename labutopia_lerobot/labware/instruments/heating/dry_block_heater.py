"""A dry block heater for test tubes."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.warmth import Regulated, block
from labutopia_lerobot.processes import HeatZone, Process
from labutopia_lerobot.processes.hot_surface import IN_BORE
from labutopia_lerobot.world import ON

_ROWS, _COLUMNS = (0.007, 0.030, 0.053), (0.0345, 0.0115, -0.0115, -0.0345)
"""Positions of the bores: from the front, from left to right [m]."""


@dataclass(frozen=True)
class DryBlockHeater(Instrument):
    """A dry block heater: twelve bores in a block of aluminium, a display of what its knob sets.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.260, 0.200, 0.140)
    mass = 3.2
    source = "200 x 260 x 90 mm below its block, block of 75 x 95 mm, usual for 130 C; from memory"

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.036, pointer="red")

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.heat, self.power

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bores, row by row from the front, from left to right."""
        bores = [(x, y) for x in _ROWS for y in _COLUMNS]
        return tuple(
            Seat(f"{self.name}_bore_{n}", self.name, (x, y, 0.092), width=0.017, depth=0.048)
            for n, (x, y) in enumerate(bores)
        )

    @property
    def warming(self) -> tuple[Process, ...]:
        """What knob and switch say, the block and its thermostat.

        300 W, usual; 0.6 kg of aluminium, 900 J/kg K (Incropera, table A.1).
        """
        knob = Scale(self.heat, 20, 130, "\u00b0C", resolution=0.5)
        power = Scale(self.power, 0, 1, ON)
        zone = HeatZone((-0.005, -0.046, 0.088), (0.065, 0.046, 0.100), IN_BORE)
        by = Regulated(300.0, knob.name, power.name, resolution=0.5)
        return knob, power, *block(self.name, 540.0, 0.023, zone, (), by)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.080, 0.028), self.warming[-1], ink=(255, 90, 60)),
        )

    def _forms(self) -> list[Form]:
        low, high, wall = 0.088, 0.140, 0.003
        across = [_ROWS[0] - 0.0115 + 0.023 * n for n in range(4)]
        along = [_COLUMNS[0] + 0.0115 - 0.023 * n for n in range(5)]
        side = ((-0.130, 0.010), (0.130, 0.010), (0.130, 0.090), (-0.070, 0.090), (-0.130, 0.030))
        y = along[0] + wall
        return [
            Prism(side, (-0.100, 0.100), "white", edge=0.006),
            Block((-0.128, 0.128), (-0.098, 0.098), (0.008, 0.020), "anthracite"),
            *feet(0.26, 0.20, 0.010),
            Block((across[0], across[-1]), (-y, y), (low, 0.092), "dark_steel", 0.0),
            *(Block((x - wall, x + wall), (-y, y), (low, high), "steel", 0.001) for x in across),
            *(
                Block((across[0], across[-1]), (y - wall, y + wall), (low, high), "steel", 0.001)
                for y in along
            ),
            *(
                Ring(0.0174, 0.0225, (0.110, 0.1405), "steel", (x, y), touch=False, segments=20)
                for x in _ROWS
                for y in _COLUMNS
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(45.0)
        self.heat.add_to(spec, self.name, body, (-0.100, -0.060, 0.060), lean)
        self.displays[0].add_to(spec, body, (-0.1003, 0.035, 0.0603), lean)
        self.power.add_to(spec, self.name, body, (-0.100, -0.015, 0.060), lean)
