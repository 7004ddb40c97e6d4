"""Interface of an arm with a parallel gripper for the rest of the package."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.mesh_package import RTB_DATA, MeshPackage
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.world import Approach

if TYPE_CHECKING:
    import mujoco


class UnknownRobotError(UserError, ValueError):
    """A robot that does not exist; the message lists those that do."""


class Roles(NamedTuple):
    """Where the elements of a robot are, by what they do, in whatever has its elements in order.

    Attributes:
        joints: Those that carry the hand, from base to hand: a torso's first.
        gripper: The distance between the pads.
        base: Velocities of the base; of an arm on a stand empty.
        torso: Of the joints that which lifts the arm [m]; empty without a torso.
    """

    joints: slice
    gripper: int
    base: slice
    torso: slice = slice(0, 0)

    @property
    def arm(self) -> slice:
        """Those of the joints that turn [rad]: all but the torso's."""
        return slice(self.joints.start + self.torso.stop - self.torso.start, self.joints.stop)


@dataclass(frozen=True)
class ParallelGripper:
    """A hand with two fingers.

    Attributes:
        element: Distance between the pads [m].
        finger_reach: How far the fingers reach beyond the point between the pads [m].
        finger_thickness: Thickness of a finger tip, along the motion of the fingers [m].
        site: Site between the pads: z forward, y along the finger motion, x up at home.
        body: Body that carries the fingers.
        finger_joints: Slides of the fingers; their sum is the opening.
        pads: Geoms of the left and the right finger that touch what is held.
    """

    element: Element
    finger_reach: float
    finger_thickness: float
    site: str
    body: str
    finger_joints: tuple[str, str]
    pads: tuple[str, str]


@dataclass(frozen=True)
class Robot:
    """An arm with a parallel gripper: what to build, and the names and limits that go with it.

    It is a `world.Manipulator`. Whatever has as many numbers as the robot takes them from
    `elements`, and which of them is what from `roles`.

    Attributes:
        name: Short name.
        add_to: Builds the robot into a spec (angles in radians) as a child of a body: base frame at
            the parent's, z up, arm towards +x, no free joint. Every element has a servo of its
            name: of position; for a base of the velocity of its joints, which are in the room's
            frame. The arm's joints have the names of their elements.
        arm: Joints of the arm from base to hand [rad].
        gripper: The hand.
        home: The joints at rest [rad; m].
        elbow: Name of the joint that folds the arm; at 0 that is straight.
        reach: How far the hand gets from the base, horizontally [m].
        hand_speed: Greatest speed of the point between the pads [m/s].
        base_body: Root body; a torso moves the arm in its frame.
        vessel_approach: How the hand comes to vessels, relative to the bearing from the base.
        handle_approach: How the hand comes to handles, relative to straight into the door.
        deep_approach: How it comes down to what stands deep in something, relative to the bearing.
        settling: How long the hand stays near a place until it has stopped swinging there [s].
        base: What carries the arm over the floor; None if it is mounted on a stand.
        stowed: The joints while it drives [rad; m]; of an arm on a stand none.
        torso: The slide that lifts the arm [m]; None for an arm that stands on its base.
        trunk: Bodies of its own that forearm and hand could run into: base, torso, head.
        meshes: The package that it is drawn with.
    """

    name: str
    add_to: "Callable[[mujoco.MjSpec, mujoco.MjsBody], None]"
    arm: tuple[Element, ...]
    gripper: ParallelGripper
    home: tuple[float, ...]
    elbow: str
    reach: float
    hand_speed: float
    base_body: str
    vessel_approach: Approach
    handle_approach: Approach
    deep_approach: Approach
    settling: float = 0.0
    base: MobileBase | None = None
    stowed: tuple[float, ...] = ()
    torso: Element | None = None
    trunk: tuple[str, ...] = ()
    meshes: MeshPackage = RTB_DATA

    @property
    def joints(self) -> tuple[Element, ...]:
        """Joints that carry the hand, from base to hand: torso [m], then those of the arm [rad]."""
        return self.arm if self.torso is None else (self.torso, *self.arm)

    @property
    def elements(self) -> tuple[Element, ...]:
        """Everything that is measured and commanded, in order: joints, gripper, base."""
        driving = () if self.base is None else self.base.elements
        return (*self.joints, self.gripper.element, *driving)

    @property
    def roles(self) -> Roles:
        """Where in `elements` which of them are: nothing else may count on their order."""
        joints, torso = len(self.joints), len(self.joints) - len(self.arm)
        base = slice(joints + 1, len(self.elements))
        return Roles(slice(0, joints), joints, base, slice(0, torso))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the elements."""
        return tuple(element.name for element in self.elements)

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of what is observed: the elements, then the pose of the base in the room."""
        return self.names if self.base is None else (*self.names, *self.base.pose_names)

    @property
    def other_joints(self) -> tuple[str, ...]:
        """Joints that do not carry the hand: those of the fingers and of the base."""
        return (*self.gripper.finger_joints, *(() if self.base is None else self.base.joints))

    @property
    def lower(self) -> tuple[float, ...]:
        """Least positions of the elements [rad or m]."""
        return tuple(element.lower for element in self.elements)

    @property
    def upper(self) -> tuple[float, ...]:
        """Greatest positions of the elements [rad or m]."""
        return tuple(element.upper for element in self.elements)

    @property
    def speed(self) -> tuple[float, ...]:
        """Greatest speeds of the elements [rad/s or m/s]."""
        return tuple(element.speed for element in self.elements)

    @property
    def acceleration(self) -> tuple[float, ...]:
        """Greatest accelerations of the elements [rad/s^2 or m/s^2]."""
        return tuple(element.acceleration for element in self.elements)

    @property
    def jerk(self) -> tuple[float, ...]:
        """Greatest jerks of the elements [rad/s^3 or m/s^3]."""
        return tuple(element.jerk for element in self.elements)

    @property
    def start(self) -> tuple[float, ...]:
        """Elements when an episode begins [rad or m]: home, the gripper open, the base at rest."""
        return (*self.home, self.max_opening, *(() if self.base is None else (0.0, 0.0, 0.0)))

    @property
    def max_opening(self) -> float:
        """Greatest distance between the pads [m]."""
        return self.gripper.element.upper

    @property
    def finger_reach(self) -> float:
        """Reach of the fingers beyond the point between the pads [m]."""
        return self.gripper.finger_reach

    @property
    def finger_thickness(self) -> float:
        """Thickness of a finger tip, along the motion of the fingers [m]."""
        return self.gripper.finger_thickness
