"""Reactive motion: differential inverse kinematics that keeps clear of the bench and the labware.

The paper moves its arm with RMPflow (section "Task-Rich Trajectory Collection"), a reactive policy
that reaches a target while avoiding obstacles. This does the same job as a quadratic program, which
mink solves at every control step: track the target frame, within the limits of
position, speed and acceleration, without letting any pair of bodies come nearer than a margin.
"""

import itertools
import math
from collections.abc import Iterator
from typing import Any

import mink
import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.robots.command_limits import CommandLimits
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.scenes.within_reach import PREFIX
from labutopia_lerobot.sim.near_bodies import NearBodies
from labutopia_lerobot.sim.scene import Scene, add_robot, ancestors
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.unwinding import Unwinding
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.world import ARM, BENCH, CONTROL_HZ, HAND, FloatArray, Pose, Thing
from labutopia_lerobot.world.model import HULL_GROUP

_MARGIN = 0.004
"""Distance that is kept between any two bodies [m]."""
_HORIZON = 0.08
"""Distance below which a pair takes part in the program [m]."""
_NEAR = 2 * _MARGIN
"""Distance below which the margin may be what keeps the hand from its target [m]."""
_GAIN = 0.85 / CONTROL_HZ
"""Share of the distance left that one control period may use up, per second: mink bounds a step by
`gain * distance / dt`."""
_GENTLE_GAIN, _GENTLE_HORIZON = 0.13 / CONTROL_HZ, 0.15
"""The same of an arm with a trunk, from that and from furniture, and the distance below which it
acts [m]; ours: nothing is to be done there, and a heavy upper arm brakes in good time."""
_POSITION, _ORIENTATION = 1.0, 0.3
"""Cost of the hand away from its target [1/m, 1/rad]."""
_POSTURE = 0.003
"""Cost of joints away from home [1/rad]; ours: its pull moves the hand from its target by less than
the phases ask for."""
_STRETCHED = 0.6
"""Angle of the elbow below which the posture costs more [rad]; ours: experts that are not lost fold
it by 0.9 rad and more in every task."""
_FOLDING = 10.0
"""Factor by which it costs more where the arm is straight; ours. Without that an arm that was
stretched once found no way back: moving the hand inwards begins by bringing it further off."""
_RETREAT = 0.0005
"""Distance by which a pair that is too near must part in a control period [m]."""
_SHARE = 0.85
"""Share of the robot's speeds and accelerations that is used: commands are never clipped."""
_SHORT = 0.01
"""Distance by which a hand is short of its target that it cannot reach [m]; ours."""
_REACHED = 0.5
"""Height above the floor from which furniture is kept clear of [m]; ours: no arm on a base comes
lower."""
_FAR, _UNTURNED = (0.0, 0.0, -10.0), (1.0, 0.0, 0.0, 0.0)
_OBSTACLE, _LOAD = "obstacle_", "load_"


