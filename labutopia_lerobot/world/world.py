"""The read-only view of the simulation."""

from collections.abc import Mapping
from typing import Protocol

from labutopia_lerobot.world.floor import Floor
from labutopia_lerobot.world.liquid_account import LiquidAccount
from labutopia_lerobot.world.manipulator import Manipulator
from labutopia_lerobot.world.pose import FloatArray, Pose
from labutopia_lerobot.world.reading import Reading
from labutopia_lerobot.world.solution import Solution
from labutopia_lerobot.world.things import Obstacle, Thing

CONTROL_HZ = 30
"""Control, camera and recording rate: LeRobot's usual frame rate (the original runs at 60)."""

LEFT_PAD = "left_pad"
RIGHT_PAD = "right_pad"
HAND = "hand"
ARM = "arm"
BASE = "base"
BENCH = "bench"
ROOM = "room"


class World(Protocol):
    """Getters only: nothing that holds a `World` can change the simulation.

    Everything handed out is a copy. Contacts, their forces and speeds, speeds of joints and falls
    are the extremes of all physics steps since the previous control step, so that a touch or a
    knock shorter than a control period is seen too. Contact names are the names of bodies (a
    thing's own, or a moving part's), and `left_pad`, `right_pad`, `hand`, `arm`, `base` (a mobile
    one), `bench`, `room`.
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
        """The facts about the robot that are known beforehand."""
        ...

    @property
    def robot_base(self) -> Pose:
        """Base of the arm, x forward, z up; on a mobile base it moves."""
        ...

    @property
    def mobile_base(self) -> Pose | None:
        """Middle of the mobile base on the floor, x forward, z up; None for an arm on a stand."""
        ...

    @property
    def base_velocity(self) -> FloatArray:
        """Velocity of the mobile base, in its own frame; shape (3,), of an arm on a stand (0,).

        Forward and to the left [m/s], and turning to the left [rad/s].
        """
        ...

    @property
    def stowed_hand(self) -> Pose:
        """Pose of the hand while the robot drives, in the frame of the arm's base."""
        ...

    @property
    def floor(self) -> Floor:
        """Map of the room and places at its benches, for a robot that drives."""
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

    @property
    def movable(self) -> tuple[Thing, ...]:
        """Everything that stands free, distractors included."""
        ...

    @property
    def in_the_way(self) -> tuple[Obstacle, ...]:
        """What stands or walks on the floor and is on no map."""
        ...

    def pose(self, thing: Thing) -> Pose:
        """Return the frame of a thing: origin at the centre of its base, z up when it stands."""
        ...

    def stood(self, thing: Thing) -> Pose:
        """Return where a thing was when all had come to rest, before anything moved."""
        ...

    def frame(self, name: str) -> Pose:
        """Return a named frame (a MuJoCo site), such as `flask_rim`."""
        ...

    def velocity(self, thing: Thing) -> FloatArray:
        """Return the velocity of a thing's centre of mass, shape (3,), m/s, world frame."""
        ...

    def angular_velocity(self, thing: Thing) -> FloatArray:
        """Return the angular velocity of a thing, shape (3,), rad/s, world frame."""
        ...

    def fall_speed(self, thing: Thing) -> float:
        """Return the greatest downward speed of a movable thing while not between the pads [m/s].

        Zero where it rose, or where both pads touched it all the time.
        """
        ...

    def joint(self, name: str) -> float:
        """Return the position of a named hinge [rad] or slide [m]; without stops: -pi to pi."""
        ...

    def joint_speed(self, name: str) -> float:
        """Return the greatest speed of a named hinge [rad/s] or slide [m/s]; never negative."""
        ...

    def sensor(self, name: str) -> float:
        """Return the reading of a named scalar sensor, such as the force on a button [N]."""
        ...

    def reading(self, name: str) -> Reading:
        """Return a named reading, such as what a balance shows, or whether a button is in."""
        ...

    @property
    def pressed(self) -> frozenset[str]:
        """Names of the push-buttons that are in."""
        ...

    @property
    def displayed(self) -> Mapping[str, Reading]:
        """The readings that displays show now, by name."""
        ...

    @property
    def liquid(self) -> LiquidAccount | None:
        """Account of where the liquid is; None where none is simulated."""
        ...

    def solution(self, vessel: Thing) -> Solution | None:
        """Return what a vessel holds; None where no liquid is simulated."""
        ...

    def touching(self, first: str, second: str) -> bool:
        """Return whether the two touched at any physics step since the last control step."""
        ...

    def touched_by(self, name: str) -> frozenset[str]:
        """Return everything that touched it at any physics step since the last control step."""
        ...

    def contact_force(self, first: str, second: str) -> float:
        """Return the greatest sum of the normal forces between the two [N]."""
        ...

    def normal_force(self, name: str) -> float:
        """Return the sum of the normal forces on it at the last physics step alone [N]."""
        ...

    def approach_speed(self, first: str, second: str) -> float:
        """Return the greatest speed at which the two met, along the normal of a contact [m/s]."""
        ...
