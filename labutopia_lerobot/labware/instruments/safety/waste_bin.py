"""A waste bin whose lid a pedal opens."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import (
    Block,
    Form,
    Ring,
    Rod,
    Turned,
)
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class WasteBin(Instrument):
    """A pedal bin: the pedal, pressed by 40 mm, raises the lid by 75 degrees.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.333, 0.258, 0.377)
    mass = 3.0
    source = "250 mm across, 12 l, 380 mm high, as usual; from memory"
    movable = True
    passive = True

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(75.0), reach=0.256, friction=0.1)

    @property
    def pedal(self) -> Slide:
        """Pedal that a foot presses down."""
        return Slide(f"{self.name}_pedal", 0.040, friction=1.0, effort=40.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.pedal,)

    def _forms(self) -> list[Form]:
        return [
            Ring(0.232, 0.250, (0.014, 0.350), "steel", facets=16),
            Ring(0.236, 0.258, (0.0, 0.020), "black", facets=16),
            Ring(0.234, 0.256, (0.338, 0.352), "black", facets=16),
            Rod((0, 0, 0.004), (0, 0, 0.012), 0.236, "black"),
            Turned(((0.1158, 0.345), (0.1158, 0.014)), "anthracite", touch=False, edge=0.0),
            Block((0.118, 0.136), (-0.040, 0.040), (0.300, 0.354), "black"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lid = self.lid.add_to(spec, body, (0.130, 0.0, 0.3545))
        cap: list[Form] = [
            Turned(
                ((0, 0), (0.128, 0), (0.128, 0.008), (0.110, 0.018), (0, 0.022)),
                "steel",
                (-0.130, 0, 0),
                edge=0.003,
            ),
        ]
        assemble(spec, lid, self.name, cap, mass=0.25)
        pedal = self.pedal.add_to(spec, body, (-0.135, 0.0, 0.046), (0.0, 0.0, -1.0), balanced=True)
        foot: list[Form] = [
            Block((-0.062, 0.004), (-0.045, 0.045), (0.000, 0.010), "black", edge=0.004),
        ]
        assemble(spec, pedal, self.name, foot, mass=0.20)
        rod = spec.add_equality(name=f"{self.name}_rod", type=mujoco.mjtEq.mjEQ_JOINT)
        rod.objtype, rod.name1, rod.name2 = (
            mujoco.mjtObj.mjOBJ_JOINT,
            self.lid.joint,
            self.pedal.joint,
        )
        rod.data[:5] = (0.0, self.lid.widest / self.pedal.widest, 0.0, 0.0, 0.0)
