"""A pH meter with an electrode on an arm."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import PhElectrode
from labutopia_lerobot.processes.solution_sensor import SolutionSensor
from labutopia_lerobot.world.model import COLLISION_GROUP

_ARM = 0.158
"""Height of the arm: the electrode hangs over a beaker of 400 ml, and goes down into it [m]."""
TIP = -0.020
"""Height of the electrode's tip over the arm before it is pushed down [m]."""


@dataclass(frozen=True)
class PhMeter(Instrument):
    """A pH meter: the arm turns on its post, the electrode is pushed down into a beaker.

    It shows the pH around the electrode's tip, and dashes while that is in no solution.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        turned: How far the arm is turned to the front when an episode begins [rad].
        lowered: How far the electrode is pushed down then [m].
    """

    name: str
    turned: float = 0.0
    lowered: float = 0.0
    size = (0.200, 0.390, 0.333)
    mass = 1.6
    source = "180 x 200 x 80 mm, electrode of 12 x 160 mm, as usual; from memory"

    @property
    def arm(self) -> Rotor:
        """The arm, which turns to the front by a quarter."""
        arm = f"{self.name}_arm"
        return Rotor(arm, friction=0.05, effort=0.5, widest=math.radians(90.0))

    @property
    def electrode(self) -> Slide:
        """The electrode in its clip, which is pushed down."""
        return Slide(f"{self.name}_electrode", 0.115, friction=2.0, effort=8.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.arm, self.electrode

    @property
    def keys(self) -> tuple[PushButton, ...]:
        """Calibrate, mode and read, from left to right."""
        colors = [FINISHES[look].rgba for look in ("grey", "grey", "green")]
        return tuple(
            PushButton(f"{self.name}_{key}", color, radius=0.009, travel=0.003, proud=0.006)
            for key, color in zip(("calibrate", "mode", "read"), colors, strict=True)
        )

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.keys

    @property
    def reads(self) -> SolutionSensor:
        """What its display shows."""
        return PhElectrode(f"{self.name}_ph", f"{self.name}_tip")

    @property
    def displays(self) -> tuple[Display, ...]:
        ink, paper = (20, 30, 25), (165, 185, 160)
        return (Display(f"{self.name}_display", (0.110, 0.040), self.reads, ink, paper),)

    def _forms(self) -> list[Form]:
        side = ((-0.100, 0.006), (0.100, 0.006), (0.100, 0.072), (0.070, 0.080), (-0.100, 0.028))
        return [
            Prism(side, (-0.090, 0.090), "light_grey", edge=0.008),
            Block((-0.096, 0.098), (-0.088, 0.088), (0.004, 0.014), "petrol"),
            Rod((0.060, -0.115, 0.000), (0.060, -0.115, 0.012), 0.060, "anthracite"),
            Rod((0.060, -0.115, 0.010), (0.060, -0.115, _ARM), 0.010, "chrome"),
            Block((0.040, 0.080), (-0.120, -0.080), (0.002, 0.010), "anthracite"),
            *feet(0.190, 0.180, 0.006),
        ]

    def _probe(self) -> list[Form]:
        """Return what is pushed down."""
        bulb = ((0, 0), (0.005, 0.004), (0.007, 0.010), (0.006, 0.014))
        return [
            Rod((0, 0, TIP + 0.012), (0, 0, 0.140), 0.012, "glass_edge"),
            Turned(tuple((r, TIP + z) for r, z in bulb), "glass_edge"),
            Rod((0, 0, 0.140), (0, 0, 0.160), 0.014, "blue"),
            Rod((0, 0, 0.160), (0, 0, 0.175), 0.006, "black"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(73.0)
        self.displays[0].add_to(spec, body, (0.010, 0.010, 0.0622), lean)
        for key, y in zip(self.keys, (0.050, 0.0, -0.050), strict=True):
            key.add_to(spec, body, (-0.060, y, 0.0402), lean)
        at, clockwise = (0.060, -0.115, _ARM), (0.0, 0.0, -1.0)
        arm = self.arm.add_to(spec, body, at, clockwise, begins=self.turned)
        forms: list[Form] = [
            Rod((0, 0, 0), (0, 0, 0.024), 0.026, "anthracite"),
            Block((-0.006, 0.006), (-0.160, 0.0), (0.006, 0.018), "anthracite"),
            Ring(0.0145, 0.026, (0.002, 0.022), "anthracite", at=(0.0, -0.172)),
        ]
        assemble(spec, arm, self.name, forms, mass=0.12)
        start, down = (0.0, -0.172, 0.0), (0.0, 0.0, -1.0)
        electrode = self.electrode.add_to(
            spec, arm, start, down, balanced=True, begins=self.lowered
        )
        assemble(spec, electrode, self.name, self._probe(), mass=0.06)
        electrode.add_site(name=f"{self.name}_tip", pos=(0, 0, TIP), group=COLLISION_GROUP)
