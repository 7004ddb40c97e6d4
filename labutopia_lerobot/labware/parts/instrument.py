"""An instrument: it says what moves on it, what stands where, what it shows; the rest follows."""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.mounting import Still
from labutopia_lerobot.labware.parts.openable import Door, Drawer
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.processes import Process


class Equipment(Still):
    """Interface of every instrument.

    Each is a frozen dataclass with a `name`. Its origin is the centre of its base, z up, its front
    faces -x: left is +y.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        size: Depth, width and height as built [m].
        mass: What it weighs [kg].
        source: Where both are from.
        movable: Whether it stands free; else it is screwed to something, or too heavy.
        passive: Whether it does nothing by itself in reality either: racks, stands, furniture.
        left_out: What it does in reality and not here.
    """

    name: str
    size: ClassVar[Vector]
    mass: ClassVar[float]
    source: ClassVar[str]
    movable: ClassVar[bool] = False
    passive: ClassVar[bool] = False
    left_out: ClassVar[str] = ""

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """Its moving parts, buttons excepted, in an order in which all of them can be opened."""
        return ()

    @property
    def places(self) -> tuple[Seat, ...]:
        """Places where things stand on it or are put in."""
        return ()

    @property
    def tops(self) -> tuple[Top, ...]:
        """Surfaces of furniture that carry instruments, and ware between them."""
        return ()

    @property
    def boards(self) -> tuple[Top, ...]:
        """Boards of furniture on which ware stands in rows."""
        return ()

    @property
    def displays(self) -> tuple[Display, ...]:
        """Its displays."""
        return ()

    @property
    def works(self) -> tuple[Process, ...]:
        """What it does by itself, beside its buttons and displays: switches, drives, heat."""
        return ()

    @property
    def processes(self) -> tuple[Process, ...]:
        """Its buttons, what it works, what its displays read, and the displays, in this order."""
        read = (display.of for display in self.displays)
        return tuple(dict.fromkeys((*self.buttons, *self.works, *read, *self.displays)))

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its hinges and slides that are its state."""
        moving = [part.joint for part in self.mechanisms]
        return (*moving, *(button.joint for button in self.buttons))

    @property
    def bodies(self) -> frozenset[str]:
        """Names of its bodies."""
        parts = {part.name for part in self.mechanisms} | {b.name for b in self.buttons}
        handles = {m.handle.name for m in self.mechanisms if isinstance(m, Door | Drawer)}
        supports = {place.support for place in self.places}
        return frozenset({self.name} | parts | handles | supports)

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs [m]."""
        return math.hypot(self.size[0], self.size[1]) / 2


class Instrument(Equipment, ABC):
    """An instrument made of forms: it says what stands still, and adds what moves."""

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: frames of what moves and of its places.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        self._add_parts(spec, body)
        moving = sum(geom.mass for geom in body.find_all(mujoco.mjtObj.mjOBJ_GEOM))
        rest = self.mass - moving if self.movable else 0.0
        assemble(spec, body, self.name, self._forms(), rest)
        for place in self.places:
            if place.support == self.name:
                place.add_to(body)
        return body

    @abstractmethod
    def _forms(self) -> Sequence[Form]:
        """Return what of it stands still."""

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add what moves and what it shows."""
