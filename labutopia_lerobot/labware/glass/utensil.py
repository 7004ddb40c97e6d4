"""Ware that is no vessel of revolution: solid, flat or moulded pieces, made of forms."""

from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.glass.material import Material
from labutopia_lerobot.labware.glass.moving_fittings import Fitting
from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.moments import moments
from labutopia_lerobot.labware.parts.mounting import Loose
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP, SOLREF


@dataclass(frozen=True)
class Shape:
    """Material and grip of a utensil.

    Attributes:
        forms: In the frame of the piece: origin at the centre of its base, z up.
        grip_height: Height at which a gripper closes [m].
        grip_width: Its width there [m].
        fittings: What moves on it.
    """

    forms: tuple[Form, ...]
    grip_height: float
    grip_width: float
    fittings: tuple[Fitting, ...] = ()


@dataclass(frozen=True)
class Utensil(Loose):
    """A piece of ware made of forms: origin at the centre of its base, z up.

    Attributes:
        name: Name of the body; prefix of the names of all its elements.
        shape: What it is made of, and where it is taken.
        material: What all of it is made of.
        stands: Whether it stays as it is put, by itself.
        friction: Of its surface.
    """

    name: str
    shape: Shape
    material: Material
    stands: bool = True
    friction: float = FRICTION[0]

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the base [m]."""
        return self.shape.grip_height

    @property
    def grip_width(self) -> float:
        """Width at the grasp [m]."""
        return self.shape.grip_width

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """Its moving fittings."""
        return tuple(fitting.mechanism for fitting in self.shape.fittings)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the hinges and slides of what moves on it."""
        return tuple(part.joint for part in self.mechanisms)

    @cached_property
    def _corners(self) -> NDArray[np.float64]:
        return np.vstack([form.shell()[0] for form in self.shape.forms])

    @property
    def height(self) -> float:
        """Height of its top above the base [m]."""
        return float(self._corners[:, 2].max())

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return float(np.hypot(*self._corners[:, :2].T).max())

    @property
    def mass(self) -> float:
        """Mass [kg], without what moves on it."""
        return moments(self.shape.forms, self.material.density).mass

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body, and those that move on it, into a spec (angles in radians).

        Its site `<name>_grasp` is on the axis at the grip height.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        assemble(spec, body, self.name, self.shape.forms)
        moments(self.shape.forms, self.material.density).give_to(body)
        body.add_site(
            name=f"{self.name}_grasp", pos=(0, 0, self.grip_height), group=COLLISION_GROUP
        )
        self._add_more(body)
        for geom in body.geoms:
            if geom.group == COLLISION_GROUP:
                geom.friction = (self.friction, *FRICTION[1:])
                geom.solref, geom.solimp, geom.priority = SOLREF, *self._hardness
        for fitting in self.shape.fittings:
            fitting.add_to(spec, self.name, body)
        return body

    @property
    def _hardness(self) -> tuple[tuple[float, ...], int]:
        """Impedance of its contacts, and whose counts when two meet."""
        return SOLIMP, 0

    def _add_more(self, body: mujoco.MjsBody) -> None:
        """Add what only some have."""
