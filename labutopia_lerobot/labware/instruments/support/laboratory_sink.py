"""A laboratory sink with a swan-neck tap."""

import math
from dataclasses import dataclass
from itertools import pairwise

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drain import Drain
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.fittings import framed, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, towards
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.mouth import Mouth
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.labware.parts.water_point import WaterPoint
from labutopia_lerobot.processes import Process

_X, _Y, _FLOOR, _RIM = (-0.222, 0.162), (-0.232, 0.232), 0.650, 0.895
"""Inside of the basin, its floor and its rim [m]."""


@dataclass(frozen=True)
class LaboratorySink(WaterPoint):
    """A sink in its cupboard: the swan neck swivels, a tap opens the water, the basin drains.

    12 l/min is what EN 200 wants of taps for sinks at 3 bar (from memory); the nozzle is ours.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.640, 0.600, 1.321)
    mass = 40.0
    source = "600 x 600 x 900 mm, basin of 250 mm depth, as usual; from memory"
    left_out = "water that no task has filled in fills nothing; its drain has no plug"
    flow, nozzle, fall = 12.0, 0.006, 0.6
    contents = 20e-3  # what the basin holds

    @property
    def neck(self) -> Rotor:
        """The swan neck, which swivels to the right by 70 degrees."""
        return Rotor(f"{self.name}_neck", friction=0.3, effort=2.0, widest=math.radians(70.0))

    @property
    def water(self) -> Tap:
        return Tap(f"{self.name}_water", length=0.060, look="green", standoff=0.020)

    @property
    def door(self) -> Door[Handle]:
        """The door of the cupboard."""
        handle = Handle(f"{self.name}_handle", 0.16, diameter=0.014, standoff=0.036)
        return Door(f"{self.name}_door", handle, math.radians(110.0), math.radians(0.5))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.neck, self.water, self.door

    @property
    def places(self) -> tuple[Seat, ...]:
        """The floor of the basin, beside its drain."""
        return (Seat(f"{self.name}_basin", self.name, (-0.03, 0.13, 0.6510), width=0.13),)

    @property
    def drain(self) -> Drain:
        """The drain in the middle of the basin: 40 mm wide, a pipe of DN 40; ours."""
        (x, far_x), (y, far_y) = _X, _Y
        middle = ((x + far_x) / 2, (y + far_y) / 2, _FLOOR)
        low, high = (x, y, _FLOOR - 0.01), (far_x, far_y, _RIM)
        area = (far_x - x) * (far_y - y)
        return Drain(f"{self.name}_drain", area, low, high, middle, 0.040)

    @property
    def opening(self) -> Mouth:
        """Its basin, in the middle between left and right."""
        return Mouth(self.places[0].name, (-0.07, -0.13, 0.0), ahead=(0.40, 0.70))

    @property
    def works(self) -> tuple[Process, ...]:
        return self.plumbing

    def _forms(self) -> list[Form]:
        x, y = 0.300, 0.300
        return [
            Block((-x + 0.05, x), (-y + 0.02, y - 0.02), (0.0, 0.09), "anthracite"),
            Block((-x + 0.022, x), (-y, -y + 0.018), (0.08, 0.87), "white"),
            Block((-x + 0.022, x), (y - 0.018, y), (0.08, 0.87), "white"),
            Block((x - 0.018, x), (-y, y), (0.08, 0.87), "white"),
            Block((-x + 0.022, x), (-y, y), (0.08, 0.10), "white"),
            *tub((-0.230, 0.170), (-0.240, 0.240), (0.642, _RIM), 0.008, "steel", edge=0.003),
            *self.drain.forms("steel"),
            *framed((-x, x), (-y, y), (0.870, 0.900), (_X, _Y), "ceramic", edge=0.006),
            Rod((0.230, 0, 0.895), (0.230, 0, 0.915), 0.070, "chrome"),
            Rod((0.230, 0, 0.900), (0.230, 0, 1.030), 0.036, "chrome"),
            Rod((0.230, -0.010, 0.965), (0.230, -0.050, 0.965), 0.030, "chrome"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        pipe = self.neck.add_to(spec, body, (0.230, 0.0, 1.031), (0.0, 0.0, 1.0))
        neck: list[Form] = [
            Rod((0, 0, 0), (0, 0, 0.020), 0.032, "chrome"),
            Rod((0, 0, 0.015), (0, 0, 0.180), 0.020, "chrome"),
        ]
        points = [
            (-0.100 + 0.100 * math.cos(a), 0.0, 0.180 + 0.100 * math.sin(a))
            for a in (math.pi * n / 10 for n in range(11))
        ]
        neck += [Rod(p, q, 0.020, "chrome") for p, q in pairwise(points)]
        neck.append(Rod((-0.200, 0, 0.185), (-0.200, 0, 0.120), 0.020, "chrome"))
        neck.append(Rod((-0.200, 0, 0.130), (-0.200, 0, 0.100), 0.014, "chrome"))
        assemble(spec, pipe, self.name, neck, mass=0.9)
        self.drain.add_to(body)
        self.stream.add_to(spec, pipe, (((-0.200, 0.0, 0.100), towards((0.0, 0.0, -1.0))),))
        half = math.sqrt(0.5)  # z to the left: on the right side
        side = (half, -half, 0.0, 0.0)
        self.water.add_to(spec, self.name, body, (0.230, -0.050, 0.965), side)
        leaf = self.door.add_to(
            spec, body, (-0.279, 0.299, 0.105), ajar=0.0, friction=0.3, damping=0.8
        )
        skin = Block((-0.018, 0.0), (-0.598, 0.0), (0.0, 0.755), "light_blue", edge=0.003)
        assemble(spec, leaf, self.name, [skin], mass=6.0)
        material = finish(spec, self.name, "steel")
        self.door.handle.add_to(leaf, (-0.018, -0.555, 0.60), material, lying=False)
