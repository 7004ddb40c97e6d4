"""A melting-point apparatus."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.warmth import Regulated, block
from labutopia_lerobot.processes import HeatZone, Process
from labutopia_lerobot.processes.hot_surface import IN_BORE
from labutopia_lerobot.world import ON


@dataclass(frozen=True)
class MeltingPointApparatus(Instrument):
    """A melting-point apparatus: three capillaries in a heated block, watched through a lens.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.250, 0.180, 0.225)
    mass = 2.4
    source = "180 x 250 x 180 mm, as usual; from memory"
    left_out = "nothing melts"

    @property
    def lens(self) -> Slide:
        """The lens before the window, which is pulled out to focus."""
        return Slide(f"{self.name}_lens", 0.015, friction=1.0, effort=5.0)

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.038, pointer="red")

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lens, self.heat, self.power

    @property
    def warming(self) -> tuple[Process, ...]:
        """What knob and switch say, the block and its thermostat; no substance melts in it.

        150 W, ours; a disc of aluminium of 56 by 40 mm, 0.1 l, 2.4 J/cm3 K (Incropera, table A.1).
        """
        knob = Scale(self.heat, 20.0, 360.0, "\u00b0C", resolution=0.1)
        power = Scale(self.power, 0, 1, ON)
        zone = HeatZone((0.005, -0.025, 0.155), (0.055, 0.025, 0.172), IN_BORE)
        by = Regulated(150.0, knob.name, power.name, resolution=0.1)
        return knob, power, *block(self.name, 240.0, 2.5e-3, zone, (), by)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        block_now = self.warming[-1]
        return (Display(f"{self.name}_display", (0.080, 0.030), block_now, ink=(255, 90, 60)),)

    def _forms(self) -> list[Form]:
        side = ((-0.125, 0.010), (0.125, 0.010), (0.125, 0.110), (-0.040, 0.110), (-0.125, 0.040))
        capillaries: list[Form] = []
        for y in (-0.012, 0.0, 0.012):
            capillaries += [
                Rod((0.030, y, 0.168), (0.030, y, 0.172), 0.007, "black", touch=False),
                Rod((0.030, y, 0.165), (0.030, y, 0.225), 0.0016, "glass_edge", False, 10),
            ]
        return [
            Prism(side, (-0.090, 0.090), "light_blue", edge=0.008),
            Block((-0.123, 0.123), (-0.088, 0.088), (0.008, 0.020), "anthracite"),
            *feet(0.25, 0.18, 0.010),
            Block((-0.010, 0.075), (-0.040, 0.040), (0.100, 0.160), "anthracite", edge=0.006),
            Rod((0.030, 0, 0.158), (0.030, 0, 0.168), 0.056, "steel"),
            Ring(0.052, 0.056, (0.156, 0.170), "chrome", at=(0.030, 0.0)),
            Rod((-0.016, 0, 0.132), (-0.008, 0, 0.132), 0.040, "dark_steel"),
            Rod((-0.0165, 0, 0.132), (-0.0155, 0, 0.132), 0.032, "glow", touch=False),
            *capillaries,
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(50.53)
        self.heat.add_to(spec, self.name, body, (-0.0825, -0.055, 0.075), lean)
        self.power.add_to(spec, self.name, body, (-0.0825, 0.070, 0.075), lean)
        self.displays[0].add_to(spec, body, (-0.0827, 0.012, 0.0753), lean)
        lens = self.lens.add_to(spec, body, (-0.0175, 0.0, 0.132), (-1.0, 0.0, 0.0))
        forms: list[Form] = [
            Rod((-0.030, 0, 0), (0.0, 0, 0), 0.036, "black"),
            Rod((-0.0306, 0, 0), (-0.0296, 0, 0), 0.028, "glass_edge", touch=False),
        ]
        assemble(spec, lens, self.name, forms, mass=0.05)
