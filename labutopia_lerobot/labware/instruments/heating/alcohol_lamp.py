"""An alcohol lamp with a cap on a hinge."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.flame import Flame, hot_gases
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.processes import Process

_TIP = (0.0, 0.0, 0.090)
"""Where the wick burns [m]."""
_WATT, _LOW, _REACH = 250.0, 0.3, 0.14
"""Power with the wick all out [W], its share with the wick all in, and how high above the wick it
heats [m]; ours: some 0.6 g of ethanol a minute, of 26.8 kJ/g (CRC Handbook), and up to the gauze of
a tripod."""


@dataclass(frozen=True)
class AlcoholLamp(Instrument):
    """An alcohol lamp: its cap swings over the wick to put it out, a wheel moves the wick.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.085, 0.085, 0.109)
    mass = 0.25
    source = "85 mm across, 105 mm high, 150 ml, as usual; from memory"
    movable = True
    left_out = "no alcohol is used up; it lights itself"

    @property
    def cap(self) -> Rotor:
        """The cap, built over the wick; it swings up and back."""
        return Rotor(f"{self.name}_cap", friction=0.01, effort=0.03, widest=math.radians(110.0))

    @property
    def wick(self) -> Knob:
        """The little wheel that raises the wick."""
        return Knob(f"{self.name}_wick", diameter=0.012, depth=0.008, look="brass", pointer="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.cap, self.wick

    @property
    def flame(self) -> Flame:
        """The flame; the cap over it puts it out."""
        gases = hot_gases(self.name, _WATT, _TIP, _REACH)
        fuel, uncovered = Scale(self.wick, _LOW, 1, "1", 0.01), Scale(self.cap, 0, 1, "1", 0.01)
        return Flame(f"{self.name}_flame", gases, _WATT, fuel, open=uncovered)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its flame and the gases of it."""
        return self.flame.gases, self.flame

    def _forms(self) -> list[Form]:
        glass = (
            (0.0, 0.0),
            (0.038, 0.0),
            (0.042, 0.006),
            (0.0425, 0.020),
            (0.038, 0.040),
            (0.024, 0.054),
            (0.013, 0.058),
            (0.013, 0.066),
        )
        return [
            Turned(glass, "glass", edge=0.002),
            Turned(
                ((0.0, 0.003), (0.037, 0.003), (0.040, 0.020), (0.037, 0.034)),
                "light_blue",
                edge=0.002,
                touch=False,
            ),
            Rod((0, 0, 0.034), (0, 0, 0.0341), 0.073, "light_blue", touch=False),
            Rod((0, 0, 0.060), (0, 0, 0.074), 0.030, "brass"),
            Rod((0, 0, 0.072), (0, 0, 0.084), 0.009, "brass"),
            Rod((0, 0, 0.020), (0, 0, 0.092), 0.006, "cream", touch=False),
            Block((0.012, 0.024), (-0.005, 0.005), (0.064, 0.074), "brass", edge=0.001),
            Block((-0.022, -0.012), (-0.006, 0.006), (0.060, 0.073), "brass", edge=0.001),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        axis = (0.0, 1.0, 0.0)
        self.wick.add_to(spec, self.name, body, (-0.022, 0.0, 0.066), ON_FRONT)
        self.flame.add_to(spec, body, _TIP, (0.007, 0.007, 0.020))
        cap = self.cap.add_to(spec, body, (0.0225, 0.0, 0.0765), axis, balanced=True)
        bell = ((0.0125, 0.0), (0.0125, 0.016), (0.008, 0.024), (0.0, 0.026))
        forms: list[Form] = [
            Turned(bell, "chrome", (-0.0225, 0.0, 0.0), touch=False),
            Ring(0.020, 0.025, (0.0, 0.018), "chrome", at=(-0.0225, 0.0), facets=8),
            Rod((-0.0225, 0, 0.019), (-0.0225, 0, 0.026), 0.016, "chrome"),
            Rod((-0.0225, 0, 0.025), (-0.0225, 0, 0.032), 0.008, "black"),
            Rod((0, -0.006, 0), (0, 0.006, 0), 0.005, "chrome"),
            Block((-0.011, 0.001), (-0.003, 0.003), (0.001, 0.005), "chrome", edge=0.001),
        ]
        assemble(spec, cap, self.name, forms, mass=0.02)
