"""A tube roller."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.processes import Process


@dataclass(frozen=True)
class TubeRoller(Instrument):
    """A tube roller: five rollers turn side by side and roll the tubes that lie between them.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.250, 0.430, 0.105)
    mass = 4.5
    source = "430 x 230 x 110 mm, rollers of 28 x 340 mm, as usual; from memory"

    @property
    def rollers(self) -> tuple[Rotor, ...]:
        """From the front."""
        return tuple(
            Rotor(f"{self.name}_roller_{n}", friction=0.01, effort=0.1, stall=0.5) for n in range(5)
        )

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.032)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return *self.rollers, self.speed, self.power

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 80, "rpm")

    @property
    def drive(self) -> Drive:
        """It turns all rollers."""
        on, motors = (self.power.name,), tuple(roller.motor for roller in self.rollers)
        return Drive(f"{self.name}_rpm", self.scale, 40.0, 80.0, on, motors)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its knob and its drive."""
        return Flipped(self.power), self.scale, self.drive

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.050, 0.020), self.drive),)

    def _forms(self) -> list[Form]:
        return [
            Block((-0.115, 0.115), (-0.215, 0.215), (0.010, 0.060), "white", edge=0.008),
            *feet(0.22, 0.42, 0.012),
            Block((-0.115, 0.115), (0.180, 0.215), (0.050, 0.105), "white", edge=0.008),
            Block((-0.115, 0.115), (-0.215, -0.180), (0.050, 0.105), "white", edge=0.008),
            Block((-0.105, 0.105), (-0.179, 0.179), (0.059, 0.0615), "steel", 0.001),
            Block((-0.1165, -0.105), (-0.205, -0.020), (0.016, 0.054), "petrol"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.speed.add_to(spec, self.name, body, (-0.1165, -0.175, 0.035), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.1165, -0.130, 0.035), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1168, -0.075, 0.035), ON_FRONT)
        for n, roller in enumerate(self.rollers):
            at = (-0.084 + 0.042 * n, 0.0, 0.088)
            turning = roller.add_to(spec, body, at, (0.0, 1.0, 0.0))
            forms: list[Form] = [
                Rod((0, -0.170, 0), (0, 0.170, 0), 0.028, "rubber"),
                Rod((0, -0.179, 0), (0, 0.179, 0), 0.010, "chrome"),
                *(
                    Rod((0, y, 0), (0, y + 0.006, 0), 0.0284, "grey", touch=False)
                    for y in (-0.168, 0.162)
                ),
            ]
            assemble(spec, turning, self.name, forms, mass=0.25)
