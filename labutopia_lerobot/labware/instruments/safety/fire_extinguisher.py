"""A carbon dioxide fire extinguisher on a wall bracket."""

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
    about,
)
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor


@dataclass(frozen=True)
class FireExtinguisher(Instrument):
    """A fire extinguisher: its lever is squeezed, its horn swings up.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.185, 0.193, 0.551)
    mass = 6.5
    source = "2 kg of CO2, 117 mm across, 540 mm high (EN 3 hand extinguishers); from memory"
    left_out = "nothing comes out"

    @property
    def horn(self) -> Rotor:
        """The horn, which is swung up to the side."""
        horn = f"{self.name}_horn"
        return Rotor(horn, friction=0.5, effort=2.0, widest=math.radians(85.0))

    @property
    def lever(self) -> Rotor:
        """The upper handle, which is squeezed down."""
        lever = f"{self.name}_lever"
        return Rotor(lever, friction=0.3, effort=2.0, widest=math.radians(12.0))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.horn, self.lever

    def _forms(self) -> list[Form]:
        bottle = (
            (0, 0.0),
            (0.052, 0.0),
            (0.0585, 0.010),
            (0.0585, 0.370),
            (0.050, 0.410),
            (0.026, 0.440),
            (0.020, 0.446),
            (0.020, 0.462),
        )
        return [
            Turned(bottle, "red", edge=0.004),
            Rod((0, 0, 0.460), (0, 0, 0.500), 0.036, "brass"),
            Block((-0.110, 0.012), (-0.012, 0.012), (0.486, 0.494), "black"),
            Block((-0.008, 0.016), (-0.014, 0.014), (0.494, 0.516), "black"),
            Block((-0.0592, -0.040), (-0.040, 0.040), (0.180, 0.330), "white", 0.0, touch=False),
            Block((-0.0596, -0.040), (-0.040, 0.040), (0.290, 0.330), "yellow", 0.0, touch=False),
            Block((0.050, 0.066), (-0.025, 0.025), (0.200, 0.420), "dark_steel"),
            Ring(0.118, 0.124, (0.270, 0.292), "dark_steel", touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lever = self.lever.add_to(spec, body, (0, 0, 0.522), (0, -1, 0), balanced=True)
        grip: list[Form] = [
            Block(
                (-0.120, 0.008), (-0.011, 0.011), (0.010, 0.018), "black", turn=about((0, 1, 0), 10)
            ),
        ]
        assemble(spec, lever, self.name, grip, mass=0.10)
        horn = self.horn.add_to(spec, body, (0.0, -0.027, 0.480), (-1.0, 0.0, 0.0))
        cone: list[Form] = [
            Rod((0, -0.012, 0), (0, -0.044, 0), 0.020, "black"),
            Rod((0, -0.044, 0.006), (0, -0.044, -0.200), 0.014, "black"),
            Turned(
                ((0.012, 0), (0.016, 0.030), (0.034, 0.170)),
                "black",
                (0, -0.062, -0.180),
                (0, -0.05, -1),
                edge=0.0,
                touch=False,
            ),
            Rod((0, -0.064, -0.190), (0, -0.070, -0.340), 0.060, "black"),
        ]
        assemble(spec, horn, self.name, cone, mass=0.50)
