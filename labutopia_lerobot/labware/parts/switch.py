"""What push-buttons switch: a lamp with one, a run with two."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import ON, Reading
from labutopia_lerobot.world.model import VISUAL_GROUP

_RADIUS = 0.010
"""Radius of the lamp [m]."""
_DARK = (0.25, 0.08, 0.05, 1.0)
"""The lamp when it is off."""


@dataclass(frozen=True)
class Switch(Process):
    """A push-button that toggles a lamp each time it clicks in.

    Attributes:
        name: What the world calls it.
        button: Name of the button.
        lamp: Geom that is lit while it is on.
        lit: Colour of the lit lamp.
    """

    name: str
    button: str
    lamp: str
    lit: tuple[float, float, float, float] = (1.0, 0.35, 0.1, 1.0)

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("on", "button in")

    @property
    @override
    def lit_by(self) -> tuple[str, ...]:
        return (self.button,)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        pressed = apparatus.reading(self.button).value
        if pressed > memory[1]:
            memory[0] = not memory[0]
        memory[1] = pressed

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        """Return 1 while it is on, else 0."""
        return Reading(float(apparatus.memory(self)[0]), ON)

    @override
    def show(self, apparatus: Apparatus) -> None:
        lit = apparatus.memory(self)[0] > 0.0
        apparatus.model.geom(self.lamp).rgba = self.lit if lit else _DARK

    def add_lamp_to(self, panel: mujoco.MjsBody, pos: Vector) -> None:
        """Build its lamp, half sunk, onto a panel.

        Args:
            panel: What carries it.
            pos: Where on the surface of the panel it is [m].
        """
        panel.add_geom(
            name=self.lamp,
            type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
            size=(_RADIUS, _RADIUS, _RADIUS),
            pos=pos,
            rgba=_DARK,
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )


@dataclass(frozen=True)
class Latched(Process):
    """What one button starts and another stops.

    Attributes:
        name: What its reading is called: 1 while it runs, else 0.
        start_button: Name of the button that starts it.
        stop_button: Name of the button that stops it.
    """

    name: str
    start_button: str
    stop_button: str

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("runs",)

    @override
    def step(self, apparatus: Apparatus) -> None:
        memory = apparatus.memory(self)
        started, stopped = (
            apparatus.reading(name).value for name in (self.start_button, self.stop_button)
        )
        memory[0] = (memory[0] or started) and not stopped

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        return Reading(float(apparatus.memory(self)[0]), ON)