class ReactiveMotion:
    """Inverse kinematics on a model of its own: the arm, and hulls of everything else.

    In that model every body of a thing is an obstacle, moved to where the world sees it. A movable
    thing is there a second time, as a load fixed to the hand while it is held. The copy that is not
    in use is far away.
    """

    def __init__(self, simulation: Simulation, world: SimulatedWorld) -> None:
        self._simulation = simulation
        self._world = world
        scene = simulation.scene
        self._robot = scene.robot
        self._roles = scene.robot.roles
        self._model = _planning_model(scene)
        movable = [piece for piece in scene.pieces if piece.movable]
        self._loads = {piece: self._model.body(_LOAD + piece.name) for piece in movable}
        self._drives = Drives(self._model, scene.robot)
        self._configuration = mink.Configuration(self._model)
        self._track = mink.FrameTask(
            scene.robot.gripper.site,
            "site",
            position_cost=_POSITION,
            orientation_cost=_ORIENTATION,
        )
        self._unwinding = Unwinding(scene.robot)
        self._command_limits = CommandLimits(scene.robot, _SHARE)
        self._box = _Box(self._model.nv, self._drives.joint_dofs)
        self._elbow = scene.robot.names.index(scene.robot.elbow)
        self._posture = mink.PostureTask(self._model, cost=_POSTURE)
        home = self._model.qpos0.copy()
        self._drives.place(home, np.array(scene.robot.start))
        self._posture.set_target(home)
        self._limits = [
            self._box,
            mink.VelocityLimit(self._model, dict.fromkeys(scene.robot.other_joints, 0.0)),
        ]
        furniture = [] if scene.robot.base is None else _furniture(self._model)
        self._clearances = _clearances(self._model, scene.robot, scene.pieces, furniture)
        self._near = NearBodies(self._model, self._clearances)
        self._own = _own_clearance(self._model, scene.robot)
        self._extents = {name: _extent(self._model, name) for name in furniture}
        hulls = [body for piece in scene.pieces for body in _hulls_by_body(scene, piece)]
        self._obstacles = [(scene.model.body(body).name, body) for body in hulls]

    def begin(self) -> None:
        """Begin anew: nothing that happened before counts."""
        self._unwinding.begin()
        for load in self._loads.values():  # its mass is in the sums of the hand's, wherever it is
            load.quat = _UNTURNED

    def follow(
        self,
        target: Pose,
        opening: float,
        driving_b: FloatArray | None = None,
        *,
        touches: frozenset[str],
        holds: Thing | None,
    ) -> FloatArray:
        """Return the next command, shape (elements,), that brings the gripper to the target.

        Args:
            target: Wanted pose of the gripper frame.
            opening: Wanted distance between the pads [m].
            driving_b: Wanted velocity of the base, base frame, shape (3,) [m/s, m/s, rad/s]; None
                to stand.
            touches: Names of things, or `bench`, that the hand and its load may touch.
            holds: The thing in the gripper, kept clear of everything else, or None.
        """
        self._look(holds)
        quat_wxyz, position = target.quat_wxyz, target.position_w
        self._track.set_target(mink.SE3(np.concatenate([quat_wxyz, position])))
        tracks = 0.0 if self._unwinding.active else 1.0
        self._track.set_position_cost(tracks * _POSITION)
        self._track.set_orientation_cost(tracks * _ORIENTATION)
        folded = min(1.0, abs(self._simulation.command[self._elbow]) / _STRETCHED)
        self._posture.set_cost(_POSTURE * (1.0 + _FOLDING * (1.0 - folded) ** 2))
        near, kept = self._near.at(self._configuration.data), self._kept_apart(touches, holds)
        avoid = [self._clearances[pair] for pair in kept if pair in near]
        limits, joints, gripper = self._command_limits, self._roles.joints, self._roles.gripper
        before, last = self._simulation.commands[-2:]
        least, greatest = limits.changes(before, last)
        self._box.least, self._box.greatest = least[joints], greatest[joints]
        wanted = last.copy()
        wanted[gripper] = opening
        wanted[self._roles.base] = 0.0 if driving_b is None else driving_b
        wanted = limits.within(wanted)
        change = np.clip(limits.closing(wanted - last), least, greatest)
        try:
            velocity = mink.solve_ik(
                self._configuration,
                [self._track, self._posture],
                1.0 / CONTROL_HZ,
                solver="daqp",
                damping=1e-6,
                limits=[*self._limits, *self._own, *avoid],
            )
        except mink.NoSolutionFound:  # hemmed in: all that it could do would bring it nearer to it
            change[joints] = np.clip(limits.braking(last - before), least, greatest)[joints]
        else:
            change[joints] = velocity[self._drives.joint_dofs] / CONTROL_HZ
        free = holds is None and not touches and driving_b is None  # a hand at work stays there
        short = free and self._world.gripper.distance_to(target) > _SHORT
        self._unwinding.see(last[joints], change[joints], short=short)
        command: FloatArray = last + change
        return command

    def kept_from(
        self, *, touches: frozenset[str], holds: Thing | None
    ) -> dict[tuple[str, str], float]:
        """Return what is kept apart and is near each other, with the distance [m].

        Args:
            touches: As in `follow`.
            holds: As in `follow`.
        """
        self._look(holds)
        data = self._configuration.data
        gaps = {
            pair: min(
                mujoco.mj_geomDistance(self._model, data, a, b, _HORIZON, None)
                for a, b in self._clearances[pair].geom_id_pairs
            )
            for pair in self._kept_apart(touches, holds)
        }
        return {pair: gap for pair, gap in gaps.items() if gap < _NEAR}

    def _kept_apart(
        self, touches: frozenset[str], holds: Thing | None
    ) -> Iterator[tuple[str, str]]:
        """Yield each mover (arm, hand, load) with what it must not touch."""
        load = holds.name if holds is not None else None
        here = self._world.robot_base.position_w[:2]
        far = {
            name
            for name, (low, high) in self._extents.items()
            if math.dist(np.clip(here, low, high), here) > self._robot.reach
        }
        for mover, obstacle in self._clearances:
            if obstacle in far:
                continue
            may_touch = obstacle in touches and mover != ARM
            if mover in (ARM, HAND, load) and obstacle != load and not may_touch:
                yield mover, obstacle

    def _look(self, holds: Thing | None) -> None:
        """Bring the planning model up to date with the command in force and the live world."""
        data, live = self._configuration.data, self._simulation.data
        held = holds.name if holds is not None else None
        for mocap, (name, body) in enumerate(self._obstacles):
            data.mocap_pos[mocap] = _FAR if name == held else live.xpos[body]
            data.mocap_quat[mocap] = live.xquat[body]
        for piece, load in self._loads.items():
            if piece.name == held:
                in_hand = self._world.gripper.inverse() @ self._world.pose(piece)
                load.pos, load.quat = in_hand.position_w, in_hand.quat_wxyz
            else:
                load.pos = _FAR
        positions = self._simulation.command
        # A touch inside the range: measured openings overshoot it, which no motion could mend.
        widest = self._robot.max_opening
        positions[self._roles.gripper] = np.clip(self._world.gripper_opening, 1e-4, widest - 1e-4)
        qpos = self._model.qpos0.copy()
        self._drives.place(qpos, positions)
        self._drives.stand(qpos, self._simulation.base_pose)
        self._configuration.update(qpos)


