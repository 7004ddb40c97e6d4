"""Positions of things at the start of an episode."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.scenes.ground import Ground
from labutopia_lerobot.scenes.placement import Placement
from labutopia_lerobot.scenes.room import NowhereToDriveError, Room
from labutopia_lerobot.scenes.rooms_to_drive_in import (
    BENCHES,
    rooms_to_drive_in,
    rooms_with_deep_benches,
    rooms_with_sinks,
)
from labutopia_lerobot.scenes.starts_in_rooms import (
    APART,
    AWAY,
    OfTheRoom,
    OnDeepBench,
    OnSomeBench,
    OnTheSameBench,
)
from labutopia_lerobot.world import FloatArray

__all__ = [
    "CLEARANCE",
    "ImpossibleStartError",
    "Inside",
    "OfTheRoom",
    "OnBench",
    "OnDeepBench",
    "OnSomeBench",
    "OnTheSameBench",
    "Placement",
    "Start",
    "Workspace",
    "require_drivable",
    "require_in_every_room",
    "require_possible",
    "rooms_for",
    "sample_base",
    "sample_layout",
    "taken_over",
]

CLEARANCE = 0.01
"""Least gap between two things at the start [m]."""

_TRIES = 1000


class ImpossibleStartError(UserError, ValueError):
    """A start that cannot be; the message names the things and their regions."""


@dataclass(frozen=True)
class OnBench:
    """Uniform over a rectangle of the bench top.

    Attributes:
        x: Least and greatest x of the thing's origin [m], world frame.
        y: Least and greatest y of the thing's origin [m], world frame.
        yaw: Least and greatest yaw [rad].
        height: Least and greatest height of the origin above the bench top [m]; for a thing on a
            post.
        shuffled: Bodies of the thing that are dealt out to each other's places, every order being
            equally likely; each has a frame of its name.

    Raises:
        ImpossibleStartError: If a range is none, or its greatest value comes first.
    """

    x: tuple[float, float]
    y: tuple[float, float]
    yaw: tuple[float, float] = (-math.pi, math.pi)
    height: tuple[float, float] = (0.0, 0.0)
    shuffled: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("x", "y", "yaw", "height"):
            bounds = getattr(self, name)
            if not isinstance(bounds, tuple) or len(bounds) != 2 or not bounds[0] <= bounds[1]:
                raise ImpossibleStartError(
                    f"OnBench: {name}={bounds} is no range: write {name}=(least, greatest)"
                )

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Draw one placement, wherever other things are."""
        x, y, yaw = (rng.uniform(*bounds) for bounds in (self.x, self.y, self.yaw))
        height = rng.uniform(*self.height)
        places = [self.shuffled[index] for index in rng.permutation(len(self.shuffled))]
        return Placement(x, y, yaw, height, tuple(zip(self.shuffled, places, strict=True)))


