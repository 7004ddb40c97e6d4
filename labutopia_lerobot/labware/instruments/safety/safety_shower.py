"""An emergency shower over an eyewash, on one column."""

import math
from dataclasses import dataclass
from itertools import pairwise

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drain import Drain
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned, towards
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.stream import Stream
from labutopia_lerobot.labware.parts.supply import Drawn, Supply
from labutopia_lerobot.processes import Process

_FLOW, _FLOW_OF_EYEWASH = 60.0, 6.0
"""[l/min]: the least that EN 15154-1 and EN 15154-2 allow (makers' pages on the standards)."""
_HOLES, _HOLE = 7, 0.0048
"""Streams that are drawn of the shower, and the radius of each [m]; ours: 2 m/s, which hurts
nobody. Real heads have dozens."""
_SPREAD = 0.15
"""How far the outer streams lean out; ours: 95 % of the water is to fall within 400 mm, 700 mm
below the head (EN 15154-1, the same pages)."""
_NOZZLE = 0.0032
"""Radius of each jet of the eyewash [m], as of the one without a shower."""
_JETS = (-0.040, 0.040)
"""Where they are, to the left [m]."""
_FLOOR, _BOWL, _BOWL_AT = 0.972, 0.160, (-0.08, 0.0)
"""Height of the floor of the eyewash's bowl, its diameter, and where it is [m]."""
_LEAN = math.tan(math.radians(15.0))
"""How far its jets lean towards each other; ours."""


