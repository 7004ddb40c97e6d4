"""A Bunsen burner with an air collar and a gas tap."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.flame import Flame, hot_gases
from labutopia_lerobot.labware.parts.form import Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.processes import Process

_MOUTH = (0.0, 0.0, 0.150)
"""Where the gas burns [m]."""
_WATT, _REACH = 1200.0, 0.10
"""Power with the tap open [W]; ours: makers state 1 to 1.5 kW. How high above its mouth it heats
[m]; ours: up to the gauze of a tripod and a little more."""


@dataclass(frozen=True)
class BunsenBurner(Instrument):
    """A Bunsen burner: the collar opens its air holes, the tap on its inlet the gas.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.128, 0.090, 0.150)
    mass = 0.45
    source = "base of 90 mm, tube of 13 mm, 150 mm high (DIN 30665 burners are alike); from memory"
    movable = True
    left_out = "it needs no line and lights itself"

    @property
    def air(self) -> Rotor:
        """The collar; it stops when the holes are wide open."""
        collar = f"{self.name}_collar"
        return Rotor(collar, friction=0.01, effort=0.1, widest=math.radians(90.0))

    @property
    def gas(self) -> Tap:
        return Tap(f"{self.name}_tap", length=0.030, look="yellow", standoff=0.008)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.air, self.gas

    @property
    def flame(self) -> Flame:
        """The flame: luminous with the holes shut, blue with them open."""
        gases = hot_gases(self.name, _WATT, _MOUTH, _REACH)
        fuel, air = Scale(self.gas, 0, 1, "1", 0.01), Scale(self.air, 0, 1, "1", 0.01)
        return Flame(f"{self.name}_flame", gases, _WATT, fuel, air=air)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its flame and the gases of it."""
        return self.flame.gases, self.flame

    def _forms(self) -> list[Form]:
        foot = ((0, 0), (0.045, 0), (0.045, 0.007), (0.030, 0.013), (0.012, 0.020), (0.010, 0.034))
        tube = ((0.0070, 0.034), (0.0070, 0.138), (0.0085, 0.142), (0.0085, 0.150))
        bore = ((0.0060, 0.150), (0.0060, 0.100), (0.0, 0.100))
        inlet = [(-0.010, 0.0, 0.026), (-0.046, 0.0, 0.026), (-0.083, 0.0, 0.026)]
        barbs: list[Form] = [
            Turned(
                ((0.0025, 0), (0.0048, 0.003), (0.0035, 0.008)),
                "brass",
                (-0.056 - 0.008 * n, 0, 0.026),
                (-1, 0, 0),
                edge=0.0,
                touch=False,
                segments=16,
            )
            for n in range(3)
        ]
        return [
            Turned((*foot, (0.0070, 0.034)), "dark_steel"),
            Turned(tube, "brass"),
            Turned((tube[-1], *bore), "black", touch=False, edge=0.0),
            Rod(inlet[0], inlet[1], 0.010, "brass"),
            Rod(inlet[1], inlet[2], 0.006, "brass"),
            Rod((-0.030, 0, 0.020), (-0.030, 0, 0.034), 0.013, "brass"),
            *barbs,
            *(
                Rod((0.0, y, 0.050), (0.0, 1.06 * y, 0.050), 0.007, "black", touch=False)
                for y in (-0.0075, 0.0075)
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        half = math.sqrt(0.5)  # z down onto the inlet, the shut wing across it
        self.gas.add_to(spec, self.name, body, (-0.030, 0, 0.034), (0.0, half, half, 0.0))
        self.flame.add_to(spec, body, _MOUTH, (0.011, 0.011, 0.033))
        collar = self.air.add_to(spec, body, (0.0, 0.0, 0.050))
        forms: list[Form] = [
            Ring(0.0152, 0.021, (-0.012, 0.012), "chrome"),
            *(
                Rod((y, 0, 0), (1.05 * y, 0, 0), 0.008, "black", touch=False)
                for y in (-0.0102, 0.0102)
            ),
        ]
        assemble(spec, collar, self.name, forms, mass=0.02)