@dataclass(frozen=True)
class Inside:
    """Start in a place of another thing, such as a rack, wherever that thing stands.

    Attributes:
        holder: The other thing; it comes earlier in the task's start.
        at: Origin of the held thing in the holder's frame [m].
        yaw: How it is turned in the holder's frame [rad]; any way round if not said.
    """

    holder: Piece
    at: tuple[float, float, float]
    yaw: float | None = None

    @property
    def shuffled(self) -> tuple[str, ...]:
        return ()

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Draw one placement in the holder's place, by default of a random yaw.

        Raises:
            ImpossibleStartError: If the holder has not been placed before.
        """
        if self.holder not in placed:
            raise ImpossibleStartError(
                f"'{self.holder.name}' holds something: put it into the start, before that"
            )
        holder = placed[self.holder]
        x, y, z = self.at
        cosine, sine = math.cos(holder.yaw), math.sin(holder.yaw)
        return Placement(
            holder.x + cosine * x - sine * y,
            holder.y + sine * x + cosine * y,
            rng.uniform(-math.pi, math.pi) if self.yaw is None else holder.yaw + self.yaw,
            holder.height + z,
            bench=holder.bench,
        )


type StartInRoom = OnSomeBench | OnTheSameBench | OnDeepBench | OfTheRoom
"""Distribution of the place of a thing where one drives."""

type Start = OnBench | Inside | StartInRoom
"""Distribution of the place of a thing at the start."""


@dataclass(frozen=True)
class Workspace:
    """Region where things can be.

    Attributes:
        x: Least and greatest x of the bench top [m], world frame.
        y: Least and greatest y of the bench top [m], world frame.
        robot: Where the base of its arm is, x and y [m], world frame.
        reach: How far its hand gets, horizontally [m].
    """

    x: tuple[float, float]
    y: tuple[float, float]
    robot: tuple[float, float]
    reach: float

    @classmethod
    def of(cls, room: Room, robot: Robot) -> "Workspace":
        """Return the bench of a room and what a robot on its stand reaches."""
        return cls(room.bench.x, room.bench.y, room.arm_place(robot.base), robot.reach)


def require_possible(
    start: Mapping[Piece, Start], workspace: Workspace, ground: Ground | None = None
) -> None:
    """Make sure, before anything is compiled, that things can stand where a task wants them.

    Everything must be on the bench, what the robot is to move must be within its reach, and some
    layout without overlaps must exist.

    Raises:
        ImpossibleStartError: If that is not so.
    """
    sample_layout(start, np.random.default_rng(0), ground)
    for piece in start:
        region = _region_on_bench(piece, start)
        if not isinstance(region, OnBench):
            continue  # its places are known to be good
        corners = [(x, y) for x in region.x for y in region.y]
        for x, y in corners:
            on_bench = (
                workspace.x[0] <= x <= workspace.x[1] and workspace.y[0] <= y <= workspace.y[1]
            )
            if not on_bench:
                raise ImpossibleStartError(
                    f"{piece.name} would stand off the bench at x={x:g}, y={y:g}: {region}. The "
                    f"bench reaches over x={workspace.x}, y={workspace.y}"
                )
            distance = math.dist((x, y), workspace.robot)
            if piece.movable and distance > workspace.reach:
                raise ImpossibleStartError(
                    f"{piece.name} would be out of reach at x={x:g}, y={y:g}: {region}. That is "
                    f"{distance:.2f} m from the robot, whose hand gets {workspace.reach:g} m far"
                )


def require_drivable(start: Mapping[Piece, Start], ground: Ground, room: str) -> None:
    """Make sure, before anything is compiled, that a room has what a robot is to drive to.

    Args:
        start: Where the task wants things.
        ground: What of the room the robot gets to.
        room: Its name.

    Raises:
        NowhereToDriveError: If it has not; the message says how much it has.
    """
    benches = [each for each in start.values() if isinstance(each, OnSomeBench)]
    deep = sum(isinstance(region, OnDeepBench) for region in start.values())
    instruments = sum(region.instrument for region in benches)
    things = max((region.things for region in benches), default=1)
    from_above = any(region.from_above for region in benches)
    roomy = ground.benches_for(things, APART, from_above=from_above)
    fixtures = {region.kind for region in start.values() if isinstance(region, OfTheRoom)}
    train, test = rooms_for(start)
    cure = (
        f"Rooms that will do: {', '.join((*train, *test))}. Or leave room= out: one is drawn for "
        "each episode"
    )
    for kind in sorted(fixtures - ground.fixtures.keys()):
        raise NowhereToDriveError(f"room={room!r} has no {kind} that a robot drives up to. {cure}")
    for found, needed, free in (
        (ground.benches, len(benches) + deep, "a free place"),
        (roomy, int(things > 1), f"free places for {things} things"),
        (ground.deep_benches, deep, "into an oven that stands there with its door open"),
        (ground.wide_benches, instruments, "a place free for an instrument"),
    ):
        if len(found) >= needed:
            continue
        raise NowhereToDriveError(
            f"room={room!r} has {len(found)} of the {needed} benches that the task needs: "
            f"a robot drives there as a disc of 0.6 m, docks, and its arm reaches {free}. {cure}"
        )


def require_in_every_room(start: Mapping[Piece, Start]) -> None:
    """Make sure that the rooms have the benches for it from which one is drawn for each episode.

    Args:
        start: Where a task wants things in which one drives.

    Raises:
        NowhereToDriveError: If they have not.
    """
    needed = sum(isinstance(region, OnSomeBench | OnDeepBench) for region in start.values())
    if needed > BENCHES:
        raise NowhereToDriveError(
            f"The task starts on {needed} benches that a robot drives to, and some rooms of those "
            f"that are drawn have {BENCHES}. Put several things on one (`OnTheSameBench`), or "
            "choose a room= that has more"
        )


def rooms_for(start: Mapping[Piece, Start]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the rooms in which things can start so, for training and for tests.

    Args:
        start: Where a task wants things in which one drives.
    """
    if any(isinstance(region, OfTheRoom) for region in start.values()):
        return rooms_with_sinks()
    deep = any(isinstance(region, OnDeepBench) for region in start.values())
    return rooms_with_deep_benches() if deep else rooms_to_drive_in()


