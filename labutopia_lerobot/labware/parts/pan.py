"""The pan of a balance, on a load cell."""

from collections.abc import Iterable
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.labware.parts.weighing import Weighing
from labutopia_lerobot.world.model import COLLISION_GROUP

_MASS = 0.1
"""Mass of a pan with its support [kg]; tared."""
_X_UP = (0.5**0.5, 0.0, -(0.5**0.5), 0.0)  # the sensor's first number is the vertical force


@dataclass(frozen=True)
class Pan:
    """A plate whose load cell feels what stands on it; rigid, as load cells are to the eye.

    Attributes:
        name: Name of its body.
        width: Diameter of what fits on it [m].
        top: Height of its top above its origin [m].
    """

    name: str
    width: float
    top: float

    @property
    def force_sensor(self) -> str:
        """Name of the sensor whose first number is the force on its load cell [N]."""
        return f"{self.name}_force"

    @property
    def place(self) -> Seat:
        """Place where things stand on it."""
        return Seat(f"{self.name}_middle", self.name, (0.0, 0.0, self.top), self.width)

    def weighing(
        self,
        name: str,
        resolution: float,
        capacity: float,
        tare: str,
        doors: tuple[str, ...] = (),
        tared: tuple[float, float] = (0.0, 0.0),
    ) -> Weighing:
        """Return what weighs what is on it; see `Weighing` for the arguments."""
        cell, pan = self.force_sensor, self.name
        return Weighing(name, cell, pan, resolution, capacity, tare, doors, tared)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        piece: str,
        box: mujoco.MjsBody,
        pos: Vector,
        forms: Iterable[Form],
    ) -> None:
        """Build its body onto a balance.

        Args:
            spec: What the balance is in.
            piece: Name of the piece.
            box: The balance.
            pos: Its origin [m].
            forms: What it is made of.
        """
        body = box.add_body(name=self.name, pos=pos)
        assemble(spec, body, piece, forms, _MASS)
        body.add_site(name=self.force_sensor, quat=_X_UP, group=COLLISION_GROUP)
        self.place.add_to(body)
        spec.add_sensor(
            name=self.force_sensor,
            type=mujoco.mjtSensor.mjSENS_FORCE,
            objtype=mujoco.mjtObj.mjOBJ_SITE,
            objname=self.force_sensor,
        )