class _Box(mink.Limit):
    """Bounds on the change of each joint in a control period.

    Attributes:
        least: Least changes, shape (joints,) [rad].
        greatest: Greatest changes, shape (joints,) [rad].
    """

    def __init__(self, dofs: int, joints: NDArray[np.intp]) -> None:
        rows = np.eye(dofs)[joints]
        self._rows = np.vstack([rows, -rows])
        self.least: FloatArray = np.zeros(len(joints))
        self.greatest: FloatArray = np.zeros(len(joints))

    def compute_qp_inequalities(
        self, configuration: mink.Configuration, dt: float
    ) -> mink.Constraint:
        """Return the bounds as mink wants them."""
        return mink.Constraint(self._rows, np.concatenate([self.greatest, -self.least]))


def _planning_model(scene: Scene) -> mujoco.MjModel:
    """Compile the arm among hulls: of every body an obstacle, of movable things a load too."""
    spec = scene.room.build(VESSEL_VIEW)
    add_robot(spec, scene.robot, scene.room)
    grasp = spec.site(scene.robot.gripper.site)
    hand = spec.body(scene.robot.gripper.body)
    in_hand = hand.add_body(name="in_hand", pos=grasp.pos, quat=grasp.quat)
    for piece in scene.pieces:
        for body, hulls in _hulls_by_body(scene, piece).items():
            name = scene.model.body(body).name
            obstacle = spec.worldbody.add_body(name=_OBSTACLE + name, mocap=True)
            _copy_hulls(scene, hulls, spec, obstacle, _OBSTACLE)
            if piece.movable:
                load = in_hand.add_body(name=_LOAD + name)
                _copy_hulls(scene, hulls, spec, load, _LOAD)
    return spec.compile()


def _hulls_by_body(scene: Scene, piece: Piece) -> dict[int, list[int]]:
    """Return the bodies of a piece, each with the geoms that are its hulls."""
    model = scene.model
    root = model.body(piece.name).id
    hulls: dict[int, list[int]] = {}
    for geom in np.flatnonzero(model.geom_group == HULL_GROUP):
        body = int(model.geom_bodyid[geom])
        if root in ancestors(model, body):
            hulls.setdefault(body, []).append(int(geom))
    return hulls


def _copy_hulls(
    scene: Scene, hulls: list[int], spec: mujoco.MjSpec, body: mujoco.MjsBody, prefix: str
) -> None:
    """Copy the hulls, primitives and convex meshes, to a body; the copies count."""
    model = scene.model
    for hull in (model.geom(geom) for geom in hulls):
        shape, mesh = mujoco.mjtGeom(hull.type[0]), int(hull.dataid[0])
        kind: dict[str, Any] = {"size": hull.size}
        if shape == mujoco.mjtGeom.mjGEOM_MESH:
            first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            corners = model.mesh_vert[first : first + count]
            spec.add_mesh(name=prefix + hull.name, uservert=corners.ravel())
            kind = {"meshname": prefix + hull.name}
        body.add_geom(name=prefix + hull.name, type=shape, pos=hull.pos, quat=hull.quat, **kind)