def taken_over(start: Mapping[Piece, Start], ground: Ground) -> frozenset[str]:
    """Return the names of the pieces of a room in whose places a task has its own."""
    kinds = (region.kind for region in start.values() if isinstance(region, OfTheRoom))
    return frozenset(ground.fixtures[kind].name for kind in kinds if kind in ground.fixtures)


def sample_layout(
    start: Mapping[Piece, Start], rng: np.random.Generator, ground: Ground | None = None
) -> dict[Piece, Placement]:
    """Draw a placement for every thing so that no two on the bench are nearer than `CLEARANCE`.

    Args:
        start: Where things can be.
        rng: Of the episode.
        ground: What of the room a robot gets to, if it drives.

    Raises:
        ImpossibleStartError: If no such layout is found, naming the things and their regions.
        NowhereToDriveError: If the room has not the benches for it.
    """
    on_bench = [piece for piece, region in start.items() if not isinstance(region, Inside)]
    for _ in range(_TRIES):
        layout: dict[Piece, Placement] = {}
        for piece in sorted(start, key=lambda piece: _rank(start[piece])):
            layout[piece] = start[piece].sample(rng, layout, ground)
        if not _overlapping(on_bench, layout):
            return {piece: layout[piece] for piece in start}
    regions = "; ".join(f"{piece.name}: {region}" for piece, region in start.items())
    raise ImpossibleStartError(
        f"No layout without overlaps in {_TRIES} tries. Widen or part the regions of: {regions}"
    )


def _rank(region: Start) -> int:
    """Return when a thing gets its place: first those for which there may be few benches."""
    if isinstance(region, OnDeepBench | OfTheRoom):
        return 0
    return 1 if isinstance(region, OnSomeBench) and region.instrument else 2


def sample_base(
    ground: Ground, layout: Mapping[Piece, Placement], rng: np.random.Generator
) -> FloatArray:
    """Draw where a robot that drives starts: x, y [m] and heading [rad], shape (3,).

    Anywhere from where it gets to everything, but away from where it has to go.

    Raises:
        NowhereToDriveError: If the room is too small for that.
    """
    things = np.array([(placement.x, placement.y) for placement in layout.values()])
    away = np.hypot(*(ground.starts[:, None] - things).transpose(2, 0, 1)).min(axis=1)
    far = ground.starts[away > AWAY]
    if not len(far):
        raise NowhereToDriveError(
            f"Nowhere in the room the robot is {AWAY:g} m away from all things. Choose another"
        )
    return np.append(far[int(rng.integers(len(far)))], rng.uniform(-math.pi, math.pi))


def _region_on_bench(piece: Piece, start: Mapping[Piece, Start]) -> OnBench | StartInRoom:
    """Return where a thing, or what holds it, stands."""
    region = start[piece]
    return _region_on_bench(region.holder, start) if isinstance(region, Inside) else region


def _overlapping(pieces: Sequence[Piece], layout: Mapping[Piece, Placement]) -> bool:
    placed = [(piece, layout[piece]) for piece in pieces]
    return any(
        math.hypot(a.x - b.x, a.y - b.y)
        < first.footprint_radius + second.footprint_radius + CLEARANCE
        for i, (first, a) in enumerate(placed)
        for second, b in placed[i + 1 :]
    )
