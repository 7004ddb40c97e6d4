"""A vessel for liquid nitrogen, and the canister that is let down into it."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.liquid_nitrogen import (
    BOILS,
    CAPACITY,
    DENSITY,
    EVAPORATION,
    BoilOff,
    LiquidNitrogen,
)
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import HeatZone, Process, ThermalMass
from labutopia_lerobot.world.model import COLLISION_GROUP

_FILLED = 35e-3
"""Volume of the liquid at the start: that of `source` [m^3]."""
_INSIDE, _NECK = 0.400, 0.094
"""Inner diameters of the vessel and of its neck [m]."""
_STATIC = 0.3e-3 / 86400.0
"""What boils off shut [m^3/s]: 0.3 l a day; makers state 0.1 to 0.3 of 35 l (from memory)."""
_LEAK = _STATIC * DENSITY * EVAPORATION / (20.0 - BOILS)
"""What comes through insulation, neck and stopper [W/K], in a room of 20 degrees C."""
_IN_NITROGEN = 150.0
"""From the liquid, and the vapour over it, to a thing in it [W/m^2 K]; ours: liquid nitrogen that
boils as a film on something warm has 100 to 200."""
_FLOOR, _SHOULDER = 0.060, 0.440
"""Heights of its floor and of where it gets narrow [m]."""
_CUP = -0.480
"""Lower end of the canister below the stopper [m]."""


@dataclass(frozen=True)
class NitrogenDewar(Instrument):
    """A vessel for liquid nitrogen: its stopper is drawn up with the canister that hangs from it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.463, 0.460, 0.775)
    mass = 14.0
    source = "460 mm across, 670 mm high, neck of 90 mm, 35 l, as usual; from memory"
    left_out = "nothing freezes in it; vapour cools as the liquid does; it burns no hand"

    @property
    def stopper(self) -> Slide:
        """The stopper, and below it the canister; drawn up by 500 mm, out of the neck."""
        return Slide(f"{self.name}_stopper", 0.500, friction=6.0, effort=30.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.stopper,)

    @property
    def canister(self) -> Seat:
        """The floor of the canister, which is let down into the liquid."""
        at = (0.0, 0.0, _CUP + 0.004)
        return Seat(f"{self.name}_canister", self.stopper.name, at, width=0.044, depth=0.090)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.canister,)

    @property
    def nitrogen(self) -> LiquidNitrogen:
        """The nitrogen that is left, and its level."""
        half = _INSIDE / 2
        zone = HeatZone((-half, -half, _FLOOR), (half, half, _SHOULDER), _IN_NITROGEN)
        cold = ThermalMass(
            f"{self.name}_temperature",
            self.name,
            _FILLED * DENSITY * CAPACITY,
            leak=_LEAK,
            zone=zone,
            begins=BOILS,
        )
        name = f"{self.name}_level"
        return LiquidNitrogen(name, cold, self.stopper, _NECK, _INSIDE, _FILLED)

    @property
    def boil_off(self) -> BoilOff:
        return BoilOff(f"{self.name}_boil_off", self.nitrogen, f"{self.name}_mouth")

    @property
    def works(self) -> tuple[Process, ...]:
        """Its cold, the nitrogen, and how it boils off."""
        return self.nitrogen.cold, self.nitrogen, self.boil_off

    def _forms(self) -> list[Form]:
        bulge = (
            (0.170, 0.030),
            (0.215, 0.050),
            (0.230, 0.090),
            (0.230, 0.400),
            (0.215, 0.460),
            (0.170, 0.515),
            (0.110, 0.555),
            (0.065, 0.575),
        )
        return [
            Turned(bulge, "light_blue", touch=False, edge=0.006),
            Ring(0.360, 0.420, (0.0, 0.040), "anthracite"),
            Ring(0.400, 0.460, (0.060, 0.460), "light_blue", segments=64),
            Ring(0.220, 0.400, (0.440, 0.520), "light_blue"),
            Ring(0.094, 0.130, (0.520, 0.660), "steel"),
            Ring(0.094, 0.150, (0.645, 0.670), "steel"),
            Rod((0, 0, 0.030), (0, 0, 0.060), 0.400, "light_blue"),
            *(
                Block(
                    (-0.030, 0.030), (s * 0.205 - 0.010, s * 0.205 + 0.010), (0.44, 0.59), "steel"
                )
                for s in (-1, 1)
            ),
            Rod((-0.060, -0.205, 0.592), (0.060, -0.205, 0.592), 0.026, "black"),
            Rod((-0.060, 0.205, 0.592), (0.060, 0.205, 0.592), 0.026, "black"),
            Block((-0.2325, -0.222), (-0.050, 0.050), (0.22, 0.32), "yellow", 0.001, touch=False),
            Block((-0.2333, -0.232), (-0.006, 0.006), (0.252, 0.305), "black", 0.0, touch=False),
            Block((-0.2333, -0.232), (-0.006, 0.006), (0.234, 0.246), "black", 0.0, touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        up = (0.0, 0.0, 1.0)
        stopper = self.stopper.add_to(spec, body, (0.0, 0.0, 0.6705), up, balanced=True)
        forms: list[Form] = [
            Turned(((0.0, 0.0), (0.070, 0.0), (0.070, 0.016), (0.050, 0.036)), "blue"),
            Rod((0, 0, 0.030), (0, 0, 0.040), 0.100, "blue"),
            Rod((0, 0, 0.036), (0, 0, 0.080), 0.020, "black"),
            Rod((0, 0, 0.078), (0, 0, 0.104), 0.050, "black"),
            Rod((0, 0, -0.100), (0, 0, 0.0), 0.086, "ceramic"),
            Rod((0.032, 0, _CUP), (0.032, 0, -0.100), 0.006, "steel"),
            Rod((0, 0, _CUP), (0, 0, _CUP + 0.004), 0.070, "steel"),
            Ring(0.066, 0.070, (_CUP + 0.004, _CUP + 0.100), "steel"),
        ]
        assemble(spec, stopper, self.name, forms, mass=0.9)
        self.canister.add_to(stopper)
        mouth = (0.0, 0.0, 0.670)
        body.add_site(name=self.boil_off.mouth, pos=mouth, group=COLLISION_GROUP)
        self.boil_off.puffs.add_to(spec, body, (0.0, 0.0, 0.300))
