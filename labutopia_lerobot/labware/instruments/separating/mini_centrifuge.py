"""A mini centrifuge with a clear domed lid, for eight microtubes."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.guard import Flipped, Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import Process

_BORES, _CIRCLE = 8, 0.030
"""Number of them, and the radius of their circle [m]."""


@dataclass(frozen=True)
class MiniCentrifuge(Instrument):
    """A mini centrifuge: eight 1.5 ml tubes under a lid that one sees through.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.170, 0.150, 0.120)
    mass = 1.2
    source = "150 x 170 x 120 mm, rotor of 8 x 1.5 ml, 6000 rpm, as usual; from memory"
    movable = True

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(80.0), reach=0.116, friction=0.03)

    @property
    def rotor(self) -> Rotor:
        return Rotor(f"{self.name}_rotor", stall=0.1)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.rotor, self.power

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bores, counterclockwise from the back."""
        return tuple(
            Seat(f"{self.name}_bore_{n}", self.rotor.name, (x, y, 0.004), 0.010, 0.020)
            for n, (x, y) in enumerate(_circle())
        )

    @property
    def closed(self) -> Shut:
        """What feels its lid: the rotor stops when it opens."""
        return Shut(self.lid)

    @property
    def drive(self) -> Drive:
        """What turns the rotor, at the one speed that it has."""
        return Drive(
            f"{self.name}_rpm",
            6000.0,
            ramp=2000.0,
            brake=2000.0,
            on=(self.power.name, self.closed.name),
            motors=(self.rotor.motor,),
            resolution=100.0,
            seen=60.0,
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, what feels its lid, and its drive."""
        return Flipped(self.power), self.closed, self.drive

    def _forms(self) -> list[Form]:
        side = ((-0.085, 0.006), (0.085, 0.006), (0.085, 0.046), (-0.058, 0.046), (-0.085, 0.018))
        return [
            Prism(side, (-0.075, 0.075), "blue", edge=0.010),
            Ring(0.096, 0.116, (0.044, 0.058), "light_grey", at=(0.012, 0.0)),
            Block((0.064, 0.082), (-0.030, 0.030), (0.040, 0.060), "blue"),
            *feet(0.170, 0.150, 0.008),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.power.add_to(spec, self.name, body, (-0.0725, 0.0, 0.031), leaning(44.0))
        rotor = self.rotor.add_to(spec, body, (0.012, 0.0, 0.048))
        forms: list[Form] = [
            Turned(((0, 0), (0.036, 0), (0.038, 0.004), (0, 0.004)), "anthracite"),
            Turned(((0, 0.004), (0.020, 0.004), (0.016, 0.028), (0, 0.028)), "anthracite"),
            Rod((0, 0, 0.028), (0, 0, 0.033), 0.016, "chrome"),
        ]
        forms += [
            Ring(0.0115, 0.0150, (0.004, 0.024), "light_grey", at, segments=12, facets=6)
            for at in _circle()
        ]
        assemble(spec, rotor, self.name, forms, mass=0.10)
        for place in self.places:
            place.add_to(rotor)
        lid = self.lid.add_to(spec, body, (0.070, 0.0, 0.0605))
        dome = ((0.058, 0.0), (0.058, 0.020), (0.050, 0.042), (0.034, 0.055), (0, 0.060))
        back = Block((-0.010, 0.0), (-0.024, 0.024), (0.000, 0.008), "glass_edge")
        shell: list[Form] = [
            *(
                Turned(skin, "smoked", (-0.058, 0, 0), touch=False, edge=0.004)
                for skin in (dome, dome[::-1])
            ),
            Ring(0.108, 0.116, (0.000, 0.006), "glass_edge", at=(-0.058, 0.0)),
            Ring(0.106, 0.112, (0.006, 0.030), "smoked", at=(-0.058, 0.0), segments=24),
            Block((-0.124, -0.112), (-0.012, 0.012), (0.002, 0.010), "anthracite"),
            back,
        ]
        assemble(spec, lid, self.name, shell, mass=0.06)


def _circle() -> list[tuple[float, float]]:
    """Return where the bores are, x and y in the rotor's frame [m]."""
    angles = [2 * math.pi * n / _BORES for n in range(_BORES)]
    return [(_CIRCLE * math.cos(a), _CIRCLE * math.sin(a)) for a in angles]
