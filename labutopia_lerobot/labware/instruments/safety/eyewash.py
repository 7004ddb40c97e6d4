"""An eyewash with a bowl and a push lever."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drain import Drain
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned, towards
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.stream import Stream
from labutopia_lerobot.labware.parts.supply import Drawn, Supply
from labutopia_lerobot.processes import Process

_FLOW = 6.0
"""Of both jets [l/min]: the least that EN 15154-2 allows (a maker's page on the standard)."""
_NOZZLE = 0.0032
"""Radius of each jet where it leaves [m]; ours: at that flow it rises by 120 mm, and EN 15154-2
wants 100 to 300 mm (the same)."""
_JETS = (-0.035, 0.035)
"""Where they are, to the left [m]."""
_FLOOR, _BOWL = 0.047, 0.160
"""Height of the bowl's floor and its diameter [m]."""
_LEAN = math.tan(math.radians(15.0))
"""How far the jets lean towards each other; ours."""


@dataclass(frozen=True)
class Eyewash(Instrument):
    """A wall-mounted eyewash: its lever, pushed back, opens two soft jets.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.316, 0.341, 0.250)
    mass = 4.0
    source = "bowl of 250 mm (EN 15154-2 eyewashes are alike); from memory"
    left_out = "its own water wets and fills nothing"

    @property
    def lever(self) -> Rotor:
        """The flag, which is pushed away."""
        lever = f"{self.name}_lever"
        return Rotor(lever, friction=0.4, effort=2.0, widest=math.radians(80.0))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.lever,)

    @property
    def supply(self) -> Supply:
        """The water that its lever lets through."""
        return Supply(f"{self.name}_flow", self.lever, _FLOW)

    @property
    def stream(self) -> Stream:
        """Its two jets, which fall back into the bowl."""
        outlets = (f"{self.name}_right_jet", f"{self.name}_left_jet")
        return Stream(f"{self.name}_stream", self.supply, outlets, _NOZZLE, falls=0.120, lengths=8)

    @property
    def drain(self) -> Drain:
        """The drain of its bowl, 32 mm wide as EN 15154-2 bowls have it; from memory."""
        at, wide = (0.0, 0.0, _FLOOR), _BOWL / 2
        low, high = (-wide, -wide, _FLOOR - 0.01), (wide, wide, 0.114)
        return Drain(f"{self.name}_drain", math.pi * wide**2, low, high, at, 0.032)

    @property
    def mounted(self) -> tuple[Drain, ...]:
        """Its drain, where liquid gets to."""
        return (self.drain,)

    @property
    def works(self) -> tuple[Process, ...]:
        """The water, its meter, what is seen of it, and the drain of the bowl."""
        return self.supply, Drawn(f"{self.name}_drawn", self.supply), self.stream, self.drain

    def _forms(self) -> list[Form]:
        bowl = ((0.030, 0.030), (0.080, 0.044), (0.118, 0.080), (0.126, 0.110), (0.130, 0.114))
        jets: list[Form] = []
        for y in _JETS:
            jets += [
                Rod((0.0, y, 0.050), (0.0, y, 0.150), 0.012, "chrome"),
                Turned(
                    ((0.008, 0.0), (0.024, 0.014), (0.026, 0.026), (0.0, 0.026)),
                    "green",
                    (0, y, 0.150),
                ),
            ]
        return [
            Turned(bowl, "green", touch=False, edge=0.002),
            Turned(bowl[::-1], "green", touch=False, edge=0.002),
            Turned(((0, 0.030), (0.080, 0.040), (0.080, _FLOOR), (0, _FLOOR)), "green"),
            *self.drain.forms("green", facets=8),
            Ring(_BOWL, 0.200, (_FLOOR, 0.070), "green"),
            Ring(0.196, 0.230, (0.066, 0.092), "green"),
            Ring(0.226, 0.250, (0.088, 0.114), "green"),
            Rod((0, 0, 0.0), (0, 0, 0.040), 0.040, "chrome"),
            Rod((0, 0, 0.020), (0.180, 0, 0.020), 0.034, "chrome"),
            Block((0.176, 0.186), (-0.060, 0.060), (0.0, 0.240), "light_grey"),
            Block((0.1745, 0.176), (-0.050, 0.050), (0.130, 0.230), "green", 0.0, touch=False),
            Block((0.1735, 0.1745), (-0.010, 0.010), (0.150, 0.210), "white", 0.0, touch=False),
            Block((0.1735, 0.1745), (-0.030, 0.030), (0.170, 0.190), "white", 0.0, touch=False),
            *jets,
            Rod((0.150, -0.017, 0.020), (0.150, -0.040, 0.020), 0.030, "chrome"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        jets = (((0.0, y, 0.176), towards((0.0, -math.copysign(_LEAN, y), 1.0))) for y in _JETS)
        self.stream.add_to(spec, body, tuple(jets))
        self.drain.add_to(body)
        lever = self.lever.add_to(spec, body, (0.150, -0.041, 0.020), (0.0, 1.0, 0.0))
        flag: list[Form] = [
            Rod((0, 0, 0), (0, -0.012, 0), 0.026, "chrome"),
            Rod((0, -0.008, 0), (-0.020, -0.112, 0.0), 0.008, "chrome"),
            Rod((-0.020, -0.112, 0), (-0.150, -0.112, 0.0), 0.008, "chrome"),
            Block((-0.170, -0.150), (-0.170, -0.112), (-0.030, 0.030), "green", edge=0.004),
        ]
        assemble(spec, lever, self.name, flag, mass=0.2)
