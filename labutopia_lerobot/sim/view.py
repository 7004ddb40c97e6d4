"""The read-only world that predicates, skills and observations look at."""

import mujoco
import numpy as np

from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.world import FloatArray, LiquidAccount, Manipulator, Pose, Thing


class SimulatedWorld:
    """A `World` onto a simulation; hands out copies only."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        scene = simulation.scene
        self._data = simulation.data
        self._model = scene.model
        self._gripper = scene.model.site(scene.robot.gripper.site).id
        self._group = {name: index for index, name in enumerate(scene.groups)}
        self._bodies = {piece.name: scene.model.body(piece.name).id for piece in scene.pieces}

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
        """What is known of the robot beforehand."""
        return self._simulation.scene.robot

    @property
    def robot_base(self) -> Pose:
        """Base of the robot, x forward, z up."""
        return Pose(np.array(self._simulation.scene.room.robot_stand), np.eye(3))

    @property
    def gripper(self) -> Pose:
        """Frame between the pads: z forward, y along the motion of the fingers."""
        return self._site(self._gripper)

    @property
    def gripper_opening(self) -> float:
        """Distance between the pads [m]."""
        return float(self._simulation.measured[-1])

    @property
    def commanded_opening(self) -> float:
        """Distance between the pads that is commanded [m]."""
        return float(self._simulation.command[-1])

    def pose(self, thing: Thing) -> Pose:
        """Return the frame of a thing: origin at the centre of its base."""
        body = self._bodies[thing.name]
        return Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())

    def frame(self, name: str) -> Pose:
        """Return a named frame."""
        return self._site(self._model.site(name).id)

    def velocity(self, thing: Thing) -> FloatArray:
        """Return the velocity of a thing's centre of mass, shape (3,), m/s, world frame."""
        twist = np.empty(6)  # angular, then linear
        body = mujoco.mjtObj.mjOBJ_BODY
        mujoco.mj_objectVelocity(self._model, self._data, body, self._bodies[thing.name], twist, 0)
        return twist[3:]

    def joint(self, name: str) -> float:
        """Return the position of a named hinge [rad] or slide [m]."""
        return float(self._data.joint(name).qpos[0])

    def sensor(self, name: str) -> float:
        """Return the reading of a named scalar sensor."""
        return float(self._data.sensor(name).data[0])

    def switched_on(self, name: str) -> bool:
        """Tell whether a named switch is on."""
        return self._simulation.switched_on(name)

    def displaced(self, thing: Thing) -> float:
        """Return the volume of liquid that has been squeezed out of a bottle [m^3]."""
        return self._simulation.displaced(thing.name)

    @property
    def liquid(self) -> LiquidAccount | None:
        """Where the liquid is; None where none is simulated."""
        return self._simulation.account

    def touching(self, first: str, second: str) -> bool:
        """Tell whether the two touched since the last control step."""
        return bool(self._simulation.touched[self._group[first], self._group[second]])

    def touched_by(self, name: str) -> frozenset[str]:
        """Return everything that touched it since the last control step."""
        row = self._simulation.touched[self._group[name]]
        return frozenset(self._simulation.scene.groups[index] for index in np.flatnonzero(row))

    def _site(self, site: int) -> Pose:
        return Pose(
            self._data.site_xpos[site].copy(), self._data.site_xmat[site].reshape(3, 3).copy()
        )
