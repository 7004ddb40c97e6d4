"""A syringe: its plunger draws liquid in at the tip and pushes it out."""

import math
from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.glass.moving_fittings import Piston
from labutopia_lerobot.labware.glass.series import UtensilSeries, numbers_of
from labutopia_lerobot.labware.glass.utensil import Shape, Utensil
from labutopia_lerobot.labware.parts.drawing import Drawing
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Rod, towards
from labutopia_lerobot.labware.parts.pipe import Cone
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_WALL = 0.06
"""Of the barrel, in parts of its diameter; ours."""
_GAP = 0.0005
"""From the plunger, pushed in, to the floor of the barrel [m]; ours."""
_TIP = 0.0006
"""Radius of the bore of the tip [m]; ours."""


@dataclass(frozen=True)
class Syringe(Utensil):
    """A syringe without a needle; origin at the end of its tip, z up the plunger.

    Attributes:
        bore: Inside of the barrel [m].
        tip: Length of the tip [m].
    """

    bore: float = 0.0
    tip: float = 0.0

    @property
    def plunger(self) -> Slide:
        """The plunger; 0 is pushed in."""
        (slide,) = (part for part in self.mechanisms if isinstance(part, Slide))
        return slide

    @property
    def section(self) -> float:
        """Inside of the barrel [m^2]: what it takes in for a metre of the plunger."""
        return math.pi * self.bore**2 / 4

    @property
    def draws_at(self) -> str:
        """Name of the frame at the end of its tip; z the way that liquid leaves."""
        return f"{self.name}_tip"

    @property
    def drawn(self) -> str:
        """Name of the reading of what is in it [ml]."""
        return f"{self.name}_drawn"

    @property
    @override
    def processes(self) -> tuple[Process, ...]:
        room = self.section * _GAP + math.pi * _TIP**2 * self.tip
        joints = (self.plunger.joint,)
        at = self.draws_at
        area = self.section
        return (Drawing(self.drawn, self.name, joints, area, room, at, _TIP, area),)

    @override
    def _add_more(self, body: mujoco.MjsBody) -> None:
        body.add_site(name=self.draws_at, quat=towards((0.0, 0.0, -1.0)), group=COLLISION_GROUP)


@dataclass(frozen=True)
class SyringeSeries(UtensilSeries):
    """Syringes in all their sizes: diameter and length of the barrel, length of the tip."""

    @override
    def make(self, size: str, name: str) -> Syringe:
        """Return a syringe of a size; see `UtensilSeries.make`."""
        barrel, long, tip = (1e-3 * number for number in numbers_of(self, size))
        shape = self.shape(name, barrel, long, tip)
        return Syringe(name, shape, self.material, self.stands, bore=_bore(barrel), tip=tip)


def syringe(name: str, barrel: float, long: float, tip: float, *, look: str) -> Shape:
    """Return a syringe on its tip, its plunger pushed in; it comes out by 80 %."""
    wall, low = _WALL * barrel, tip
    top = low + long
    bore = _bore(barrel)
    plunger: tuple[Form, ...] = (
        Rod((0, 0, 0), (0, 0, 0.10 * long), 0.97 * bore, "rubber"),
        Rod((0, 0, 0.10 * long), (0, 0, 1.08 * long), 0.5 * bore, look),
        Rod((0, 0, 1.08 * long), (0, 0, 1.08 * long + 0.002), 1.1 * barrel, look),
    )
    slide = Slide(f"{name}_plunger", 0.8 * long, friction=1.0, effort=6.0)
    mass = 900.0 * 3.14 * (0.25 * bore) ** 2 * long
    forms: tuple[Form, ...] = (
        Cone(0.15 * barrel, 0.25 * barrel, (0.0, tip), look),
        Rod((0, 0, low), (0, 0, low + wall), barrel, look),
        Ring(bore, barrel, (low + wall, top), look),
        Block(
            (-0.9 * barrel, -0.5 * barrel),
            (-0.35 * barrel, 0.35 * barrel),
            (top - 0.002, top),
            look,
            0.0,
        ),
        Block(
            (0.5 * barrel, 0.9 * barrel),
            (-0.35 * barrel, 0.35 * barrel),
            (top - 0.002, top),
            look,
            0.0,
        ),
    )
    piston = Piston(slide, (0.0, 0.0, low + wall + _GAP), plunger, mass)
    return Shape(forms, low + 0.5 * long, barrel, (piston,))


def _bore(barrel: float) -> float:
    """Return the inside of a barrel by its outside [m]."""
    return (1 - 2 * _WALL) * barrel
