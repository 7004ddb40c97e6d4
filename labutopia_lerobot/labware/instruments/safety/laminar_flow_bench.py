"""A laminar flow bench on legs."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.air import Fan
from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.form import Block, Form, Prism
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.lamp import Lamp
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Sash
from labutopia_lerobot.processes import Process

_DEPTH, _WIDTH, _HEIGHT = 0.750, 1.300, 2.150
_TOP, _ROOF, _OPEN = 0.850, 1.550, 0.400
"""Heights of the work top and of the filter above it, and how far the sash goes up [m]."""

_DOWNFLOW = 0.45
"""Of the air below the filter [m/s]; makers of such benches set 0.45 m/s, within a fifth."""


@dataclass(frozen=True)
class LaminarFlowBench(Instrument):
    """A laminar flow bench: clean air comes down from its filter, behind a sash of glass.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.750, 1.300, 2.150)
    mass = 190.0
    source = "1300 x 750 x 2150 mm, sash of 400 mm (EN 12469 cabinets are alike); from memory"

    @property
    def sash(self) -> Sash:
        return Sash(f"{self.name}_sash", _OPEN)

    @property
    def light(self) -> Rocker:
        return Rocker(f"{self.name}_light", look="blue")

    @property
    def fan(self) -> Rocker:
        return Rocker(f"{self.name}_fan", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.sash, self.light, self.fan

    @property
    def places(self) -> tuple[Seat, ...]:
        """The work top, left and right of the middle."""
        return tuple(
            Seat(f"{self.name}_top_{side}", self.name, (0.05, y, _TOP), width=0.40)
            for side, y in (("left", 0.30), ("right", -0.30))
        )

    @property
    def air(self) -> Fan:
        """The air that comes down from its filter."""
        return Fan(f"{self.name}_air", self.fan.name, _DOWNFLOW)

    @property
    def works(self) -> tuple[Process, ...]:
        """The switches of its fan and of its light, its air and its lamp."""
        return Flipped(self.fan), self.lamp.level, self.air, self.lamp

    @property
    def lamp(self) -> Lamp:
        """The lamp in its roof."""
        return Lamp(f"{self.name}_lamp", Flipped(self.light))

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.120, 0.040), self.air),)

    def _forms(self) -> list[Form]:
        x, y = _DEPTH / 2, _WIDTH / 2
        slots = [-0.55 + 0.05 * n for n in range(23)]
        return [
            *(
                Block((i - 0.03, i + 0.03), (j - 0.03, j + 0.03), (0.0, _TOP - 0.10), "light_grey")
                for i in (-x + 0.06, x - 0.04)
                for j in (-y + 0.04, y - 0.04)
            ),
            Block((x - 0.06, x - 0.03), (-y + 0.04, y - 0.04), (0.20, 0.28), "light_grey"),
            Block((-x, x), (-y, y), (_TOP - 0.12, _TOP - 0.02), "white", edge=0.010),
            Block((-x + 0.01, x - 0.02), (-y + 0.02, y - 0.02), (_TOP - 0.03, _TOP), "steel"),
            *(
                Block(
                    (-x + 0.03, -x + 0.09),
                    (s - 0.008, s + 0.008),
                    (_TOP, _TOP + 0.0006),
                    "black",
                    0.0,
                    touch=False,
                )
                for s in slots
            ),
            *(
                Prism(
                    (
                        (-x, _TOP - 0.03),
                        (x, _TOP - 0.03),
                        (x, _ROOF + 0.07),
                        (-x + 0.06, _ROOF + 0.07),
                        (-x, _TOP + 0.05),
                    ),
                    (min(s * y, s * (y - 0.05)), max(s * y, s * (y - 0.05))),
                    "white",
                )
                for s in (-1, 1)
            ),
            Block((x - 0.05, x), (-y + 0.04, y - 0.04), (_TOP - 0.02, _ROOF + 0.02), "steel"),
            Block((-x + 0.14, x), (-y, y), (_ROOF, _HEIGHT), "white", edge=0.008),
            Block((-x + 0.04, -x + 0.100), (-y, y), (_ROOF + 0.06, _HEIGHT), "white", edge=0.008),
            Block((-x + 0.038, -x + 0.05), (-0.60, 0.60), (1.98, 2.09), "petrol", touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.lamp.add_to(spec, body, (0.075, 0.0, _ROOF - 0.002), (0.175, 0.50, 0.002))
        x, wide = -_DEPTH / 2, _WIDTH / 2 - 0.056
        sash = self.sash.add_to(spec, body, (x + 0.120, 0.0, _TOP + 0.004))
        high = 0.700
        pane: list[Form] = [
            Block((-0.004, 0.004), (-wide, wide), (0.030, high), "glass", 0.0),
            Block((-0.012, 0.012), (-wide, wide), (0.0, 0.034), "steel", edge=0.004),
            Block((-0.034, -0.010), (-0.25, 0.25), (0.008, 0.024), "anthracite", edge=0.006),
        ]
        assemble(spec, sash, self.name, pane, mass=9.0)
        front = x + 0.0398
        self.light.add_to(spec, self.name, body, (front, -0.46, 1.80), ON_FRONT)
        self.fan.add_to(spec, self.name, body, (front, -0.52, 1.80), ON_FRONT)
        self.displays[0].add_to(spec, body, (front - 0.0003, -0.32, 1.80), ON_FRONT)
