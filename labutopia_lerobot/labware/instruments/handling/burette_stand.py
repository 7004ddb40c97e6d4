"""A 50 ml burette on its stand."""

from dataclasses import dataclass, replace

import mujoco

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.processes import Process

_X, _Y = -0.045, 0.0
"""Position of the burette [m]."""
_TIP = 0.155
"""Height of its tip [m]."""


@dataclass(frozen=True)
class BuretteStand(Instrument):
    """A burette with a stopcock in a double clamp, over a white base.

    The burette is ware of the catalogue, a body of its own: a task fills it by
    `contents={stand.burette: Filling(...)}`.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.270, 0.160, 0.905)
    mass = 2.4
    source = "burette of 50 ml, 13.5 x 750 mm (ISO 385), stand of 160 x 270 mm; from memory"

    @property
    def burette(self) -> Vessel:
        """The burette, which holds the liquid."""
        return replace(glassware("burette", "50 ml", f"{self.name}_burette"), clamped=True)

    @property
    def mounted(self) -> tuple[Vessel, ...]:
        """The ware on it."""
        return (self.burette,)

    @property
    def stopcock(self) -> Tap:
        return self.burette.stopcocks[0].mechanism

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.stopcock,)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.burette.processes

    @property
    def under(self) -> Seat:
        """Place of the flask, under the tip."""
        return Seat(f"{self.name}_base", self.name, (_X, _Y, 0.016), width=0.090)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.under,)

    def _forms(self) -> list[Form]:
        return [
            Block((-0.135, 0.135), (-0.080, 0.080), (0.004, 0.016), "ceramic", edge=0.003),
            *feet(0.250, 0.150, 0.005),
            Rod((0.060, 0, 0.016), (0.060, 0, 0.740), 0.012, "chrome"),
            *(
                Block((_X + 0.008, 0.066), (-0.012, 0.012), (z, z + 0.016), "light_grey")
                for z in (0.420, 0.640)
            ),
            *(
                Block(
                    (_X - 0.010, _X + 0.008),
                    (side * 0.010 - 0.003, side * 0.010 + 0.003),
                    (z - 0.002, z + 0.018),
                    "red",
                    0.001,
                )
                for z in (0.420, 0.640)
                for side in (-1, 1)
            ),
            *(
                Rod((0.060, 0.010, z + 0.008), (0.060, 0.034, z + 0.008), 0.014, "black")
                for z in (0.420, 0.640)
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.burette.add_to(spec, body).pos = (_X, _Y, _TIP)
