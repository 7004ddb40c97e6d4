"""A vessel for liquid nitrogen."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class NitrogenDewar(Instrument):
    """A vessel for liquid nitrogen: its stopper is drawn up with the canister that hangs from it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.463, 0.460, 0.775)
    mass = 14.0
    source = "460 mm across, 670 mm high, neck of 90 mm, 35 l, as usual; from memory"
    left_out = "it cools nothing, no nitrogen boils off"

    @property
    def stopper(self) -> Slide:
        """The stopper, and below it the canister; drawn up by 250 mm."""
        return Slide(f"{self.name}_stopper", 0.250, friction=6.0, effort=30.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.stopper,)

    def _forms(self) -> list[Form]:
        bulge = (
            (0.170, 0.030),
            (0.215, 0.050),
            (0.230, 0.090),
            (0.230, 0.400),
            (0.215, 0.460),
            (0.170, 0.515),
            (0.110, 0.555),
            (0.065, 0.575),
        )
        return [
            Turned(bulge, "light_blue", touch=False, edge=0.006),
            Ring(0.360, 0.420, (0.0, 0.040), "anthracite"),
            Ring(0.400, 0.460, (0.060, 0.460), "light_blue", segments=64),
            Ring(0.220, 0.400, (0.440, 0.520), "light_blue"),
            Ring(0.094, 0.130, (0.520, 0.660), "steel"),
            Ring(0.094, 0.150, (0.645, 0.670), "steel"),
            Rod((0, 0, 0.030), (0, 0, 0.060), 0.400, "light_blue"),
            *(
                Block(
                    (-0.030, 0.030), (s * 0.205 - 0.010, s * 0.205 + 0.010), (0.44, 0.59), "steel"
                )
                for s in (-1, 1)
            ),
            Rod((-0.060, -0.205, 0.592), (0.060, -0.205, 0.592), 0.026, "black"),
            Rod((-0.060, 0.205, 0.592), (0.060, 0.205, 0.592), 0.026, "black"),
            Block((-0.2325, -0.222), (-0.050, 0.050), (0.22, 0.32), "yellow", 0.001, touch=False),
            Block((-0.2333, -0.232), (-0.006, 0.006), (0.252, 0.305), "black", 0.0, touch=False),
            Block((-0.2333, -0.232), (-0.006, 0.006), (0.234, 0.246), "black", 0.0, touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        up = (0.0, 0.0, 1.0)
        stopper = self.stopper.add_to(spec, body, (0.0, 0.0, 0.6705), up, balanced=True)
        forms: list[Form] = [
            Turned(((0.0, 0.0), (0.070, 0.0), (0.070, 0.016), (0.050, 0.036)), "blue"),
            Rod((0, 0, 0.030), (0, 0, 0.040), 0.100, "blue"),
            Rod((0, 0, 0.036), (0, 0, 0.080), 0.020, "black"),
            Rod((0, 0, 0.078), (0, 0, 0.104), 0.050, "black"),
            Rod((0, 0, -0.100), (0, 0, 0.0), 0.086, "ceramic"),
            Rod((0, 0, -0.330), (0, 0, -0.100), 0.008, "steel"),
            Rod((0, 0, -0.480), (0, 0, -0.330), 0.070, "steel"),
        ]
        assemble(spec, stopper, self.name, forms, mass=0.9)
