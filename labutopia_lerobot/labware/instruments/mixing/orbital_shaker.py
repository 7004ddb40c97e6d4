"""An orbital shaker: a platform with a rubber mat that goes round a circle."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide

_ORBIT = 0.020
"""Diameter of the circle [m]."""
_SLOPE = 50.0


@dataclass(frozen=True)
class OrbitalShaker(Instrument):
    """A shaker whose platform is driven along both axes; four bars hold flasks on its mat.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.420, 0.360, 0.150)
    mass = 13.0
    source = "360 x 420 x 150 mm, orbit of 20 mm, usual for 7.5 kg of load; from memory"

    @property
    def sledge(self) -> Slide:
        """Slide that carries the platform to and fro."""
        return Slide(f"{self.name}_sledge", _ORBIT, friction=6.0, effort=25.0)

    @property
    def platform(self) -> Slide:
        """The platform, which goes from side to side on the sledge."""
        return Slide(f"{self.name}_platform", _ORBIT, friction=6.0, effort=25.0)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.036)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.speed, self.sledge, self.platform

    @property
    def mat(self) -> Seat:
        """The middle of the mat."""
        at = (0.0, 0.0, 0.018)
        return Seat(f"{self.name}_mat", self.platform.name, at, width=0.140)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.mat,)

    @property
    def displays(self) -> tuple[Display, ...]:
        speed = Scale(self.speed, 0, 300, "rpm", resolution=5)
        return (Display(f"{self.name}_display", (0.080, 0.026), speed),)

    def _forms(self) -> list[Form]:
        side = ((-0.210, 0.012), (0.210, 0.012), (0.210, 0.092), (-0.150, 0.092), (-0.210, 0.040))
        return [
            Prism(side, (-0.180, 0.180), "white", edge=0.006),
            Block((-0.208, 0.208), (-0.178, 0.178), (0.010, 0.026), "petrol", edge=0.004),
            *feet(0.420, 0.360, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(49.1)
        self.speed.add_to(spec, self.name, body, (-0.182, -0.090, 0.0643), lean)
        self.displays[0].add_to(spec, body, (-0.1822, 0.050, 0.0648), lean)
        half = _ORBIT / 2
        sledge = self.sledge.add_to(spec, body, (0.030 - half, -half, 0.093), (1.0, 0.0, 0.0))
        assemble(spec, sledge, self.name, [Rod((0, 0, 0), (0, 0, 0.022), 0.09, "dark_steel")], 1.0)
        platform = self.platform.add_to(spec, sledge, (0.0, 0.0, 0.023), (0.0, 1.0, 0.0))
        rails: list[Form] = [
            Block((x - 0.006, x + 0.006), (-0.158, 0.158), (0.016, 0.034), "steel")
            for x in (-0.128, 0.128)
        ]
        forms: list[Form] = [
            Block((-0.165, 0.165), (-0.165, 0.165), (0.000, 0.014), "steel", edge=0.004),
            Block((-0.118, 0.118), (-0.155, 0.155), (0.013, 0.018), "rubber", edge=0.001),
            *rails,
        ]
        assemble(spec, platform, self.name, forms, mass=2.0)
        self.mat.add_to(platform)
