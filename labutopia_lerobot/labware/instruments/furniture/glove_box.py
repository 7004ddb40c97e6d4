"""A glove box on its frame."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Unmeasured
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat

_FLOOR, _ROOF = 0.920, 1.820
"""Heights of the chamber's floor and top [m]."""
_X, _LEFT, _RIGHT = 0.390, 0.950, -0.450
"""Half depth of the chamber, and where its left and right walls end [m]."""
_SILL, _EAVE = (-_X, 1.100), (-0.140, _ROOF)
"""Lower and upper edge of the pane, in x and z [m]."""
_LOCK = (1.000, 1.450)
"""Lower and upper end of the lock [m]."""
_WALL = 0.012


@dataclass(frozen=True)
class GloveBox(Instrument):
    """A chamber of steel under inert gas: a sloping pane with two gloves, a lock on its right.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.780, 1.900, 1.900)
    mass = 300.0
    source = "chamber 1400 x 780 x 900 mm with a lock of 400 mm, as usual; from memory"
    left_out = "its gas is not measured"

    @property
    def lock(self) -> Rotor:
        """The outer door of the lock, which opens to the front."""
        return Rotor(f"{self.name}_lock_door", friction=1.0, effort=8.0, widest=1.90)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.lock,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The floor of the chamber, left and right."""
        return tuple(
            Seat(f"{self.name}_floor_{side}", self.name, (0.10, y, _FLOOR + _WALL), width=0.40)
            for side, y in (("left", 0.60), ("right", -0.10))
        )

    @property
    def displays(self) -> tuple[Display, ...]:
        shown = Unmeasured(f"{self.name}_oxygen", "ppm O2", 0.1, "LOCK OPEN", self.lock)
        return (Display(f"{self.name}_display", (0.160, 0.050), shown),)

    def _forms(self) -> list[Form]:
        side = ((-_X, _FLOOR), (_X, _FLOOR), (_X, _ROOF), _EAVE, _SILL)
        (x, z), (far, top) = _SILL, _EAVE
        pane = ((x, z), (x + 0.012, z - 0.004), (far + 0.012, top - 0.004), (far, top))
        inner = (_RIGHT + _WALL, _LEFT - _WALL)
        legs: list[Form] = [
            Block((i - 0.03, i + 0.03), (j - 0.03, j + 0.03), (0.0, _FLOOR - 0.05), "dark_steel")
            for i in (-_X + 0.05, _X - 0.05)
            for j in (-0.90, _RIGHT + 0.05, _LEFT - 0.05)
        ]
        return [
            *legs,
            Block((-_X, _X), (-0.94, _LEFT), (_FLOOR - 0.05, _FLOOR), "dark_steel"),
            Block((-_X + 0.02, _X - 0.02), (-0.92, _LEFT - 0.02), (0.18, 0.20), "dark_steel"),
            Prism(side, (_LEFT - _WALL, _LEFT), "steel"),
            Prism(side, (_RIGHT, _RIGHT + _WALL), "steel"),
            Block((-_X, _X), inner, (_FLOOR, _FLOOR + _WALL), "steel", 0.0),
            Block((_X - _WALL, _X), inner, (_FLOOR, _ROOF), "steel", 0.0),
            Block((far, _X), inner, (_ROOF - _WALL, _ROOF), "steel", 0.0),
            Block((-_X, -_X + _WALL), inner, (_FLOOR, z), "steel", 0.0),
            Prism(pane, inner, "glass", 0.0),
            Block((0.0, 0.30), (0.0, 0.50), (_ROOF, 1.900), "white", 0.01),
            Block((-0.05, 0.05), (-0.30, 0.80), (_ROOF - 0.02, _ROOF - _WALL), "glow", touch=False),
            *self._ports(),
            *self._lock(),
            Rod((0.0, -0.70, _LOCK[0]), (0.0, -0.70, _FLOOR - 0.01), 0.10, "steel"),
            Rod((0.15, -0.70, 0.20), (0.15, -0.70, 0.56), 0.22, "blue"),
        ]

    def _ports(self) -> list[Form]:
        """Return the two ports in the pane, and the gloves that hang into the chamber."""
        (x, z), (far, top) = _SILL, _EAVE
        out = (-(top - z), 0.0, far - x)
        share = 0.36
        middle = (x + share * (far - x), z + share * (top - z))
        collar = ((0.090, -0.004), (0.118, -0.004), (0.118, 0.026), (0.090, 0.026))
        sleeve = ((0.060, 0.0), (0.092, 0.020), (0.060, 0.30), (0.048, 0.36), (0.0, 0.42))
        forms: list[Form] = []
        for y in (0.02, 0.48):
            at = (middle[0], y, middle[1])
            forms += [
                Turned((*collar, collar[0]), "white", at, out, touch=False),
                Turned(sleeve, "black", at, (0.75, 0.0, -0.66), touch=False),
            ]
        return forms

    def _lock(self) -> list[Form]:
        """Return the box of the lock, open to the front."""
        (low, high), x, left, right = _LOCK, (-0.25, 0.25), _RIGHT, -0.95
        return [
            Block(x, (right, left), (low, low + _WALL), "steel"),
            Block(x, (right, left), (high - _WALL, high), "steel"),
            Block(x, (right, right + _WALL), (low, high), "steel"),
            Block((0.25 - _WALL, 0.25), (right, left), (low, high), "steel", 0.0),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        low, high = _LOCK
        door = self.lock.add_to(spec, body, (-0.282, -0.948, low + 0.002), (0.0, 0.0, 1.0))
        middle = (high - low) / 2
        forms: list[Form] = [
            Block((0.0, 0.030), (0.0, 0.494), (0.0, high - low - 0.004), "steel", 0.006),
            Rod((-0.045, 0.247, middle), (0.0, 0.247, middle), 0.024, "dark_steel"),
            Rod((-0.060, 0.247, middle), (-0.045, 0.247, middle), 0.140, "black"),
        ]
        assemble(spec, door, self.name, forms, mass=9.0)
        at = (-_X - 0.001, _LEFT - 0.30, _SILL[1] - 0.09)
        self.displays[0].add_to(spec, body, at, ON_FRONT)
