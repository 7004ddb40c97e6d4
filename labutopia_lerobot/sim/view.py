"""The read-only world that predicates, skills and observations look at."""

import difflib
import math
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import compress

import mujoco
import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.processes import UnknownReadingError
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.scenes import NowhereToDriveError
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.world import (
    FloatArray,
    Floor,
    LiquidAccount,
    Manipulator,
    Obstacle,
    Pose,
    Reading,
    Solution,
    Thing,
)


class UnknownThingError(UserError, LookupError):
    """A predicate or skill asks for what is not in the scene; the message lists what is."""


class SimulatedWorld:
    """A `World` onto a simulation; hands out copies only.

    Raises:
        UnknownThingError: By whatever takes a thing or a name, if that is not in the scene.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        scene = simulation.scene
        self._data = simulation.data
        self._model = scene.model
        # Views, made once: MuJoCo's attributes would make them anew at every question.
        self._xpos, self._xmat = self._data.xpos, self._data.xmat.reshape(-1, 3, 3)
        self._site_xpos = self._data.site_xpos
        self._site_xmat = self._data.site_xmat.reshape(-1, 3, 3)
        self._touched = simulation.contacts.touched
        self._solutions: dict[str, Solution] = {}
        self._solutions_at = simulation.account
        self._opening = scene.robot.roles.gripper
        self._gripper = scene.model.site(scene.robot.gripper.site).id
        self._group = {name: index for index, name in enumerate(scene.groups)}
        self._pieces = scene.pieces
        self._movable: tuple[Thing, ...] = tuple(p for p in scene.pieces if p.movable)
        self._faller = {piece.name: index for index, piece in enumerate(self._movable)}
        names = (scene.model.joint(joint).name for joint in range(scene.model.njnt))
        self._joints = {name: joint for joint, name in enumerate(names)}
        self._turning = frozenset(_turning(scene.model))
        self._qpos, self._qpos_of = self._data.qpos, scene.model.jnt_qposadr.tolist()
        sites = (scene.model.site(site).name for site in range(scene.model.nsite))
        self._sites = {name: site for site, name in enumerate(sites)}
        self._bodies: dict[str, int] = {
            piece.name: int(scene.model.body(piece.name).id) for piece in scene.pieces
        }

    @property
    def time(self) -> float:
        """Time since the episode began [s]."""
        return float(self._data.time)

    @property
    def bench_height(self) -> float:
        """Height of the bench top above the floor [m]."""
        return self._simulation.scene.room.bench.height

    @property
    def robot(self) -> Manipulator:
        """The facts about the robot that are known beforehand."""
        return self._simulation.scene.robot

    @property
    def robot_base(self) -> Pose:
        """Base of the arm, x forward, z up."""
        scene = self._simulation.scene
        if scene.robot.base is None:
            return Pose(np.array(scene.room.robot_stand), np.eye(3))
        return self._pose(self._model.body(scene.robot.base_body).id)

    @property
    def mobile_base(self) -> Pose | None:
        """Middle of the mobile base on the floor, x forward, z up; None for an arm on a stand."""
        base = self._simulation.scene.robot.base
        return None if base is None else self._pose(self._model.body(base.body).id)

    @property
    def base_velocity(self) -> FloatArray:
        """Velocity of the mobile base, in its own frame, shape (3,) [m/s, m/s, rad/s]."""
        return self._simulation.measured[self._simulation.scene.robot.roles.base]

    @property
    def stowed_hand(self) -> Pose:
        """Pose of the hand while the robot drives, in the frame of the arm's base.

        Raises:
            NowhereToDriveError: If it has no base.
        """
        self._require_base()
        return self._stowed_hand

    @cached_property
    def floor(self) -> Floor:
        """Map of the room and places at its benches, for a robot that drives.

        Raises:
            NowhereToDriveError: If there is no such robot, or nothing to drive to.
        """
        return self._simulation.scene.room.ground(self._require_base()).floor

    @property
    def gripper(self) -> Pose:
        """Frame between the pads: z forward, y along the motion of the fingers."""
        return self._site(self._gripper)

    @property
    def gripper_opening(self) -> float:
        """Distance between the pads [m]."""
        return float(self._simulation.measured[self._opening])

    @property
    def commanded_opening(self) -> float:
        """Distance between the pads that is commanded [m]."""
        return float(self._simulation.command[self._opening])

    @property
    def movable(self) -> tuple[Thing, ...]:
        """Everything that stands free, distractors included."""
        return self._movable

    @property
    def in_the_way(self) -> tuple[Obstacle, ...]:
        """What stands or walks on the floor and is on no map."""
        return tuple(piece for piece in self._pieces if isinstance(piece, Obstacle))

    def pose(self, thing: Thing) -> Pose:
        """Return the frame of a thing: origin at the centre of its base."""
        return self._pose(self._body(thing))

    def stood(self, thing: Thing) -> Pose:
        """Return where a thing was when all had come to rest, before anything moved."""
        body = self._body(thing)
        xpos, xmat = self._simulation.rest
        return Pose(xpos[body].copy(), xmat[body].reshape(3, 3).copy())

    def frame(self, name: str) -> Pose:
        """Return a named frame."""
        if name not in self._sites:
            raise self._unknown("frame", name, self._sites)
        return self._site(self._sites[name])

    def velocity(self, thing: Thing) -> FloatArray:
        """Return the velocity of a thing's centre of mass, shape (3,), m/s, world frame."""
        return self._twist(thing)[3:]

    def angular_velocity(self, thing: Thing) -> FloatArray:
        """Return the angular velocity of a thing, shape (3,), rad/s, world frame."""
        return self._twist(thing)[:3]

    def fall_speed(self, thing: Thing) -> float:
        """Return the greatest downward speed of a thing since the last control step, let go."""
        if thing.name not in self._faller:
            raise self._unknown("movable thing", thing.name, self._faller)
        return float(self._simulation.contacts.fall[self._faller[thing.name]])

    def joint(self, name: str) -> float:
        """Return the position of a named hinge [rad] or slide [m]."""
        joint = self._joint(name)
        position = float(self._qpos[self._qpos_of[joint]])
        return math.remainder(position, 2 * math.pi) if joint in self._turning else position

    def joint_speed(self, name: str) -> float:
        """Return the greatest speed of a named hinge [rad/s] or slide [m/s]; never negative."""
        return float(self._simulation.contacts.speed[self._model.jnt_dofadr[self._joint(name)]])

    def sensor(self, name: str) -> float:
        """Return the reading of a named scalar sensor."""
        try:
            return float(self._data.sensor(name).data[0])
        except KeyError:
            raise self._unknown(
                "sensor", name, self._names(self._model.nsensor, "sensor")
            ) from None

    def reading(self, name: str) -> Reading:
        """Return a named reading."""
        try:
            return self._simulation.apparatus.reading(name)
        except UnknownReadingError:
            raise self._unknown("reading", name, self._simulation.apparatus.readings) from None

    @property
    def pressed(self) -> frozenset[str]:
        """Names of the push-buttons that are in."""
        return self._simulation.apparatus.pressed

    @property
    def displayed(self) -> Mapping[str, Reading]:
        """The readings that displays show now, by name."""
        return self._simulation.apparatus.displayed

    @property
    def liquid(self) -> LiquidAccount | None:
        """Account of where the liquid is; None where none is simulated."""
        return self._simulation.account

    def solution(self, vessel: Thing) -> Solution | None:
        """Return what a vessel holds; None where no liquid is simulated."""
        return self.solution_in(vessel.name)

    def solution_in(self, name: str) -> Solution | None:
        """Return what the vessel of a name holds, worked out once after each control step."""
        liquid, account = self._simulation.liquid, self._simulation.account
        if liquid is None:
            return None
        if account is not self._solutions_at:
            self._solutions, self._solutions_at = {}, account
        if name not in self._solutions:
            if name not in liquid.names:
                raise self._unknown("vessel", name, liquid.names)
            self._solutions[name] = liquid.solution(liquid.names.index(name))
        return self._solutions[name]

    def touching(self, first: str, second: str) -> bool:
        """Return whether the two touched since the last control step."""
        return bool(self._touched[self._pair(first, second)])

    def touched_by(self, name: str) -> frozenset[str]:
        """Return everything that touched it since the last control step."""
        return frozenset(compress(self._group, self._touched[self._touching(name)].tolist()))

    def contact_force(self, first: str, second: str) -> float:
        """Return the greatest normal force between the two since the last control step [N]."""
        return float(self._simulation.contacts.force[self._pair(first, second)])

    def normal_force(self, name: str) -> float:
        """Return the sum of the normal forces on it at the last physics step alone [N]."""
        forces = self._simulation.contacts.now[self._touching(name)]
        return float(forces[forces > 0.0].sum())

    def approach_speed(self, first: str, second: str) -> float:
        """Return the greatest speed at which the two met since the last control step [m/s]."""
        return float(self._simulation.contacts.approach[self._pair(first, second)])

    def _require_base(self) -> MobileBase:
        robot = self._simulation.scene.robot
        if robot.base is None:
            raise NowhereToDriveError(
                f"robot={robot.name!r} is mounted on a stand, and a skill or predicate lets it "
                "drive. Choose a robot with a base"
            )
        return robot.base

    @cached_property
    def _stowed_hand(self) -> Pose:
        """Found on a model of its own: kinematics of the arm, wherever the base is."""
        robot, data = self._simulation.scene.robot, mujoco.MjData(self._model)
        elements = np.array([*robot.stowed, robot.max_opening, *np.zeros(3)])
        Drives(self._model, robot).place(data.qpos, elements)
        mujoco.mj_kinematics(self._model, data)
        base, site = data.body(robot.base_body), data.site(self._gripper)
        arm = Pose(base.xpos, base.xmat.reshape(3, 3))
        return arm.inverse() @ Pose(site.xpos, site.xmat.reshape(3, 3))

    def _pose(self, body: int) -> Pose:
        return Pose(self._xpos[body].copy(), self._xmat[body].copy())

    def _twist(self, thing: Thing) -> FloatArray:
        """Return angular and linear velocity of a thing's centre of mass, shape (6,)."""
        twist = np.empty(6)
        kind, body = mujoco.mjtObj.mjOBJ_BODY, self._body(thing)
        mujoco.mj_objectVelocity(self._model, self._data, kind, body, twist, 0)
        return twist

    def _pair(self, first: str, second: str) -> tuple[int, int]:
        """Return where a record of contacts is about two groups."""
        return self._touching(first), self._touching(second)

    def _body(self, thing: Thing) -> int:
        if thing.name not in self._bodies:
            raise self._unknown("thing", thing.name, self._bodies)
        return self._bodies[thing.name]

    def _touching(self, name: str) -> int:
        """Return the index of what contacts call by a name."""
        if name not in self._group:
            raise self._unknown("thing", name, self._group)
        return self._group[name]

    def _joint(self, name: str) -> int:
        if name not in self._joints:
            raise self._unknown("joint", name, self._joints)
        return self._joints[name]

    def _names(self, count: int, kind: str) -> list[str]:
        return [getattr(self._model, kind)(index).name for index in range(count)]

    def _unknown(self, kind: str, name: str, known: Iterable[str]) -> UnknownThingError:
        """Return the error about a name that a predicate or a skill has asked for in vain."""
        known = list(known)
        near = difflib.get_close_matches(name, known, n=1)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        things = ", ".join(piece.name for piece in self._pieces) or "nothing"
        return UnknownThingError(
            f"A predicate or a skill asks for the {kind} '{name}', which is not there.{hint} Put "
            f"what it belongs to into the `start` of the task. Things in the start: {things}"
        )

    def _site(self, site: int) -> Pose:
        return Pose(self._site_xpos[site].copy(), self._site_xmat[site].copy())


def _turning(model: mujoco.MjModel) -> Iterator[int]:
    """Return the hinges that turn round and round."""
    for joint in range(model.njnt):
        hinge = model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
        if hinge and not model.jnt_limited[joint]:
            yield joint
