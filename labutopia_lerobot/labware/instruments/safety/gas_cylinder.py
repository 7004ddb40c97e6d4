"""A gas cylinder with its valve and a pressure regulator."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.compressed_gas import (
    CompressedGas,
    OutletFlow,
    OutletPressure,
)
from labutopia_lerobot.labware.parts.dial_gauge import DialGauge
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT, ON_TOP
from labutopia_lerobot.labware.parts.valve import HandWheel, Tap
from labutopia_lerobot.processes import Process

_R = 0.115
"""Radius of the cylinder [m]."""
_VOLUMES = (50e-3, 20e-6, 50e-6)
"""Of the cylinder, that of `source`, and before and behind its regulator [m^3]; ours."""
_FILLED = 200.0
"""Pressure of the full cylinder, above the room's [bar]; as usual."""
_HOLE = math.pi * 0.0005**2
"""Area of the open outlet [m^2]; ours: 1 mm wide, 62 l/min at 10 bar."""
_MOLAR, _KAPPA = 0.0280134, 1.40
"""Of nitrogen: molar mass [kg/mol], ratio of its heat capacities (CRC Handbook)."""


@dataclass(frozen=True)
class GasCylinder(Instrument):
    """A nitrogen cylinder chained to its stand: hand-wheel, regulator with two gauges and a knob.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.290, 0.300, 1.540)
    mass = 75.0
    source = "230 mm across, 1.5 m, 50 l; shoulder black for nitrogen (EN 1089-3); from memory"
    left_out = "its outlet leads nowhere, its gas does not cool as it expands"

    @property
    def valve(self) -> HandWheel:
        return HandWheel(f"{self.name}_valve", diameter=0.070, turns=1.5, look="dark_steel")

    @property
    def pressure(self) -> Knob:
        """Knob that sets the pressure behind the regulator."""
        return Knob(f"{self.name}_pressure", diameter=0.046, depth=0.040, look="blue")

    @property
    def outlet(self) -> Tap:
        return Tap(f"{self.name}_outlet", length=0.030, look="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.valve, self.pressure, self.outlet

    @property
    def scale(self) -> Scale:
        """What its knob sets."""
        return Scale(self.pressure, 0.0, 10.0, "bar", resolution=0.1)

    @property
    def gas(self) -> CompressedGas:
        """The nitrogen in cylinder and regulator; reads as the first gauge does."""
        return CompressedGas(
            f"{self.name}_contents",
            self.valve,
            self.scale,
            self.outlet,
            _HOLE,
            _VOLUMES,
            _FILLED,
            _MOLAR,
            _KAPPA,
        )

    @property
    def gauges(self) -> tuple[DialGauge, DialGauge]:
        """That of the cylinder on the left, that of the outlet on the right."""
        low = OutletPressure(f"{self.name}_outlet_pressure", self.gas)
        y, radius = 1.2 * 0.062, 0.026
        return (
            DialGauge(f"{self.name}_high_gauge", self.gas, 300.0, radius, (-0.060, y, 1.510)),
            DialGauge(f"{self.name}_low_gauge", low, 16.0, radius, (-0.060, -y, 1.510)),
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob, its gas, what leaves it and both gauges."""
        high, low = self.gauges
        flow = OutletFlow(f"{self.name}_flow", self.gas)
        return self.scale, self.gas, low.of, flow, high, low

    def _forms(self) -> list[Form]:
        body = ((0, 0.030), (_R - 0.010, 0.030), (_R, 0.045), (_R, 1.260))
        shoulder = ((_R, 1.260), (0.100, 1.320), (0.060, 1.370), (0.036, 1.390), (0.036, 1.420))
        gauges: list[Form] = []
        for y in (-0.062, 0.062):
            gauges += [
                Rod((-0.030, 0.5 * y, 1.462), (-0.030, 0.8 * y, 1.490), 0.012, "brass"),
                Rod((-0.060, 1.2 * y, 1.510), (-0.030, 1.2 * y, 1.510), 0.060, "brass"),
            ]
        return [
            Turned(body, "grey", edge=0.004),
            Turned(shoulder, "black", edge=0.006),
            Rod((0, 0, 1.420), (0, 0, 1.492), 0.032, "brass"),
            Rod((0, 0, 1.456), (-0.060, 0, 1.456), 0.028, "brass"),
            Turned(
                ((0, 0), (0.034, 0), (0.034, 0.020), (0.020, 0.030), (0, 0.030)),
                "brass",
                (-0.050, 0, 1.456),
                (-1, 0, 0),
            ),
            *gauges,
            *(form for gauge in self.gauges for form in gauge.forms()),
            Rod((-0.060, 0, 1.440), (-0.060, 0, 1.380), 0.014, "brass"),
            Block((-0.130, 0.160), (-0.150, 0.150), (0.0, 0.030), "yellow", edge=0.006),
            Block((0.118, 0.158), (-0.150, 0.150), (0.860, 0.940), "yellow"),
            *(
                Block(
                    (0.120, 0.150), (s * 0.135 - 0.014, s * 0.135 + 0.014), (0.02, 0.900), "yellow"
                )
                for s in (-1, 1)
            ),
            Ring(0.232, 0.244, (0.890, 0.905), "chrome", touch=False),
            Block((-_R - 0.001, -0.09), (-0.045, 0.045), (0.950, 1.080), "white", 0.0, touch=False),
            Block((-_R - 0.0015, -0.1), (-0.045, 0.045), (1.050, 1.080), "green", 0.0, touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.valve.add_to(spec, self.name, body, (0, 0, 1.492), ON_TOP)
        self.pressure.add_to(spec, self.name, body, (-0.080, 0, 1.456), ON_FRONT)
        for gauge in self.gauges:
            gauge.add_to(body, finish(spec, self.name, "red"))
        self.outlet.add_to(spec, self.name, body, (-0.067, 0, 1.400), ON_FRONT)