def _furniture(model: mujoco.MjModel) -> list[str]:
    """Return the bodies of a furnished room that reach so high that an arm could touch them."""
    bodies = (model.body(body).name for body in range(model.nbody))
    return [name for name in bodies if name.startswith(PREFIX) and _high_geoms(model, name)]


def _high_geoms(model: mujoco.MjModel, body: str) -> list[int]:
    """Return the colliding geoms of a body alone whose tops are above `_REACHED`."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    first, count = model.body(body).geomadr[0], model.body(body).geomnum[0]
    return [
        geom
        for geom in range(first, first + count)
        if model.geom_contype[geom] and _corners(model, data, geom)[:, 2].max() > _REACHED
    ]


def _extent(model: mujoco.MjModel, body: str) -> tuple[FloatArray, FloatArray]:
    """Return least and greatest x and y of what of a body an arm could touch [m], world frame."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    corners = np.vstack([_corners(model, data, geom) for geom in _high_geoms(model, body)])
    return corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)


def _corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> FloatArray:
    """Return the corners of the box around a geom, shape (8, 3) [m], world frame."""
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    local = model.geom_aabb[geom, :3] + signs * model.geom_aabb[geom, 3:]
    corners: FloatArray = local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    return corners


def _clearances(
    model: mujoco.MjModel, robot: Robot, pieces: tuple[Piece, ...], furniture: list[str]
) -> dict[tuple[str, str], mink.CollisionAvoidanceLimit]:
    """Return one distance limit for every mover (arm, hand, load) and obstacle (bench, body)."""
    loads = {
        piece.name: _geoms_below(model, _LOAD + piece.name) for piece in pieces if piece.movable
    }
    gripper = set(_geoms_below(model, robot.gripper.body))
    hand = gripper - set(_geoms_below(model, "in_hand"))
    arm = set(_geoms_below(model, robot.base_body)) - gripper
    movers = {ARM: sorted(arm), HAND: sorted(hand), **loads}
    names = (model.body(body).name for body in range(model.nbody) if model.body_mocapid[body] >= 0)
    obstacles = {name.removeprefix(_OBSTACLE): _geoms_below(model, name) for name in names}
    obstacles[BENCH] = _geoms_below(model, BENCH)
    obstacles |= {name: _high_geoms(model, name) for name in furniture}
    gentle = {(ARM, name) for name in furniture if robot.trunk}
    return {
        (a, b): _apart(model, movers[a], obstacles[b], gently=(a, b) in gentle)
        for a, b in itertools.product(movers, obstacles)
        if a != b
    }


def _own_clearance(model: mujoco.MjModel, robot: Robot) -> list[mink.CollisionAvoidanceLimit]:
    """Return the distance limit between a robot's trunk and its arm from the upper arm on, if any.

    What is nearer to the shoulder cannot get away from it.
    """
    if not robot.trunk:
        return []
    upper_arm = model.body_parentid[model.jnt_bodyid[model.joint(robot.elbow).id]]
    loads = set(_geoms_below(model, "in_hand"))
    arm = [g for g in _geoms_below(model, model.body(upper_arm).name) if g not in loads]
    bodies = {model.body(name).id for name in robot.trunk}
    collides = [g for g in range(model.ngeom) if model.geom_contype[g]]
    trunk = [g for g in collides if model.geom_bodyid[g] in bodies]
    return [_apart(model, arm, trunk, gently=True)]


def _apart(
    model: mujoco.MjModel, movers: list[int], obstacles: list[int], *, gently: bool
) -> mink.CollisionAvoidanceLimit:
    """Return the distance limit between geoms, that of a heavy arm if it acts gently."""
    horizon = _GENTLE_HORIZON if gently else _HORIZON
    return mink.CollisionAvoidanceLimit(
        model,
        [(movers, obstacles)],
        gain=_GENTLE_GAIN if gently else _GAIN,
        bound_relaxation=-_RETREAT,
        minimum_distance_from_collisions=_MARGIN,
        collision_detection_distance=horizon,
    )


def _geoms_below(model: mujoco.MjModel, body: str) -> list[int]:
    """Return the colliding geoms of a body and its descendants."""
    root = model.body(body).id
    return [
        geom
        for geom in range(model.ngeom)
        if model.geom_contype[geom] and root in ancestors(model, model.geom_bodyid[geom])
    ]
