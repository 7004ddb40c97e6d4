"""An analytical balance in a glass draught shield that opens to both sides and above."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.pan import Pan
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.weighing import Weighing

_FRONT, _TOWER, _FLOOR, _TOP = -0.078, 0.098, 0.078, 0.330
"""Positions of the weighing chamber's front pane, tower behind it, floor and roof [m]."""
_TRAVEL = 0.150
"""Travel of doors and roof [m]: the tower carries on their guides."""


@dataclass(frozen=True)
class AnalyticalBalance(Instrument):
    """An analytical balance: it shows the mass on its pan to 0.1 mg, up to 220 g.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.344, 0.221, 0.344)
    mass = 5.9
    source = "210 x 344 x 344 mm and pan of 90 mm, usual for 220 g x 0.1 mg; from memory"

    @property
    def pan(self) -> Pan:
        return Pan(f"{self.name}_pan", width=0.085, top=0.010)

    @property
    def doors(self) -> tuple[Slide, Slide, Slide]:
        """The door on the left of who stands before it, that on the right, and the roof."""
        left, right, roof = (f"{self.name}_{part}" for part in ("left_door", "right_door", "roof"))
        return Slide(left, _TRAVEL), Slide(right, _TRAVEL), Slide(roof, _TRAVEL)

    @property
    def mechanisms(self) -> tuple[Slide, ...]:
        return self.doors

    @property
    def tare(self) -> PushButton:
        """Button that sets the display to zero."""
        button, green = f"{self.name}_tare", (0.10, 0.50, 0.45, 1.0)
        return PushButton(button, green, radius=0.009, travel=0.003, proud=0.006)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.tare,)

    @property
    def weighing(self) -> Weighing:
        """The mass on its pan."""
        name, tare = f"{self.name}_reading", self.tare.name
        return self.pan.weighing(name, 1e-4, 220.0, tare, tuple(door.joint for door in self.doors))

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.pan.place,)

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.096, 0.028), self.weighing),)

    def _forms(self) -> list[Form]:
        console = (
            (-0.172, 0.014),
            (0.172, 0.014),
            (0.172, 0.076),
            (-0.082, 0.076),
            (-0.172, 0.040),
        )
        forms: list[Form] = [
            Prism(console, (-0.105, 0.105), "light_grey", edge=0.008),
            Block((-0.170, 0.170), (-0.102, 0.102), (0.010, 0.018), "anthracite"),
            Block((_FRONT, _TOWER), (-0.100, 0.100), (0.070, _FLOOR), "ceramic", edge=0.001),
            Block(
                (_TOWER, 0.172), (-0.094, 0.094), (0.070, _TOP - 0.002), "light_grey", edge=0.006
            ),
            Block((_FRONT, _FRONT + 0.004), (-0.096, 0.096), (_FLOOR, _TOP), "glass", edge=0.0),
            Block((_FRONT, _FRONT + 0.006), (-0.102, 0.102), (_TOP, 0.336), "anthracite"),
            Turned(((0, 0), (0.055, 0), (0.058, 0.004), (0, 0.004)), "steel", (0.012, 0, _FLOOR)),
        ]
        for side in (-1, 1):
            post = (side * 0.099 - 0.003, side * 0.099 + 0.003)
            forms.append(Block((_FRONT, _FRONT + 0.006), post, (_FLOOR, _TOP), "anthracite"))
        return forms + feet(0.344, 0.210, 0.012)

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self._add_doors(spec, body)
        pan: list[Form] = [
            Turned(((0, 0.006), (0.043, 0.006), (0.045, 0.010), (0, 0.010)), "chrome"),
            Rod((0, 0, -0.004), (0, 0, 0.007), 0.014, "steel"),
        ]
        self.pan.add_to(spec, self.name, body, (0.012, 0.0, _FLOOR + 0.010), pan)
        self.displays[0].add_to(spec, body, (-0.118, 0.0, 0.0625), leaning(68.2))
        self.tare.add_to(spec, body, (-0.150, 0.060, 0.0488), leaning(68.2))

    def _add_doors(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add three panes in front of the tower's sides and roof, each with a grip."""
        left, right, roof = self.doors
        deep = (_FRONT + 0.007, _TOWER + 0.004)
        for door, side in ((left, 1), (right, -1)):
            pane = door.add_to(spec, body, (0.0, side * 0.0985, 0.0), (1.0, 0.0, 0.0))
            thick, grip = (-0.0015, 0.0015), (0.0015, 0.012) if side > 0 else (-0.012, -0.0015)
            forms: list[Form] = [
                Block(deep, thick, (_FLOOR + 0.001, _TOP - 0.001), "glass", edge=0.0),
                Block(deep, (-0.002, 0.002), (_FLOOR, _FLOOR + 0.004), "glass_edge", edge=0.001),
                Block((-0.062, -0.050), grip, (0.170, 0.230), "anthracite"),
            ]
            assemble(spec, pane, self.name, forms, mass=0.35)
        pane = roof.add_to(spec, body, (0.0, 0.0, _TOP), (1.0, 0.0, 0.0))
        forms = [
            Block(deep, (-0.094, 0.094), (0.001, 0.005), "glass", edge=0.0),
            Block((-0.066, -0.054), (-0.030, 0.030), (0.005, 0.014), "anthracite"),
        ]
        assemble(spec, pane, self.name, forms, mass=0.35)
