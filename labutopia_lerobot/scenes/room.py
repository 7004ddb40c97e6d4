"""Interface of a room for the rest of the package."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.views import Vector, View

if TYPE_CHECKING:
    import mujoco

    from labutopia_lerobot.labware.piece import Piece
    from labutopia_lerobot.navigation.occupancy import Occupancy
    from labutopia_lerobot.robots.mobile_base import MobileBase
    from labutopia_lerobot.scenes.ground import Ground


PEDESTAL = "pedestal"
"""Body that carries an arm on a stand."""


class UnknownRoomError(UserError, ValueError):
    """A room that does not exist; the message names some that do."""


class NowhereToDriveError(UserError, ValueError):
    """A room without the places that a task needs to which one drives; the message says what."""


@dataclass(frozen=True)
class Surface:
    """A level, rectangular top that things stand on.

    Attributes:
        height: Above the floor [m].
        x: Least and greatest x [m], world frame.
        y: Least and greatest y [m], world frame.
    """

    height: float
    x: tuple[float, float]
    y: tuple[float, float]


@dataclass(frozen=True)
class Room:
    """A room with a bench and a place for a robot: what to build, and where things are in it.

    The world frame has its origin on the floor, x from the robot to the bench, z up.

    Attributes:
        name: Short name.
        builder: Returns a room as a spec (see `build`).
        bench: Top of the bench.
        robot_stand: Where the base of a robot is mounted, facing +x [m], world frame.
        decorator: Adds to such a spec what is seen and never touched, or None.
        furniture: Returns the pieces that it builds, or None.
        solidifier: Adds to such a spec what only a robot that drives can touch, or None.
        mapper: Returns the map for such a robot, world frame.
        surveyor: Returns what of it a base gets to, or None where nobody can drive to anything.
        remover: Returns the same room without some of its pieces, to be built, or None where it has
            none: map and survey are those of the whole.
    """

    name: str
    builder: "Callable[[Room, View], mujoco.MjSpec]"
    bench: Surface
    robot_stand: Vector
    decorator: "Callable[[mujoco.MjSpec, View], None] | None" = None
    furniture: "Callable[[], tuple[Piece, ...]] | None" = None
    solidifier: "Callable[[mujoco.MjSpec], None] | None" = None
    mapper: "Callable[[], Occupancy] | None" = None
    surveyor: "Callable[[MobileBase], Ground] | None" = None
    remover: "Callable[[frozenset[str]], Room] | None" = None

    @property
    def pieces(self) -> "tuple[Piece, ...]":
        """Pieces that it builds beside bench and robot: those that can be reached."""
        return () if self.furniture is None else self.furniture()

    def build(self, view: View) -> "mujoco.MjSpec":
        """Return the room as a spec (angles in radians) with the cameras `front` and `top`.

        The bench is the body `world.BENCH`; floor and walls are the body `world.ROOM`.
        """
        return self.builder(self, view)

    def arm_place(self, base: "MobileBase | None") -> tuple[float, float]:
        """Return where an arm is that works at the bench: x and y [m], world frame.

        It is where the stand would have it, or as near as the base that carries it goes.
        """
        x, y, _ = self.robot_stand
        if base is None:
            return x, y
        return min(x, self.bench.x[0] - base.gap - base.size[0] / 2 + base.arm[0]), y

    def without(self, pieces: frozenset[str]) -> "Room":
        """Return the same room without some pieces, in whose place a task has its own.

        Args:
            pieces: Their names in the plan.
        """
        return self if self.remover is None or not pieces else self.remover(pieces)

    def make_solid(self, spec: "mujoco.MjSpec") -> None:
        """Add to the spec that was built what only a robot that drives can touch."""
        if self.solidifier is not None:
            self.solidifier(spec)

    def map(self) -> "Occupancy":
        """Return where a robot can drive, world frame.

        Raises:
            UnknownRoomError: If there is no map of the room.
        """
        if self.mapper is None:
            raise UnknownRoomError(f"There is no map of the room {self.name!r}. Choose another")
        return self.mapper()

    def ground(self, base: "MobileBase") -> "Ground":
        """Return what of the room a robot gets to, world frame.

        Raises:
            NowhereToDriveError: If there is nothing to drive to.
        """
        if self.surveyor is None:
            raise NowhereToDriveError(
                f"room={self.name!r} has one bench and nowhere to drive. Choose a furnished room, "
                "such as organic_7"
            )
        return self.surveyor(base)

    def decorate(self, spec: "mujoco.MjSpec", view: View) -> None:
        """Add to the spec that was built what is seen around the bench and never touched."""
        if self.decorator is not None:
            self.decorator(spec, view)
