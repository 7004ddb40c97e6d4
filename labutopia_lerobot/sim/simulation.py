"""Stepping: the one place where time passes."""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.handling import Handling
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.looks import columns, heaps, looks, sediments
from labutopia_lerobot.liquids.surroundings import Carrier
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.set_points import PHYSICS_STEPS, SPAN, set_points
from labutopia_lerobot.sim.contact_record import ContactRecord
from labutopia_lerobot.sim.scene import ROBOT_MOUNT, Scene, at_stand
from labutopia_lerobot.substances.filling import (
    Dispenser,
    Fillable,
    Filling,
    Intake,
    with_mounted,
)
from labutopia_lerobot.world import CONTROL_HZ, FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ

_SETTLE_STEPS = CONTROL_HZ // 3
"""Control steps before the episode begins, in which things come to rest on the bench."""

_DIVERGENCE = (
    mujoco.mjtWarning.mjWARN_BADQPOS,
    mujoco.mjtWarning.mjWARN_BADQVEL,
    mujoco.mjtWarning.mjWARN_BADQACC,
)


class Simulation:
    """A compiled scene with its state.

    Attributes:
        scene: The compiled scene.
        data: MuJoCo's state; positions and contacts in it always belong to the present moment.
        liquid: The liquid, or None where there is none.
        account: Where it is, as of the last control step.
        contacts: What touched what since the previous control step, how hard and how fast.
        apparatus: The processes of the things, at work.
        set_points: What the servos were given at each physics step since then [rad or m], shape
            (PHYSICS_STEPS, elements).
        watch: Called after every physics step, if anything.
        rest: Where bodies were after the reset, when all had come to rest: positions, shape
            (bodies, 3), metres, and orientations, shape (bodies, 9), world frame.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.data = mujoco.MjData(scene.model)
        self.contacts = ContactRecord(scene, self.data)
        self._drives = Drives(scene.model, scene.robot)
        self._start = np.array(scene.robot.start)
        self._base_start = at_stand(scene.robot, scene.room)
        self.liquid = _liquid(scene, self.data) if scene.contents else None
        self.account = None if self.liquid is None else self.liquid.take_account()
        commands = SPAN * len(scene.robot.elements)
        self.apparatus = Apparatus(
            scene.model, self.data, scene.processes, self.data.userdata[commands:]
        )
        self.apparatus.liquid = None if self.liquid is None else Handling(self.liquid)
        self.set_points = np.tile(self._start, (PHYSICS_STEPS, 1))
        self.watch: Callable[[], None] | None = None
        self.commands[:] = self._start
        self._built = scene.model.body_pos.copy()
        self.rest = self.data.xpos.copy(), self.data.xmat.copy()

    def reset(
        self,
        layout: Mapping[Piece, Placement],
        displacement: FloatArray | None = None,
        rng: np.random.Generator | None = None,
        base_pose: FloatArray | None = None,
    ) -> None:
        """Put the robot at home and the things where the layout says, and let them settle.

        Args:
            layout: Where things stand.
            displacement: How far from home the arm starts, shape (joints,), radians.
            rng: Where the processes' random numbers come from; a fixed one if there is none.
            base_pose: Where a base starts that is to drive, the arm stowed: x, y [m] and heading
                [rad], shape (3,); None for one that stands at the bench.
        """
        rng = np.random.default_rng(0) if rng is None else rng
        model, data, bench = self.scene.model, self.data, self.scene.room.bench
        if self.liquid is not None:
            self.liquid.empty()
        free: dict[str, FloatArray] = {}
        for piece, placement in layout.items():
            position = np.array([placement.x, placement.y, bench.height + placement.height])
            quat_wxyz = Rotation.from_euler("z", placement.yaw).as_quat(scalar_first=True)
            if piece.movable:
                free[f"{piece.name}_free"] = np.concatenate([position, quat_wxyz])
            else:
                model.body(piece.name).pos = position
                model.body(piece.name).quat = quat_wxyz
            for body, place in placement.swaps:
                model.body(body).pos = self._built[model.body(place).id]
        # Behind that: where islands may sleep, MuJoCo asks only here where fixed bodies are.
        mujoco.mj_resetData(model, data)
        for joint, pose in free.items():
            data.joint(joint).qpos = pose
        start = self._start.copy()
        if base_pose is not None:
            start[self.scene.robot.roles.joints] = self.scene.robot.stowed
        if displacement is not None:
            start[self.scene.robot.roles.arm] += displacement
        self._drives.place(data.qpos, start)
        self._drives.stand(data.qpos, self._base_start if base_pose is None else base_pose)
        self._drives.command(data, start)
        self.commands[:] = start
        mujoco.mj_step1(model, data)
        self.apparatus.start(rng)
        for _ in range(_SETTLE_STEPS):
            self.step(start)
        self._start_processes(rng)
        self.rest = data.xpos.copy(), data.xmat.copy()
        self.start_clock()

    def fill(
        self, rng: np.random.Generator, contents: Mapping[Piece, Filling] | None = None
    ) -> None:
        """Fill the vessels where they are, and hold still until all has come to rest.

        Args:
            rng: Where the liquid's disorder comes from.
            contents: What they hold; of what is said of the scene's only how warm it is may differ.
        """
        if self.liquid is not None:
            held = self.scene.contents if contents is None else contents
            vessels: dict[Fillable | Dispenser, Filling] = {
                piece: one for piece, one in held.items() if isinstance(piece, Fillable | Dispenser)
            }
            self.liquid.fill(vessels, rng)
            for _ in range(_SETTLE_STEPS):
                self.step(self.command)
            self._start_processes(rng)

    def start_clock(self) -> None:
        """Make now the beginning of the episode."""
        self.data.time = 0.0

    def _start_processes(self, rng: np.random.Generator) -> None:
        self.apparatus.start(rng)
        if self.liquid is not None:
            self.liquid.bottles.start()

    def step(self, command: FloatArray) -> None:
        """Advance by one control period, in which the servos follow a smooth curve.

        Args:
            command: Joint targets [rad] and gripper opening [m], shape (elements,).
        """
        model, data = self.scene.model, self.data
        self.contacts.clear()
        commands = self.commands
        commands[:-1] = commands[1:]
        commands[-1] = command
        self.set_points, rates = set_points(commands)
        for substep, targets in enumerate(self.set_points + self._drives.lag * rates, start=1):
            self._drives.command(data, targets)
            # The two halves of mj_step, turned round: so that positions are never one step old.
            mujoco.mj_step2(model, data)
            self.contacts.note()
            mujoco.mj_step1(model, data)
            self.apparatus.sample()
            if self.liquid is not None and substep % (PHYSICS_HZ // self.liquid.hertz) == 0:
                self.liquid.step()
            if self.watch is not None:
                self.watch()
        self.apparatus.step()
        if self.liquid is not None:
            self.account = self.liquid.take_account()

    @property
    def commands(self) -> FloatArray:
        """The commands that act, the last in the last row, shape (SPAN, elements), a view."""
        elements = len(self.scene.robot.elements)
        commands: FloatArray = self.data.userdata[: SPAN * elements]
        return commands.reshape(SPAN, elements)

    @property
    def command(self) -> FloatArray:
        """Joint targets [rad] and gripper opening [m] in force, shape (elements,), a copy."""
        command: FloatArray = self.commands[-1].copy()
        return command

    @property
    def diverged(self) -> bool:
        """Whether the integration has failed (MuJoCo found a bad position or acceleration)."""
        if self.liquid is not None and self.liquid.diverged:
            return True
        return any(self.data.warning[kind].number for kind in _DIVERGENCE)

    @property
    def measured(self) -> FloatArray:
        """Joint angles [rad], distance between the pads [m] and velocities, shape (elements,)."""
        return self._drives.measured(self.data)

    @property
    def base_pose(self) -> FloatArray:
        """Where the base is: x, y [m] and heading [rad]; empty for an arm on a stand."""
        return self._drives.base_pose(self.data)

    @property
    def robot_state(self) -> FloatArray:
        """State of the robot that is observed, in the order of `Robot.state_names`."""
        odometry = self.scene.odometry
        pose = self.base_pose if odometry is None else odometry.pose(self.apparatus)
        pose[2:] -= 2 * np.pi * np.round(pose[2:] / (2 * np.pi))  # however often it has turned
        return np.concatenate([self.measured, pose])

    def draw_liquid(self) -> None:
        """Find the surface of the liquid, once for all pictures of this moment."""
        liquid, drawing = self.liquid, self.scene.liquid
        if liquid is not None and drawing is not None:
            vessels = [
                VesselPose(vessel.profile, *self._frame(vessel.name)) for vessel in liquid.vessels
            ]
            tints, height = drawing.colors, self.scene.room.bench.height
            drawing.extract(
                liquid.positions,
                vessels,
                height,
                looks(liquid, tints, heaped=True),
                columns(liquid, vessels, tints),
                heaps(liquid, vessels),
                sediments(liquid, vessels),
            )

    def draw_particles(self, scene: mujoco.MjvScene) -> None:
        """Fill a user's scene, as MuJoCo's viewer has one, with the particles of the liquid."""
        liquid, drawing = self.liquid, self.scene.liquid
        if liquid is not None and drawing is not None:
            drawing.draw_particles(scene, liquid.positions, looks(liquid, drawing.colors))

    def _frame(self, name: str) -> tuple[FloatArray, FloatArray]:
        body = self.data.body(name)
        return body.xpos, body.xmat.reshape(3, 3)

    def state(self) -> FloatArray:
        """Return a copy of the full physics state, from which it continues bit for bit."""
        kind = mujoco.mjtState.mjSTATE_INTEGRATION
        state = np.empty(mujoco.mj_stateSize(self.scene.model, kind))
        mujoco.mj_getState(self.scene.model, self.data, state, kind)
        if self.liquid is not None:
            state = np.concatenate([state, self.liquid.state()])
        return state

    def restore(self, state: FloatArray) -> None:
        """Go back to what `state` returned in this episode, whatever has happened since.

        What touched since the previous control step is forgotten.
        """
        model, data, kind = self.scene.model, self.data, mujoco.mjtState.mjSTATE_INTEGRATION
        size = mujoco.mj_stateSize(model, kind)
        mujoco.mj_setState(model, data, state[:size], kind)
        mujoco.mj_step1(model, data)
        self.contacts.clear()
        if self.liquid is not None:
            self.liquid.restore(state[size:])
            self.account = self.liquid.take_account()


def _liquid(scene: Scene, data: mujoco.MjData) -> Liquid:
    """Return all that the contents of a scene are, still empty."""
    things = with_mounted(scene.pieces)
    vessels = [thing for thing in things if isinstance(thing, Fillable | Dispenser | Intake)]
    contents, model, base = list(scene.contents.values()), scene.model, scene.robot.base
    driven = None if base is None else model.body(base.body).id
    robot = Carrier(model.body(ROBOT_MOUNT).id, driven)
    return Liquid(model, data, vessels, contents, scene.particles, robot, scene.answers)
