"""What predicates and skills may see of the simulation: a read-only view."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

CONTROL_HZ = 30
"""Control, camera and recording rate: LeRobot's usual frame rate (the original runs at 60)."""

LEFT_PAD = "left_pad"
RIGHT_PAD = "right_pad"
HAND = "hand"
ARM = "arm"
BENCH = "bench"
ROOM = "room"


class Thing(Protocol):
    """A piece of labware or an instrument, known to the world by its name."""

    @property
    def name(self) -> str:
        """Name of the root body; every element of the thing starts with it."""
        ...


@dataclass(frozen=True)
class Pose:
    """Position and orientation of a frame in the world.

    Attributes:
        position_w: Origin of the frame, shape (3,), metres, world frame.
        rotation_w: Axes of the frame as columns, shape (3, 3), world frame.
    """

    position_w: FloatArray
    rotation_w: FloatArray

    @property
    def quat_wxyz(self) -> FloatArray:
        """Orientation as a scalar-first unit quaternion, shape (4,)."""
        from scipy.spatial.transform import Rotation  # here: names of robots must come at once

        quat_wxyz: FloatArray = Rotation.from_matrix(self.rotation_w).as_quat(scalar_first=True)
        return quat_wxyz

    @property
    def x_axis(self) -> FloatArray:
        """First axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 0]

    @property
    def y_axis(self) -> FloatArray:
        """Second axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 1]

    @property
    def z_axis(self) -> FloatArray:
        """Third axis of the frame, shape (3,), world frame."""
        return self.rotation_w[:, 2]

    @property
    def tilt(self) -> float:
        """Angle between the frame's z axis and the vertical [rad]."""
        return float(np.arccos(np.clip(self.rotation_w[2, 2], -1.0, 1.0)))

    def __matmul__(self, other: "Pose") -> "Pose":
        """Express a pose given in this frame in the world."""
        return Pose(
            self.position_w + self.rotation_w @ other.position_w,
            self.rotation_w @ other.rotation_w,
        )

    def inverse(self) -> "Pose":
        """Return the pose of the world in this frame."""
        return Pose(-self.rotation_w.T @ self.position_w, self.rotation_w.T)

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Pose":
        """Return the same orientation, displaced along the world's axes [m]."""
        return Pose(self.position_w + np.array([x, y, z]), self.rotation_w)

    def advanced(self, distance: float) -> "Pose":
        """Return the same orientation, displaced along the frame's own z axis [m]."""
        return Pose(self.position_w + distance * self.z_axis, self.rotation_w)

    def distance_to(self, other: "Pose") -> float:
        """Return the distance between the two origins [m]."""
        return float(np.linalg.norm(other.position_w - self.position_w))

    def angle_to(self, other: "Pose") -> float:
        """Return the angle of the rotation between the two frames [rad]."""
        cosine = 0.5 * (np.trace(self.rotation_w.T @ other.rotation_w) - 1.0)
        return float(np.arccos(np.clip(cosine, -1.0, 1.0)))


@dataclass(frozen=True, eq=False)
class LiquidAccount:
    """Where the liquid of a scene is, by where it was filled, as of one control step.

    Every particle is counted once, and every volume is a number of particles times the volume of
    one: inside vessels, spilled, clinging and in flight are all of it, exactly.

    Attributes:
        vessels: Names of all vessels and bottles. Any of them may be an origin: what held a
            particle when the scene was filled.
        counts: Particles by origin, after the vessels none, and by place: inside each vessel, then
            spilled, clinging, in flight; shape (vessels + 1, vessels + 3).
        moves: Particles that since the previous control step have arrived in a vessel (column)
            after another one had been the last to hold them (row), shape (vessels, vessels).
        particle_volume: Of each [m^3].
    """

    vessels: tuple[str, ...]
    counts: NDArray[np.int64]
    moves: NDArray[np.int64]
    particle_volume: float

    @property
    def total(self) -> float:
        """All of it [m^3]."""
        return self._volume(self.counts)

    @property
    def inside(self) -> Mapping[str, float]:
        """In each vessel, by its name, wherever it came from [m^3]."""
        return {name: self._volume(self.counts[:, v]) for v, name in enumerate(self.vessels)}

    @property
    def retained(self) -> float:
        """In the vessels that it was filled into [m^3]."""
        return self._volume(np.diagonal(self.counts[:-1]))

    @property
    def poured(self) -> float:
        """In other vessels than it was filled into [m^3]."""
        elsewhere = self.counts[:, :-3].copy()
        np.fill_diagonal(elsewhere, 0)
        return self._volume(elsewhere)

    @property
    def spilled(self) -> float:
        """In no vessel, and on something that can never move, as bench and floor [m^3]."""
        return self._volume(self.counts[:, -3])

    @property
    def clinging(self) -> float:
        """In no vessel, and on the outside of one or on something that can move [m^3]."""
        return self._volume(self.counts[:, -2])

    @property
    def in_flight(self) -> float:
        """In no vessel, and touching nothing [m^3]."""
        return self._volume(self.counts[:, -1])

    @property
    def transfers(self) -> Mapping[tuple[str, str], float]:
        """What has moved since the previous control step, by (from, to) [m^3]; no zeros."""
        return {
            (self.vessels[a], self.vessels[b]): int(self.moves[a, b]) * self.particle_volume
            for a, b in np.argwhere(self.moves).tolist()
        }

    @property
    def millilitres(self) -> dict[str, float]:
        """The total and its five parts as `info` has them [ml]."""
        names = ("total", "poured", "retained", "spilled", "clinging", "in_flight")
        return {f"ml_{name}": round(1e6 * float(getattr(self, name)), 6) for name in names}

    def originated_in(self, vessel: str) -> float:
        """Return all that was filled into a vessel, wherever it is [m^3]."""
        return self._volume(self.counts[self._index(vessel)])

    def from_in(self, origin: str, vessel: str) -> float:
        """Return what was filled into one vessel and is inside another, or the same one [m^3]."""
        return self._volume(self.counts[self._index(origin), self._index(vessel)])

    def spilled_from(self, origin: str) -> float:
        """Return what was filled into a vessel and is spilled [m^3]."""
        return self._volume(self.counts[self._index(origin), -3])

    def _index(self, vessel: str) -> int:
        if vessel not in self.vessels:
            raise KeyError(f"{vessel} holds no liquid; {', '.join(self.vessels)} can")
        return self.vessels.index(vessel)

    def _volume(self, counts: NDArray[np.int64]) -> float:
        return int(counts.sum()) * self.particle_volume


