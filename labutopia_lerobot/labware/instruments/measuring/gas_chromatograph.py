"""A gas chromatograph."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES, finish
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.panel import ON_FRONT, ON_TOP
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.labware.parts.valve import HandWheel
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process


@dataclass(frozen=True)
class GasChromatograph(Instrument):
    """A gas chromatograph: a column in its oven, two injectors and a detector on its roof.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.585, 0.600, 0.548)
    mass = 49.0
    source = "600 x 550 x 500 mm, as usual; from memory"
    left_out = "nothing is injected or measured"

    @property
    def door(self) -> Door[Handle]:
        """The door of the oven."""
        handle = Handle(f"{self.name}_handle", 0.20, diameter=0.016, standoff=0.036)
        return Door(f"{self.name}_door", handle, math.radians(110.0), math.radians(0.5))

    @property
    def injectors(self) -> tuple[HandWheel, ...]:
        """The caps over the septa, from left to right."""
        return tuple(
            HandWheel(f"{self.name}_{side}_injector", 0.044, 1.0, "brass", 0.014, effort=0.5)
            for side in ("left", "right")
        )

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.door, *self.injectors

    @property
    def keys(self) -> tuple[PushButton, ...]:
        """Start and stop."""
        return tuple(
            PushButton(
                f"{self.name}_{key}", FINISHES[look].rgba, radius=0.011, travel=0.003, proud=0.006
            )
            for key, look in (("start", "green"), ("stop", "red"))
        )

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.keys

    @property
    def run(self) -> Countdown:
        """Time left of its run: 20 minutes; it stops when its oven is opened."""
        start, stop = (key.name for key in self.keys)
        return Countdown(f"{self.name}_run", 20.0, start, stop, (Shut(self.door, "OVEN OPEN"),))

    @property
    def warming(self) -> tuple[Process, ...]:
        """Air and liner of its oven, and the thermostat, which holds 100 degrees during a run.

        1.5 kW and the leak are usual for its kind, ours; nothing is injected or measured.
        """
        low, high = (-0.220, -0.090, 0.060), (0.120, 0.250, 0.420)
        width, height = high[1] - low[1], high[2] - low[2]
        gap = DoorGap(self.door.joint, width * height, height)
        by = Regulated(1500.0, 100.0, self.run.name, resolution=0.1, warning="OVEN OPEN")
        return chamber(self.name, low, high, 1.0, gap, by)

    @property
    def works(self) -> tuple[Process, ...]:
        return *self.run.guards, self.run, *self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.120, 0.046), self.warming[-1]),)

    def _forms(self) -> list[Form]:
        x, y, split = 0.270, 0.300, 0.120
        coil: list[Form] = [
            Turned(
                ((0.094, 0.0), (0.102, 0.0), (0.102, 0.006), (0.094, 0.006), (0.094, 0.0)),
                "copper",
                (-0.020 + 0.016 * n, 0.115, 0.240),
                (1.0, 0.0, 0.0),
                0.0,
                touch=False,
            )
            for n in range(5)
        ]
        return [
            *feet(0.52, 0.58, 0.014),
            Block((-x, x), (-y, -split + 0.02), (0.012, 0.470), "cream", edge=0.010),
            Block((-x + 0.04, x), (-split, y), (0.012, 0.060), "cream", edge=0.004),
            Block((-x + 0.04, x), (-split, y), (0.420, 0.470), "cream", edge=0.004),
            Block((-x + 0.04, x), (y - 0.050, y), (0.012, 0.470), "cream", edge=0.004),
            Block((0.120, x), (-split, y - 0.01), (0.040, 0.440), "steel", edge=0.004),
            Block((-x + 0.05, 0.12), (-split - 0.001, -split + 0.030), (0.06, 0.42), "steel"),
            Rod((0.040, 0.115, 0.240), (0.125, 0.115, 0.240), 0.130, "dark_steel"),
            *coil,
            Block((-x - 0.0015, -x + 0.01), (-0.285, -0.115), (0.25, 0.45), "anthracite"),
            *(
                Block((0.258, x + 0.002), (-0.28, -0.12), (z, z + 0.008), "grey", touch=False)
                for z in (0.10, 0.14, 0.18)
            ),
            Block((-0.110, 0.160), (-0.060, 0.250), (0.465, 0.484), "anthracite", edge=0.006),
            *(Rod((-0.040, y, 0.480), (-0.040, y, 0.496), 0.036, "steel") for y in (0.180, 0.080)),
            Rod((0.090, 0.000, 0.480), (0.090, 0.000, 0.520), 0.050, "steel"),
            Rod((0.090, 0.000, 0.518), (0.090, 0.000, 0.548), 0.020, "brass"),
            Rod((0.090, 0.000, 0.530), (0.200, -0.150, 0.470), 0.004, "copper", touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for key, y in zip(self.keys, (-0.170, -0.230), strict=True):
            key.add_to(spec, body, (-0.2715, y, 0.300), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.2718, -0.200, 0.390), ON_FRONT)
        for injector, y in zip(self.injectors, (0.180, 0.080), strict=True):
            injector.add_to(spec, self.name, body, (-0.040, y, 0.496), ON_TOP)
        hinge, wide, tall = (-0.231, 0.298, 0.020), 0.395, 0.440
        leaf = self.door.add_to(spec, body, hinge, ajar=0.0, friction=0.5, damping=1.0)
        skin: list[Form] = [
            Block((-0.038, -0.001), (-wide, 0.0), (0.0, tall), "cream", edge=0.008),
            Block((-0.002, 0.0), (-wide + 0.03, -0.03), (0.03, tall - 0.03), "steel", 0.001),
            *(
                Block((-0.0395, -0.037), (-0.30, -0.09), (z, z + 0.008), "grey", 0.0, touch=False)
                for z in (0.05, 0.08, 0.11)
            ),
        ]
        assemble(spec, leaf, self.name, skin, mass=6.0)
        material = finish(spec, self.name, "steel")
        self.door.handle.add_to(leaf, (-0.038, -wide + 0.04, 0.25), material, lying=False)
