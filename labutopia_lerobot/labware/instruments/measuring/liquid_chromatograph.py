"""A liquid chromatograph (HPLC)."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Clock, Unmeasured
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class LiquidChromatograph(Instrument):
    """An HPLC: bottles on a tray, over pump, sampler, column oven and detector.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.508, 0.360, 0.905)
    mass = 60.0
    source = "360 x 480 x 900 mm, four modules, as usual; from memory"
    left_out = "it pumps and measures nothing"

    @property
    def drawer(self) -> Slide:
        """The drawer of the sampler, with its rack of vials."""
        return Slide(f"{self.name}_drawer", 0.200, friction=3.0, effort=15.0)

    @property
    def oven(self) -> Rotor:
        """The flap of the column oven, which is let down."""
        return Rotor(f"{self.name}_oven", friction=0.4, effort=3.0, widest=math.radians(90.0))

    @property
    def purge(self) -> Knob:
        """The purge valve of the pump."""
        return Knob(f"{self.name}_purge", diameter=0.030, look="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.drawer, self.oven, self.purge

    @property
    def places(self) -> tuple[Seat, ...]:
        """Places of vials in the drawer, from left to right."""
        return tuple(
            Seat(f"{self.name}_vial_{n}", self.drawer.name, (0.0, y, 0.006), 0.0125, 0.020)
            for n, y in enumerate((0.075, 0.045, 0.015, -0.015, -0.045, -0.075))
        )

    @property
    def displays(self) -> tuple[Display, ...]:
        """What the pump delivers, to the column or to waste, and how long the detector has run."""
        open_by = math.radians(30.0)
        flow = Unmeasured(f"{self.name}_pump", "ml/min", 0.01, "PURGE", self.purge, open_by)
        return (
            Display(f"{self.name}_flow", (0.100, 0.034), flow),
            Display(f"{self.name}_run_time", (0.100, 0.034), Clock(f"{self.name}_time")),
        )

    def _forms(self) -> list[Form]:
        x, y = 0.240, 0.180
        levels = ((0.012, 0.172), (0.366, 0.526), (0.530, 0.690))
        modules: list[Form] = [
            Block((-x, x), (-y, y), level, "white", edge=0.010) for level in levels
        ]
        sampler: list[Form] = [
            Block((-x, x), (-y, y), (0.176, 0.196), "white", edge=0.006),
            Block((-x, x), (-y, y), (0.276, 0.362), "white", edge=0.008),
            Block((-x, x), (-y, -0.128), (0.180, 0.350), "white", edge=0.006),
            Block((-x, x), (0.128, y), (0.180, 0.350), "white", edge=0.006),
            Block((0.06, x), (-y + 0.01, y - 0.01), (0.180, 0.350), "black"),
        ]
        bottles: list[Form] = []
        glass = ((0.0, 0.0), (0.045, 0.0), (0.045, 0.115), (0.020, 0.145), (0.020, 0.165))
        for j, look in ((0.11, "glass"), (0.0, "glass"), (-0.11, "copper")):
            bottles += [
                Turned(glass, look, (-0.02, j, 0.697), edge=0.004),
                Rod((-0.02, j, 0.866), (-0.02, j, 0.888), 0.044, "blue"),
                Rod((-0.02, j, 0.706), (-0.02, j, 0.785), 0.084, "water", touch=False),
                Rod((-0.02, j, 0.720), (-0.02, j, 0.905), 0.004, "white", touch=False),
            ]
        return [
            *feet(0.48, 0.36, 0.014),
            *modules,
            *sampler,
            *(
                Block((-x - 0.001, -x + 0.01), (-y + 0.01, y - 0.01), (z, z + 0.012), "petrol")
                for z in (0.154, 0.508, 0.672)
            ),
            Block((-x - 0.002, -x + 0.01), (0.05, 0.15), (0.035, 0.130), "light_grey"),
            Rod((-x - 0.022, 0.125, 0.080), (-x, 0.125, 0.080), 0.030, "steel"),
            Rod((-x - 0.022, 0.080, 0.080), (-x, 0.080, 0.080), 0.030, "steel"),
            Rod((-x - 0.018, 0.125, 0.095), (-x - 0.018, 0.080, 0.125), 0.003, "steel", False),
            Rod((-x - 0.001, -0.12, 0.44), (-x + 0.01, -0.12, 0.44), 0.012, "green", False),
            *tub((-0.16, 0.16), (-y, y), (0.690, 0.730), 0.006, "anthracite"),
            *bottles,
            Rod((-x + 0.004, 0.10, 0.605), (-x + 0.004, -0.10, 0.605), 0.012, "steel"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.purge.add_to(spec, self.name, body, (-0.240, 0.010, 0.080), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.2405, -0.100, 0.085), ON_FRONT)
        self.displays[1].add_to(spec, body, (-0.2405, 0.060, 0.450), ON_FRONT)
        drawer = self.drawer.add_to(spec, body, (-0.150, 0.0, 0.199), (-1.0, 0.0, 0.0))
        cells = [-0.090 + 0.030 * n for n in range(7)]
        forms: list[Form] = [
            Block((-0.094, 0.180), (-0.124, 0.124), (0.0, 0.006), "anthracite", 0.001),
            *(
                Block((i - 0.002, i + 0.002), (-0.095, 0.095), (0.006, 0.026), "light_blue", 0.001)
                for i in (-0.0095, 0.0095)
            ),
            *(
                Block(
                    (-0.0095, 0.0095), (j - 0.0075, j + 0.0075), (0.006, 0.026), "light_blue", 0.001
                )
                for j in cells
            ),
            Block((-0.106, -0.0915), (-0.140, 0.140), (-0.002, 0.074), "white", edge=0.004),
            Block((-0.116, -0.104), (-0.050, 0.050), (0.044, 0.056), "anthracite"),
        ]
        assemble(spec, drawer, self.name, forms, mass=0.8)
        for place in self.places:
            place.add_to(drawer)
        axis = (0.0, -1.0, 0.0)
        oven = self.oven.add_to(spec, body, (-0.246, 0.0, 0.540), axis, balanced=True)
        flap: list[Form] = [
            Block((-0.012, 0.0), (-0.168, 0.168), (0.0, 0.126), "smoked", 0.003),
            Block((-0.022, -0.010), (-0.050, 0.050), (0.104, 0.114), "anthracite"),
        ]
        assemble(spec, oven, self.name, flap, mass=0.5)
