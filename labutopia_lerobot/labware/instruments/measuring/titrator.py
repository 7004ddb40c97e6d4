"""An automatic titrator."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT, ON_TOP
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class Titrator(Instrument):
    """A titrator: its motor burette stands behind, its arm is lowered into the beaker.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.300, 0.200, 0.420)
    mass = 4.0
    source = "200 x 300 x 420 mm, burette of 20 ml, as usual; from memory"
    left_out = "its motor burette doses nothing"

    @property
    def arm(self) -> Slide:
        """Holder of the electrode and the burette's tip, which is pushed down."""
        return Slide(f"{self.name}_arm", 0.110, friction=4.0, effort=15.0)

    @property
    def piston(self) -> Slide:
        """The piston of the burette, which goes up as it doses."""
        return Slide(f"{self.name}_piston", 0.080, friction=4.0, effort=15.0)

    @property
    def stirring(self) -> Knob:
        return Knob(f"{self.name}_stirring", diameter=0.026)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.arm, self.piston, self.stirring

    @property
    def start(self) -> PushButton:
        green = FINISHES["green"].rgba
        return PushButton(f"{self.name}_start", green, radius=0.009, travel=0.003, proud=0.006)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.start,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """Place of the beaker, over the stirrer."""
        return (Seat(f"{self.name}_plate", self.name, (-0.075, 0.030, 0.052), width=0.080),)

    @property
    def displays(self) -> tuple[Display, ...]:
        dosed = Scale(self.piston, 0.0, 20.0, "ml", resolution=0.001)
        return (Display(f"{self.name}_display", (0.090, 0.030), dosed),)

    def _forms(self) -> list[Form]:
        tower = (0.070, -0.055)
        return [
            Block((-0.150, 0.150), (-0.100, 0.100), (0.008, 0.046), "white", edge=0.008),
            *feet(0.30, 0.20, 0.008),
            Rod((-0.075, 0.030, 0.044), (-0.075, 0.030, 0.052), 0.100, "anthracite"),
            Rod((0.000, 0.030, 0.040), (0.000, 0.030, 0.420), 0.012, "chrome"),
            Block((0.020, 0.150), (-0.095, 0.095), (0.040, 0.220), "white", edge=0.010),
            Block((0.0185, 0.030), (-0.090, 0.010), (0.150, 0.200), "anthracite", 0.002),
            Ring(0.026, 0.034, (0.225, 0.400), "glass", at=tower),
            Ring(0.030, 0.046, (0.215, 0.232), "petrol", at=tower),
            Rod((*tower, 0.398), (*tower, 0.412), 0.044, "petrol"),
            Block((0.090, 0.145), (0.010, 0.085), (0.218, 0.350), "copper", edge=0.010),
            Rod((0.118, 0.048, 0.350), (0.118, 0.048, 0.385), 0.034, "white"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.displays[0].add_to(spec, body, (0.0180, -0.040, 0.178), ON_FRONT)
        self.start.add_to(spec, body, (-0.100, -0.070, 0.046), ON_TOP)
        self.stirring.add_to(spec, self.name, body, (-0.060, -0.070, 0.046), ON_TOP)
        down = (0.0, 0.0, -1.0)
        arm = self.arm.add_to(spec, body, (0.000, 0.030, 0.350), down, balanced=True)
        forms: list[Form] = [
            Ring(0.014, 0.030, (-0.012, 0.012), "anthracite"),
            Block((-0.060, -0.012), (-0.010, 0.010), (-0.008, 0.008), "anthracite"),
            Rod((-0.075, 0, -0.010), (-0.075, 0, 0.010), 0.056, "anthracite"),
            Rod((-0.088, 0.008, -0.150), (-0.088, 0.008, 0.030), 0.010, "glass_edge"),
            Rod((-0.088, 0.008, 0.030), (-0.088, 0.008, 0.050), 0.014, "blue"),
            Rod((-0.066, -0.012, -0.140), (-0.066, -0.012, 0.020), 0.005, "light_blue"),
        ]
        assemble(spec, arm, self.name, forms, mass=0.15)
        piston = self.piston.add_to(spec, body, (0.070, -0.055, 0.250), (0, 0, 1), balanced=True)
        plunger: list[Form] = [
            Rod((0, 0, 0.0), (0, 0, 0.012), 0.022, "black"),
            Rod((0, 0, -0.015), (0, 0, 0.0), 0.008, "chrome"),
        ]
        assemble(spec, piston, self.name, plunger, mass=0.05)
