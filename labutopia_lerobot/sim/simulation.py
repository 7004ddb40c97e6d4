"""Stepping: the one place where time passes."""

from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.layout import Piece, Placement
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.sim.displacement import Displacement, SqueezeBottle
from labutopia_lerobot.sim.scene import Scene
from labutopia_lerobot.substances.filling import Dispenser, Fillable, Filling
from labutopia_lerobot.world import CONTROL_HZ, FloatArray, Pose
from labutopia_lerobot.world.model import PHYSICS_HZ

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
        command: Joint targets [rad] and gripper opening [m] in force, in the order of the robot's
            elements, shape (elements,).
        liquid: The liquid, or None where there is none.
        account: Where it is, as of the last control step.
        touched: Groups that touched since the previous control step, shape (groups, groups).
        rest: Where bodies were after the reset, when all had come to rest: positions, shape
            (bodies, 3), metres, and orientations, shape (bodies, 9), world frame.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.data = mujoco.MjData(scene.model)
        count = len(scene.groups)
        self.touched: NDArray[np.bool_] = np.zeros((count, count), dtype=bool)
        self._drives = Drives(scene.model, scene.robot)
        self._start = np.array(scene.robot.start)
        self.command = self._start.copy()
        self._switches = [switch for piece in scene.pieces for switch in piece.switches]
        self._dark = [scene.model.geom(switch.lamp).rgba.copy() for switch in self._switches]
        self._displacements = [
            Displacement(scene.model, piece)
            for piece in scene.pieces
            if isinstance(piece, SqueezeBottle)
        ]
        self.liquid = _liquid(scene, self.data) if scene.contents else None
        self.account = None if self.liquid is None else self.liquid.take_account()
        self._ramp = np.arange(1, _SUBSTEPS + 1) / _SUBSTEPS
        self._built = scene.model.body_pos.copy()
        self.rest = self.data.xpos.copy(), self.data.xmat.copy()

    def reset(
        self, layout: Mapping[Piece, Placement], displacement: FloatArray | None = None
    ) -> None:
        """Put the robot at home and the things where the layout says, and let them settle.

        Args:
            layout: Where things stand.
            displacement: How far from home the arm starts, shape (joints,), radians.
        """
        model, data, bench = self.scene.model, self.data, self.scene.room.bench
        mujoco.mj_resetData(model, data)
        if self.liquid is not None:
            self.liquid.empty()
        for piece, placement in layout.items():
            position = np.array([placement.x, placement.y, bench.height + placement.height])
            quat_wxyz = Rotation.from_euler("z", placement.yaw).as_quat(scalar_first=True)
            if piece.movable:
                data.joint(f"{piece.name}_free").qpos = np.concatenate([position, quat_wxyz])
            else:
                model.body(piece.name).pos = position
                model.body(piece.name).quat = quat_wxyz
            for body, place in placement.swaps:
                model.body(body).pos = self._built[model.body(place).id]
        start = self._start.copy()
        if displacement is not None:
            start[: len(displacement)] += displacement
        self._drives.place(data.qpos, start)
        self._drives.command(data, start)
        self.command = start
        mujoco.mj_step1(model, data)
        for _ in range(_SETTLE_STEPS):
            self.step(start)
        self._start_displacements()
        self.rest = data.xpos.copy(), data.xmat.copy()
        self.start_clock()

    def fill(self, rng: np.random.Generator) -> None:
        """Fill the vessels where they are, and hold still until all has come to rest."""
        if self.liquid is not None:
            contents = self.scene.contents.items()
            vessels: dict[Fillable | Dispenser, Filling] = {
                piece: held for piece, held in contents if isinstance(piece, Fillable | Dispenser)
            }
            self.liquid.fill(vessels, rng)
            for _ in range(_SETTLE_STEPS):
                self.step(self.command)
            self._start_displacements()

    def start_clock(self) -> None:
        """Make now the beginning of the episode."""
        self.data.time = 0.0

    def _start_displacements(self) -> None:
        for displacement in self._displacements:
            displacement.start(self._remembered(displacement.bottle.name), self.data)
        if self.liquid is not None:
            self.liquid.start_dispensing()

    def step(self, command: FloatArray) -> None:
        """Advance by one control period.

        The servo targets move linearly from the old command to the new one, as the interpolator of
        a real arm's controller does; held targets would kick the arm thirty times a second.

        Args:
            command: Joint targets [rad] and gripper opening [m], shape (elements,).
        """
        model, data, contact = self.scene.model, self.data, self.data.contact
        group_of_geom = self.scene.group_of_geom
        self.touched[:] = False
        start, change = self.command, command - self.command
        for substep, part in enumerate(self._ramp, start=1):
            self._drives.command(data, start + part * change)
            # The two halves of mj_step, turned round: so that positions are never one step old.
            mujoco.mj_step2(model, data)
            mujoco.mj_step1(model, data)
            if data.ncon:
                soft = self.scene.model.ngeom + contact.flex  # no geom, but a flex, has touched
                touching = np.where(contact.geom < 0, soft, contact.geom)
                first, second = group_of_geom[touching].T
                self.touched[first, second] = True
            if self.liquid is not None and substep % (PHYSICS_HZ // self.liquid.hertz) == 0:
                self.liquid.step()
        self._work_switches()
        self._squeeze_bottles()
        if self.liquid is not None:
            self.account = self.liquid.take_account()
        self.touched |= self.touched.T
        self.command = np.array(command)

    def _squeeze_bottles(self) -> None:
        """Let out of every bottle what its wall has displaced since the last control step."""
        for displacement in self._displacements:
            state = self._remembered(displacement.bottle.name)
            displacement.update(state, self.data)
            if self.liquid is not None:
                site = self.data.site(displacement.bottle.spout)
                spout = Pose(site.xpos, site.xmat.reshape(3, 3))
                self.liquid.dispense(displacement.bottle, state[1], spout, 1.0 / CONTROL_HZ)

    def _work_switches(self) -> None:
        """Toggle what has been pressed since the last control step, and light the lamps."""
        for switch, dark in zip(self._switches, self._dark, strict=True):
            state = self._remembered(switch.name)
            pressed = self.data.joint(switch.button).qpos[0] > switch.travel
            on = bool(state[0]) != (pressed and not state[1])
            state[:] = on, pressed
            self.scene.model.geom(switch.lamp).rgba = switch.lit if on else dark

    def switched_on(self, name: str) -> bool:
        """Tell whether a switch is on."""
        return bool(self._remembered(name)[0])

    def displaced(self, name: str) -> float:
        """Return the volume of liquid that has been squeezed out of a bottle [m^3]."""
        return float(self._remembered(name)[1])

    def _remembered(self, name: str) -> FloatArray:
        """Return what is remembered of a switch or bottle, shape (2,), a view."""
        return self.scene.memory.of(self.data, name)

    @property
    def diverged(self) -> bool:
        """Whether the integration has failed (MuJoCo found a bad position or acceleration)."""
        if self.liquid is not None and self.liquid.diverged:
            return True
        return any(self.data.warning[kind].number for kind in _DIVERGENCE)

    @property
    def measured(self) -> FloatArray:
        """Joint angles [rad] and distance between the pads [m], shape (elements,)."""
        return self._drives.measured(self.data)

    def draw_liquid(self) -> None:
        """Find the surface of the liquid, once for all pictures of this moment."""
        if self.liquid is not None and self.scene.liquid is not None:
            vessels = [
                VesselPose(vessel.profile, *self._frame(vessel.name))
                for vessel in self.liquid.vessels
            ]
            liquid, height = self.liquid, self.scene.room.bench.height
            self.scene.liquid.extract(liquid.positions, vessels, height, liquid.amounts)

    def draw_particles(self, scene: mujoco.MjvScene) -> None:
        """Fill a user's scene, as MuJoCo's viewer has one, with the particles of the liquid."""
        if self.liquid is not None and self.scene.liquid is not None:
            self.scene.liquid.draw_particles(scene, self.liquid.positions, self.liquid.amounts)

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

        Contacts of the previous control step are forgotten.
        """
        model, data, kind = self.scene.model, self.data, mujoco.mjtState.mjSTATE_INTEGRATION
        size = mujoco.mj_stateSize(model, kind)
        mujoco.mj_setState(model, data, state[:size], kind)
        mujoco.mj_step1(model, data)
        self.command = self._drives.targets(data)
        if self.liquid is not None:
            self.liquid.restore(state[size:])
            self.account = self.liquid.take_account()


def _liquid(scene: Scene, data: mujoco.MjData) -> Liquid:
    """Return all that the contents of a scene are, still empty."""
    vessels = [piece for piece in scene.pieces if isinstance(piece, Fillable | Dispenser)]
    return Liquid(scene.model, data, vessels, list(scene.contents.values()), scene.particles)