@dataclass(frozen=True)
class SafetyShower(Instrument):
    """A safety shower: the triangle is pulled down, the eyewash's flag pushed back.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.625, 0.356, 2.254)
    mass = 30.0
    source = "2250 mm high, head of 210 mm (EN 15154-1 and -2 are alike); from memory"
    left_out = "its own water wets and fills nothing"

    @property
    def pull(self) -> Slide:
        """The triangle on its rod, which opens the shower."""
        return Slide(f"{self.name}_pull", 0.080, friction=10.0, effort=40.0)

    @property
    def lever(self) -> Rotor:
        """The flag that opens the eyewash."""
        lever = f"{self.name}_lever"
        return Rotor(lever, friction=0.4, effort=2.0, widest=math.radians(80.0))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.pull, self.lever

    @property
    def showering(self) -> Supply:
        """The water that its triangle lets through."""
        return Supply(f"{self.name}_flow", self.pull, _FLOW)

    @property
    def washing(self) -> Supply:
        """The water that the eyewash's flag lets through."""
        return Supply(f"{self.name}_eyewash_flow", self.lever, _FLOW_OF_EYEWASH)

    @property
    def shower(self) -> Stream:
        """The streams of its head, down to the floor."""
        holes = tuple(f"{self.name}_hole_{n}" for n in range(_HOLES))
        return Stream(f"{self.name}_shower", self.showering, holes, _HOLE, falls=2.1, lengths=3)

    @property
    def jets(self) -> Stream:
        """The jets of the eyewash, which fall back into its bowl."""
        jets = (f"{self.name}_right_jet", f"{self.name}_left_jet")
        return Stream(f"{self.name}_jets", self.washing, jets, _NOZZLE, falls=0.120, lengths=6)

    @property
    def drain(self) -> Drain:
        """The drain of the eyewash's bowl, 32 mm wide as of the one without a shower."""
        (x, y), wide = _BOWL_AT, _BOWL / 2
        low, high = (x - wide, y - wide, _FLOOR - 0.01), (x + wide, y + wide, 1.050)
        area = math.pi * wide**2
        return Drain(f"{self.name}_drain", area, low, high, (x, y, _FLOOR), 0.032)

    @property
    def mounted(self) -> tuple[Drain, ...]:
        """Its drain, where liquid gets to."""
        return (self.drain,)

    @property
    def works(self) -> tuple[Process, ...]:
        """Shower and eyewash, a meter for each, what is seen of them, and the bowl's drain."""
        drawn = Drawn(f"{self.name}_drawn", self.showering)
        washed = Drawn(f"{self.name}_eyewash_drawn", self.washing)
        seen = self.shower, self.jets
        return self.showering, self.washing, drawn, washed, *seen, self.drain

    def _forms(self) -> list[Form]:
        bowl = ((0.020, 0.950), (0.080, 0.966), (0.122, 1.010), (0.130, 1.050))
        head = ((0.0, 0.0), (0.105, 0.0), (0.105, 0.015), (0.035, 0.060), (0.020, 0.110))
        jets: list[Form] = []
        for y in _JETS:
            jets += [
                Rod((-0.08, y, 0.960), (-0.08, y, 1.070), 0.012, "chrome"),
                Turned(((0.0, 0.0), (0.022, 0.0), (0.026, 0.030)), "black", (-0.08, y, 1.070)),
            ]
        return [
            Rod((0.25, 0, 0.0), (0.25, 0, 0.020), 0.240, "green"),
            Rod((0.25, 0, 0.020), (0.25, 0, 2.250), 0.042, "green"),
            Rod((0.25, 0, 2.230), (-0.17, 0, 2.230), 0.034, "green"),
            Turned(head, "green", (-0.15, 0.0, 2.110)),
            Rod((-0.15, 0, 2.108), (-0.15, 0, 2.112), 0.190, "yellow", touch=False),
            Rod((0.05, 0.0, 2.230), (0.05, -0.055, 2.230), 0.048, "chrome"),
            Rod((0.25, 0, 0.950), (-0.08, 0, 0.950), 0.034, "green"),
            Turned(bowl, "green", (-0.08, 0.0, 0.0), touch=False),
            Rod((-0.08, 0, 0.952), (-0.08, 0, _FLOOR), _BOWL, "green"),
            *self.drain.forms("green", facets=8),
            Ring(_BOWL, 0.200, (0.968, 0.992), "green", _BOWL_AT),
            Ring(0.196, 0.234, (0.988, 1.016), "green", _BOWL_AT),
            Ring(0.230, 0.250, (1.012, 1.050), "green", _BOWL_AT),
            *jets,
            Rod((0.15, -0.010, 0.950), (0.15, -0.045, 0.950), 0.030, "chrome"),
            Block((0.222, 0.230), (-0.080, 0.080), (1.500, 1.660), "green", edge=0.001),
            Block((0.220, 0.223), (-0.014, 0.014), (1.525, 1.635), "white", 0.0, touch=False),
            Block((0.220, 0.223), (-0.055, 0.055), (1.566, 1.594), "white", 0.0, touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        down = (0.0, 0.0, -1.0)
        around = [2 * math.pi * n / (_HOLES - 1) for n in range(_HOLES - 1)]
        rays = [(0.0, 0.0), *((math.cos(a), math.sin(a)) for a in around)]
        self.shower.add_to(
            spec,
            body,
            tuple(
                ((-0.15 + 0.07 * x, 0.07 * y, 2.105), towards((_SPREAD * x, _SPREAD * y, -1.0)))
                for x, y in rays
            ),
        )
        nozzles = (
            ((-0.08, y, 1.100), towards((0.0, -math.copysign(_LEAN, y), 1.0))) for y in _JETS
        )
        self.jets.add_to(spec, body, tuple(nozzles))
        self.drain.add_to(body)
        pull = self.pull.add_to(spec, body, (0.05, -0.045, 2.204), down, balanced=True)
        sides = ((0.0, -0.50), (0.09, -0.64), (-0.09, -0.64), (0.0, -0.50))
        triangle: list[Form] = [
            Rod((0, y, z), (0, far_y, far_z), 0.014, "yellow")
            for (y, z), (far_y, far_z) in pairwise(sides)
        ]
        rod = Rod((0, 0, 0), (0, 0, -0.50), 0.010, "chrome")
        assemble(spec, pull, self.name, [rod, *triangle], mass=0.6)
        axis = (0.0, 1.0, 0.0)
        lever = self.lever.add_to(spec, body, (0.15, -0.046, 0.950), axis, balanced=True)
        flag: list[Form] = [
            Rod((0, 0, 0), (0, -0.012, 0), 0.026, "chrome"),
            Rod((0, -0.008, 0), (0, -0.130, 0.0), 0.010, "chrome"),
            Rod((0, -0.130, 0), (-0.330, -0.130, 0.0), 0.010, "chrome"),
            Block((-0.360, -0.326), (-0.180, -0.090), (-0.050, 0.050), "green", edge=0.006),
        ]
        assemble(spec, lever, self.name, flag, mass=0.4)
