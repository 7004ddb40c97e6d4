"""A gel electrophoresis tank with its power supply."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.guard import Flipped, Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.power_supply import PowerSupply
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process, ThermalMass
from labutopia_lerobot.processes.heat import UPWARDS

_BUFFER = 1.2e-3 * 997.0 * 4182.0
"""Heat that warms its 1.2 l of buffer by 1 K [J/K]."""
_SURFACE, _LEAK = 0.24 * 0.14, 0.3
"""Surface of the buffer [m^2], and what its walls let through [W/K]; ours."""
_RESISTANCE = 1200.0
"""Of gel and buffer [ohm]; ours: 100 V drive some 80 mA through a gel of this size."""
_PLUGGED = 0.005
"""How far the lid may be lifted before its plugs are out [m]; ours."""


@dataclass(frozen=True)
class ElectrophoresisTank(Instrument):
    """A gel tank, whose lid with the leads is lifted off, beside its power supply.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.263, 0.313, 0.103)
    mass = 3.2
    source = "tank of 150 x 250 x 90 mm, supply of 120 x 230 x 100 mm, as usual; from memory"
    left_out = "no band moves"

    @property
    def lid(self) -> Slide:
        """The lid with both leads, lifted off its plugs."""
        return Slide(f"{self.name}_lid", 0.100, friction=2.0, effort=12.0)

    @property
    def voltage(self) -> Knob:
        return Knob(f"{self.name}_voltage", diameter=0.036)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="red")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.voltage, self.power

    @property
    def places(self) -> tuple[Seat, ...]:
        """The table on which the gel lies, in the middle of the tank."""
        return (Seat(f"{self.name}_table", self.name, (0.0, 0.075, 0.041), width=0.085),)

    @property
    def set_voltage(self) -> Scale:
        return Scale(self.voltage, 0, 300, "V", resolution=5)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob and its switch, the plugs of its lid, its buffer and its supply."""
        on, plugs = Flipped(self.power), Shut(self.lid, within=_PLUGGED)
        buffer = ThermalMass(
            f"{self.name}_buffer",
            self.name,
            _BUFFER,
            area=_SURFACE,
            length=_SURFACE / (2 * (0.24 + 0.14)),  # area over circumference
            convection=UPWARDS,
            leak=_LEAK,
        )
        supply = PowerSupply(
            f"{self.name}_current",
            self.set_voltage,
            _RESISTANCE,
            buffer,
            (on.name, plugs.name),
        )
        return self.set_voltage, on, plugs, buffer, supply

    @property
    def displays(self) -> tuple[Display, ...]:
        size, red = (0.080, 0.032), (255, 90, 60)
        return (Display(f"{self.name}_display", size, self.set_voltage, ink=red),)

    def _forms(self) -> list[Form]:
        y = 0.075
        return [
            *tub((-0.125, 0.125), (y - 0.075, y + 0.075), (0.004, 0.080), 0.005, "glass_edge"),
            *feet(0.24, 0.18, 0.004),
            Block((-0.055, 0.055), (y - 0.070, y + 0.070), (0.008, 0.041), "glass_edge", 0.001),
            Block((-0.120, 0.120), (y - 0.070, y + 0.070), (0.009, 0.060), "water", touch=False),
            *(
                Block((x - 0.003, x + 0.003), (y - 0.068, y + 0.068), (0.010, 0.013), look, 0.0)
                for x, look in ((-0.110, "black"), (0.110, "red"))
            ),
            *(
                Rod((x, y, 0.012), (x, y, 0.078), 0.006, look, touch=False)
                for x, look in ((-0.117, "black"), (0.117, "red"))
            ),
            Block((-0.115, 0.115), (-0.160, -0.030), (0.006, 0.100), "light_grey", edge=0.008),
            Block((-0.1165, -0.100), (-0.152, -0.038), (0.012, 0.094), "anthracite"),
            *(
                Rod(
                    (-0.1235, -0.095 + s * 0.012, 0.024),
                    (-0.110, -0.095 + s * 0.012, 0.024),
                    0.012,
                    look,
                )
                for s, look in ((1, "black"), (-1, "red"))
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.voltage.add_to(spec, self.name, body, (-0.1165, -0.125, 0.050), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.1165, -0.062, 0.046), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1168, -0.095, 0.077), ON_FRONT)
        up = (0.0, 0.0, 1.0)
        lid = self.lid.add_to(spec, body, (0.0, 0.075, 0.0805), up, balanced=True)
        forms: list[Form] = [
            Block((-0.128, 0.128), (-0.078, 0.078), (0.0, 0.004), "smoked", 0.001),
            Rod((-0.117, 0, 0.003), (-0.117, 0, 0.022), 0.014, "black"),
            Rod((0.117, 0, 0.003), (0.117, 0, 0.022), 0.014, "red"),
            Block((-0.030, 0.030), (-0.010, 0.010), (0.003, 0.016), "anthracite"),
        ]
        assemble(spec, lid, self.name, forms, mass=0.25)
