"""Stepping: the one place where time passes."""

from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.layout import Piece, Placement
from labutopia_lerobot.scenes.laboratory import BENCH_HEIGHT
from labutopia_lerobot.sim.scene import PHYSICS_HZ, Scene
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_SUBSTEPS = PHYSICS_HZ // CONTROL_HZ
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
        scene: What was compiled.
        data: MuJoCo's state; positions and contacts in it always belong to the present moment.
        command: Joint targets [rad] and gripper opening [m] in force, shape (8,).
        touched: Groups that touched since the previous control step, shape (groups, groups).
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.data = mujoco.MjData(scene.model)
        count = len(scene.groups)
        self.touched: NDArray[np.bool_] = np.zeros((count, count), dtype=bool)
        robot = scene.robot
        self._home = np.array([*robot.home, robot.gripper_max_opening])
        self.command = self._home.copy()
        self._arm = [scene.model.joint(name).qposadr[0] for name in robot.arm_joints]
        self._fingers = [scene.model.joint(name).qposadr[0] for name in robot.finger_joints]
        self._switches = [switch for piece in scene.pieces for switch in piece.switches]
        self._dark = [scene.model.geom(switch.lamp).rgba.copy() for switch in self._switches]
        self._ramp = np.arange(1, _SUBSTEPS + 1) / _SUBSTEPS
        self._built = scene.model.body_pos.copy()

    def reset(self, layout: Mapping[Piece, Placement]) -> None:
        """Put the robot at home and the things where the layout says, and let them settle."""
        model, data = self.scene.model, self.data
        mujoco.mj_resetData(model, data)
        for piece, placement in layout.items():
            position = np.array([placement.x, placement.y, BENCH_HEIGHT + placement.height])
            quat_wxyz = Rotation.from_euler("z", placement.yaw).as_quat(scalar_first=True)
            if piece.movable:
                data.joint(f"{piece.name}_free").qpos = np.concatenate([position, quat_wxyz])
            else:
                model.body(piece.name).pos = position
                model.body(piece.name).quat = quat_wxyz
            for body, place in placement.swaps:
                model.body(body).pos = self._built[model.body(place).id]
        data.qpos[self._arm] = self._home[:-1]
        data.qpos[self._fingers] = self._home[-1] / 2
        data.ctrl[:] = self._home
        self.command = self._home.copy()
        mujoco.mj_step1(model, data)
        for _ in range(_SETTLE_STEPS):
            self.step(self._home)
        self.start_clock()

    def start_clock(self) -> None:
        """Make now the beginning of the episode."""
        self.data.time = 0.0

    def step(self, command: FloatArray) -> None:
        """Advance by one control period.

        The servo targets move linearly from the old command to the new one, as the interpolator of
        a real arm's controller does; held targets would kick the arm thirty times a second.

        Args:
            command: Joint targets [rad] and gripper opening [m], shape (8,).
        """
        model, data, contact = self.scene.model, self.data, self.data.contact
        group_of_geom = self.scene.group_of_geom
        self.touched[:] = False
        start, change = self.command, command - self.command
        for part in self._ramp:
            data.ctrl[:] = start + part * change
            # The two halves of mj_step, turned round: so that positions are never one step old.
            mujoco.mj_step2(model, data)
            mujoco.mj_step1(model, data)
            if data.ncon:
                first, second = group_of_geom[contact.geom].T
                self.touched[first, second] = True
        self._work_switches()
        self.touched |= self.touched.T
        self.command = np.array(command)

    def _work_switches(self) -> None:
        """Toggle what has been pressed since the last control step, and light the lamps."""
        states = self.data.userdata.reshape(-1, 2)
        for switch, dark, state in zip(self._switches, self._dark, states, strict=True):
            pressed = self.data.joint(switch.button).qpos[0] > switch.travel
            on = bool(state[0]) != (pressed and not state[1])
            state[:] = on, pressed
            self.scene.model.geom(switch.lamp).rgba = switch.lit if on else dark

    def switched_on(self, name: str) -> bool:
        """Tell whether a switch is on."""
        index = [switch.name for switch in self._switches].index(name)
        return bool(self.data.userdata[2 * index])

    @property
    def diverged(self) -> bool:
        """Whether the integration has failed (MuJoCo found a bad position or acceleration)."""
        return any(self.data.warning[kind].number for kind in _DIVERGENCE)

    @property
    def arm_position(self) -> FloatArray:
        """Measured joint angles, shape (7,), radians."""
        position: FloatArray = self.data.qpos[self._arm]
        return position

    @property
    def gripper_opening(self) -> float:
        """Measured distance between the pads [m]."""
        return float(self.data.qpos[self._fingers].sum())

    def state(self) -> FloatArray:
        """Return a copy of the full physics state, from which it continues bit for bit."""
        kind = mujoco.mjtState.mjSTATE_INTEGRATION
        state = np.empty(mujoco.mj_stateSize(self.scene.model, kind))
        mujoco.mj_getState(self.scene.model, self.data, state, kind)
        return state
