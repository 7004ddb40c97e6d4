"""A syringe pump."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.dosing import Dosing
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.switch import Latched
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_TRAVEL, _FULL = 0.100, 50.0
"""Travel of the carriage [m], and what the syringe gives over it [ml]."""
_HOSE, _OUTLET = 0.0005, (0.030, 0.185, 0.110)
"""Inner radius of the hose behind the syringe [m], ours, and where it ends, pointing down [m]."""


@dataclass(frozen=True)
class SyringePump(Instrument):
    """A syringe pump: a screw drives the carriage against the plunger of a 50 ml syringe.

    What the syringe is filled with leaves through a short hose on its left, over a vessel there.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.220, 0.327, 0.141)
    mass = 2.7
    source = "280 x 230 x 140 mm, travel of 100 mm, as usual; from memory"

    @property
    def carriage(self) -> Slide:
        """What pushes the plunger, to the left."""
        return Slide(f"{self.name}_carriage", _TRAVEL, friction=4.0, effort=20.0, stall=60.0)

    @property
    def rate(self) -> Knob:
        return Knob(f"{self.name}_rate", diameter=0.032)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.carriage, self.rate

    @property
    def start(self) -> PushButton:
        return self._key("start", "green")

    @property
    def stop(self) -> PushButton:
        return self._key("stop", "red")

    def _key(self, key: str, look: str) -> PushButton:
        color = FINISHES[look].rgba
        return PushButton(f"{self.name}_{key}", color, radius=0.009, travel=0.003, proud=0.006)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return self.start, self.stop

    @property
    def scale(self) -> Scale:
        return Scale(self.rate, 0.0, 60.0, "ml/h", resolution=0.5)

    @property
    def running(self) -> Latched:
        """Whether it was started and not stopped since."""
        return Latched(f"{self.name}_running", self.start.name, self.stop.name)

    @property
    def drive(self) -> Drive:
        """The screw that moves the carriage."""
        return Drive(
            f"{self.name}_rate_now",
            self.scale,
            ramp=60.0,
            brake=120.0,
            on=(self.running.name,),
            motors=(self.carriage.motor,),
            unit="ml/h",
            resolution=0.5,
            gear=_TRAVEL / _FULL / 3600.0,
        )

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the hose; z the way that the liquid leaves."""
        return f"{self.name}_outlet"

    @property
    def bore_area(self) -> float:
        """Cross-section of the hose [m^2]."""
        return math.pi * _HOSE**2

    @property
    def contents(self) -> float:
        """The most that is in the syringe [m^3]."""
        return _FULL * 1e-6

    @property
    def dosing(self) -> Dosing:
        """What has left it."""
        bore = self.contents / _TRAVEL
        return Dosing(f"{self.name}_given", self, self.carriage.joint, bore)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its buttons' state, its knob, its screw and what leaves it."""
        return self.running, self.scale, self.drive, self.dosing

    @property
    def displays(self) -> tuple[Display, ...]:
        dosed = Scale(self.carriage, 0.0, _FULL, "ml", resolution=0.1)
        return (
            Display(f"{self.name}_volume", (0.070, 0.024), dosed),
            Display(f"{self.name}_flow", (0.070, 0.024), self.drive, ink=(255, 190, 90)),
        )

    def _forms(self) -> list[Form]:
        x, z = 0.030, 0.118
        return [
            Block((-0.100, 0.100), (-0.140, 0.140), (0.008, 0.080), "white", edge=0.010),
            *feet(0.20, 0.28, 0.010),
            Block((-0.1015, -0.090), (-0.130, 0.130), (0.016, 0.070), "anthracite"),
            Block((-0.010, 0.090), (0.118, 0.138), (0.075, 0.105), "grey"),
            Block((-0.010, 0.090), (-0.138, -0.122), (0.075, 0.112), "grey"),
            Block((x - 0.022, x + 0.022), (0.020, 0.034), (0.078, 0.106), "grey"),
            *(Rod((i, -0.130, 0.092), (i, 0.130, 0.092), 0.008, "chrome") for i in (0.0, 0.078)),
            Rod((x, 0.022, z), (x, 0.125, z), 0.030, "glass"),
            Rod((x, 0.125, z), (x, 0.140, z), 0.008, "white"),
            Rod((x, 0.018, z), (x, 0.022, z), 0.046, "white", touch=False),
            Rod((x, 0.140, z), (x, 0.185, z), 0.003, "white", touch=False),
            Rod((x, 0.185, z + 0.0015), _OUTLET, 0.003, "white", touch=False),
            *(
                Block(
                    (x - 0.0155, x - 0.0150),
                    (y, y + 0.001),
                    (z - 0.005, z + 0.005),
                    "black",
                    0.0,
                    touch=False,
                )
                for y in [0.030 + 0.009 * n for n in range(11)]
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        down = (0.0, 1.0, 0.0, 0.0)
        body.add_site(name=self.spout, pos=_OUTLET, quat=down, group=COLLISION_GROUP)
        self.rate.add_to(spec, self.name, body, (-0.1015, -0.100, 0.043), ON_FRONT)
        self.start.add_to(spec, body, (-0.1015, -0.062, 0.043), ON_FRONT)
        self.stop.add_to(spec, body, (-0.1015, -0.034, 0.043), ON_FRONT)
        for display, y in zip(self.displays, (0.090, 0.014), strict=True):
            display.add_to(spec, body, (-0.1018, y, 0.043), ON_FRONT)
        carriage = self.carriage.add_to(spec, body, (0.030, -0.090, 0.0), (0.0, 1.0, 0.0))
        forms: list[Form] = [
            Block((-0.045, 0.055), (-0.024, 0.0), (0.082, 0.140), "petrol", edge=0.005),
            Rod((0, 0.0, 0.118), (0, 0.004, 0.118), 0.034, "white"),
            Rod((0, 0.004, 0.118), (0, 0.112, 0.118), 0.010, "white", touch=False),
            Rod((0, 0.112, 0.118), (0, 0.120, 0.118), 0.026, "black", touch=False),
        ]
        assemble(spec, carriage, self.name, forms, mass=0.3)