@dataclass(frozen=True)
class Approach:
    """A direction of the hand that its arm reaches comfortably.

    Attributes:
        yaw: About the vertical, to the left of some level direction [rad].
        pitch: Below the horizontal [rad].
    """

    yaw: float
    pitch: float


class Manipulator(Protocol):
    """What skills may know of the robot: its hand, and how its arm likes to turn it."""

    @property
    def max_opening(self) -> float:
        """Greatest distance between the pads [m]."""
        ...

    @property
    def closing_speed(self) -> float:
        """Rate of that distance to command [m/s]."""
        ...

    @property
    def finger_reach(self) -> float:
        """How far the fingers reach beyond the point between the pads [m]."""
        ...

    @property
    def vessel_approach(self) -> Approach:
        """How the hand comes to vessels, relative to the bearing from the robot's base."""
        ...

    @property
    def handle_approach(self) -> Approach:
        """How the hand comes to handles, relative to straight into the door or drawer."""
        ...


class World(Protocol):
    """Getters only: nothing that holds a `World` can change the simulation.

    Everything handed out is a copy. Contacts are those of any physics step since the previous
    control step, so that a touch shorter than a control period is seen too. Contact names are
    the names of bodies (a thing's own, or a moving part's), and `left_pad`, `right_pad`, `hand`,
    `arm`, `bench`, `room`.
    """

    @property
    def time(self) -> float:
        """Time since the episode began [s]."""
        ...

    @property
    def bench_height(self) -> float:
        """Height of the bench top above the floor [m]."""
        ...

    @property
    def robot(self) -> Manipulator:
        """What is known of the robot beforehand."""
        ...

    @property
    def robot_base(self) -> Pose:
        """Base of the robot, x forward, z up."""
        ...

    @property
    def gripper(self) -> Pose:
        """Frame between the pads: z forward, y along the motion of the fingers."""
        ...

    @property
    def gripper_opening(self) -> float:
        """Distance between the pads [m]."""
        ...

    @property
    def commanded_opening(self) -> float:
        """Distance between the pads that is commanded [m]; less than measured in a grasp."""
        ...

    def pose(self, thing: Thing) -> Pose:
        """Return the frame of a thing: origin at the centre of its base, z up when it stands."""
        ...

    def frame(self, name: str) -> Pose:
        """Return a named frame (a MuJoCo site), such as `flask_rim`."""
        ...

    def velocity(self, thing: Thing) -> FloatArray:
        """Return the velocity of a thing's centre of mass, shape (3,), m/s, world frame."""
        ...

    def joint(self, name: str) -> float:
        """Return the position of a named hinge [rad] or slide [m]."""
        ...

    def sensor(self, name: str) -> float:
        """Return the reading of a named scalar sensor, such as the force on a button [N]."""
        ...

    def switched_on(self, name: str) -> bool:
        """Tell whether a named switch is on."""
        ...

    def displaced(self, thing: Thing) -> float:
        """Return the volume of liquid squeezed out of a bottle since the episode began [m^3]."""
        ...

    @property
    def liquid(self) -> LiquidAccount | None:
        """Where the liquid is; None where none is simulated."""
        ...

    def touching(self, first: str, second: str) -> bool:
        """Tell whether the two touched at any physics step since the last control step."""
        ...

    def touched_by(self, name: str) -> frozenset[str]:
        """Return everything that touched it at any physics step since the last control step."""
        ...
