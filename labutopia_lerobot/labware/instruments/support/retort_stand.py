"""A retort stand with a ring and a clamp."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide

_ROD = (0.080, 0.0)
"""Position of the rod on the base, x and y [m]."""


@dataclass(frozen=True)
class RetortStand(Instrument):
    """A stand whose ring and clamp slide on its rod; the clamp's jaw closes with a screw.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.210, 0.130, 0.700)
    mass = 2.6
    source = "base of 210 x 130 mm, rod of 12 x 700 mm (DIN 12892, 12891); from memory"
    movable = True
    passive = True

    @property
    def ring(self) -> Slide:
        """The ring with its boss, which is pushed up."""
        return Slide(f"{self.name}_ring", 0.120, friction=12.0, effort=40.0)

    @property
    def clamp(self) -> Slide:
        """The clamp with its boss, which is pushed up."""
        return Slide(f"{self.name}_clamp", 0.160, friction=12.0, effort=40.0)

    @property
    def jaw(self) -> Slide:
        """The moving jaw of the clamp, which closes."""
        return Slide(f"{self.name}_jaw", 0.024, friction=2.0, effort=10.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.clamp, self.ring, self.jaw

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bars of the ring."""
        at = (-0.120, 0.0, 0.008)
        return (Seat(f"{self.name}_ring_middle", self.ring.name, at, width=0.110),)

    def _forms(self) -> list[Form]:
        x, y = _ROD
        return [
            Block((-0.105, 0.105), (-0.065, 0.065), (0.002, 0.014), "anthracite", edge=0.004),
            *feet(0.200, 0.130, 0.003),
            Rod((x, y, 0.014), (x, y, 0.700), 0.012, "chrome"),
            Rod((x, y, 0.014), (x, y, 0.030), 0.024, "anthracite"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        boss: list[Form] = [
            Block((-0.030, -0.0062), (-0.014, 0.014), (-0.012, 0.012), "steel"),
            Block((-0.007, 0.014), (0.0062, 0.014), (-0.012, 0.012), "steel"),
            Rod((0.0, 0.012, 0.0), (0.0, 0.034, 0.0), 0.008, "chrome"),
            Rod((0.0, 0.030, 0.0), (0.0, 0.036, 0.0), 0.024, "black"),
        ]
        ring = self.ring.add_to(spec, body, (*_ROD, 0.230), (0.0, 0.0, 1.0), balanced=True)
        forms: list[Form] = [
            *boss,
            Rod((-0.028, 0.0, 0.0), (-0.070, 0.0, 0.0), 0.008, "dark_steel"),
            Ring(0.096, 0.110, (-0.004, 0.004), "dark_steel", at=(-0.120, 0.0)),
            *(
                Rod((-0.167, y, 0.0055), (-0.073, y, 0.0055), 0.005, "dark_steel")
                for y in (-0.020, 0.020)
            ),
        ]
        assemble(spec, ring, self.name, forms, mass=0.30)
        self.places[0].add_to(ring)
        clamp = self.clamp.add_to(spec, body, (*_ROD, 0.500), (0.0, 0.0, 1.0), balanced=True)
        forms = [
            *boss,
            Rod((-0.028, 0.0, 0.0), (-0.100, 0.0, 0.0), 0.008, "chrome"),
            Block((-0.118, -0.096), (-0.034, 0.028), (-0.010, 0.010), "steel"),
            Block((-0.170, -0.112), (-0.034, -0.026), (-0.010, 0.010), "steel"),
            Block((-0.168, -0.124), (-0.026, -0.023), (-0.009, 0.009), "red", edge=0.001),
            Rod((-0.107, 0.028, 0.0), (-0.107, 0.056, 0.0), 0.006, "chrome"),
            Block((-0.113, -0.101), (0.054, 0.058), (-0.012, 0.012), "chrome", edge=0.001),
        ]
        assemble(spec, clamp, self.name, forms, mass=0.30)
        jaw = self.jaw.add_to(spec, clamp, (-0.119, 0.026, 0.0), (0.0, -1.0, 0.0))
        forms = [
            Block((-0.051, -0.001), (0.000, 0.008), (-0.010, 0.010), "steel"),
            Block((-0.049, -0.006), (-0.003, 0.000), (-0.009, 0.009), "red", edge=0.001),
        ]
        assemble(spec, jaw, self.name, forms, mass=0.05)
