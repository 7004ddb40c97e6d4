"""The Gymnasium environment of a task; it meets LeRobot's environment contract."""

import zlib
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from labutopia_lerobot.action_filter import ActionFilter
from labutopia_lerobot.features import CAMERAS, IMAGE_SIZE, Feature, observation_features
from labutopia_lerobot.layout import Workspace, require_possible, sample_layout
from labutopia_lerobot.liquids.liquid import PARTICLES
from labutopia_lerobot.options import LIQUID, SPLITS, require_choices
from labutopia_lerobot.progress import DIVERGED, SUCCESS, TIMEOUT, Progress
from labutopia_lerobot.registry import load_task
from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.scenes.laboratory import BENCH_X, BENCH_Y, ROBOT_BASE
from labutopia_lerobot.sim.motion import ReactiveMotion
from labutopia_lerobot.sim.renderer import Renderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.substances.filling import Fillable, require_fillable
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_LARGEST = 10.0
"""No observed number is larger: angles [rad], positions in the room [m], cosines."""

_WORKSPACE = Workspace(BENCH_X, BENCH_Y, ROBOT_BASE[:2], PANDA.reach)

_PRELUDE_TRIES = 5
"""Sub-seeds that a reset tries; more failures than that are a defect of the task."""

Observation = dict[str, Any]
Info = dict[str, Any]


class LabEnv(gymnasium.Env[Observation, NDArray[np.float32]]):
    """One task in MuJoCo.

    Nothing is compiled and no OpenGL context is made before the first `reset`, so that an instance
    can be made in one process and played in another.

    Observations: `agent_pos` (8,) float32, measured joint angles [rad] and gripper opening [m];
    with `obs="pixels"` also `pixels`, a dict of camera -> (height, width, 3) uint8; with
    `obs="state"` `environment_state`, privileged object poses (see
    `features.environment_state_names`).

    Actions: (8,) float32, absolute targets of the same eight numbers. What acted, after clipping to
    position and velocity limits, is `info["applied_action"]`.

    Args:
        task: Task id, such as `level1/pick`.
        obs: `pixels` or `state`.
        cameras: Which cameras to draw with `obs="pixels"`.
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].
        split: `train` or `id`.
        tasks_dir: A further folder of tasks.
        liquid: `on`; with `off` vessels are empty, and pouring and spilling are judged by tilts.
        particles: In how many particles the liquid of a task is divided.

    Raises:
        UnknownOptionError: If an argument is not one of its choices.
        UnknownTaskError: If there is no such task.
        ImpossibleStartError: If things cannot stand where the task wants them.
        ImpossibleFillingError: If vessels cannot hold what the task puts into them.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": CONTROL_HZ}  # noqa: RUF012 (Gymnasium)

    def __init__(
        self,
        task: str,
        obs: str = "pixels",
        cameras: tuple[str, ...] = CAMERAS,
        width: int = IMAGE_SIZE,
        height: int = IMAGE_SIZE,
        split: str = "id",
        tasks_dir: str | Path | None = None,
        liquid: str = "on",
        particles: int = PARTICLES,
        render_mode: str = "rgb_array",
    ) -> None:
        require_choices("split", [split], SPLITS)
        require_choices("liquid", [liquid], LIQUID)
        require_choices("render_mode", [render_mode], self.metadata["render_modes"])
        self.task_id = task
        self.definition = load_task(task, tasks_dir, liquid)
        require_fillable(self.definition.contents, self.definition.start)
        require_possible(self.definition.start, _WORKSPACE)
        features = observation_features(lambda: self.definition, obs, cameras, width, height)
        self.task = self.task_description = self.definition.instruction
        self._max_episode_steps = self.definition.max_steps
        self.obs_kind, self.cameras, self.split = obs, tuple(cameras), split
        self.render_mode = render_mode
        self._size = (width, height)
        self._particles = particles
        self._renderer: Renderer | None = None
        self._simulation: Simulation | None = None
        self._motion: ReactiveMotion | None = None
        self._frame: NDArray[np.uint8] | None = None
        self.observation_space = _observation_space(features)
        self.action_space = _action_space()

    @property
    def simulation(self) -> Simulation:
        """The simulation, compiled at first use."""
        if self._simulation is None:
            task = self.definition
            self._simulation = Simulation(
                compile_scene(task.start, PANDA, task.view, task.contents, self._particles)
            )
            self.world = SimulatedWorld(self._simulation)
            self.progress = Progress(self.definition)
            self._filter = ActionFilter(PANDA)
        return self._simulation

    @property
    def renderer(self) -> Renderer:
        """The renderer, whose OpenGL context is made at first use.

        Raises:
            NoOpenGLError: If there is no working OpenGL.
        """
        if self._renderer is None:
            scene = self.simulation.scene
            liquids = [] if scene.liquid is None else [scene.liquid]
            self._renderer = Renderer(scene.model, *self._size, liquids)
        return self._renderer

    def expert(self) -> Expert:
        """Return the scripted expert of the task for this environment; `start` it after a reset."""
        return Expert(self.definition.expert, self.world, self.motion)

    @property
    def motion(self) -> ReactiveMotion:
        """The expert's inverse kinematics, compiled at first use."""
        if self._motion is None:
            self._motion = ReactiveMotion(self.simulation, self.world)
        return self._motion

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, Info]:
        """Begin the episode of this seed; without one, the next of Gymnasium's own sequence."""
        super().reset(seed=seed)
        self.seed = int(self.np_random.integers(2**31)) if seed is None else seed
        names = [zlib.crc32(word.encode()) for word in (self.task_id, self.split)]
        for attempt in range(_PRELUDE_TRIES):
            rng = np.random.default_rng([self.seed, *names, attempt])
            self.simulation.reset(sample_layout(self.definition.start, rng))
            self._filter.start(self.simulation.command)
            if self._play_prelude():
                break
        else:
            raise RuntimeError(
                f"The prelude of {self.task_id} failed {_PRELUDE_TRIES} times with seed {self.seed}"
            )
        self.prelude_failures = attempt
        self.simulation.fill(rng)
        self._filter.start(self.simulation.command)
        self.simulation.start_clock()
        self.progress.start()
        self.progress.update(self.world)
        return self._observe(), self._info()

    def _play_prelude(self) -> bool:
        """Play the task's prelude, if it has one; tell whether all went well."""
        if not self.definition.prelude:
            return True
        expert = Expert(self.definition.prelude, self.world, self.motion)
        expert.start()
        breaches = self.definition.never.values()
        while not expert.finished:
            self.simulation.step(self._filter(expert.act()))
            broken = any(breach.holds(self.world) for breach in breaches)
            if expert.failure or broken or self.simulation.diverged:
                return False
        return True

    def step(self, action: NDArray[np.float32]) -> tuple[Observation, float, bool, bool, Info]:
        """Command the robot for one control period; the reward is 1 on success, else 0.

        Raises:
            ValueError: If the action does not have eight elements.
        """
        self.simulation.step(self._filter(action))
        if self.simulation.diverged:
            self.progress.end(DIVERGED)
        self.progress.update(self.world)
        outcome = self.progress.outcome
        info = self._info()
        terminated = self.progress.over and outcome != TIMEOUT
        return self._observe(), float(outcome == SUCCESS), terminated, outcome == TIMEOUT, info

    def render(self) -> NDArray[np.uint8]:
        """Return the present picture of the first camera, shape (height, width, 3)."""
        if self._frame is None:
            camera = self.cameras[0]
            self.simulation.draw_liquid()
            self._frame = self.renderer.color(self.simulation.data, camera)
        return self._frame

    def depth(self, camera: str) -> NDArray[np.float32]:
        """Return the distance along a camera's optical axis [m], shape (height, width)."""
        return self.renderer.depth(self.simulation.data, camera)

    def segmentation(self, camera: str) -> NDArray[np.int32]:
        """Return which body a camera sees, shape (height, width); -1 where it sees none.

        `env.simulation.scene.model.body(index).name` is the name of a body.
        """
        return self.renderer.segmentation(self.simulation.data, camera)

    def close(self) -> None:
        """Give the OpenGL context back."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _observe(self) -> Observation:
        simulation = self.simulation
        measured = np.append(simulation.arm_position, simulation.gripper_opening)
        observation: Observation = {"agent_pos": measured.astype(np.float32)}
        if self.obs_kind == "state":
            self._frame = None
            observation["environment_state"] = self.environment_state()
        else:
            self.simulation.draw_liquid()
            observation["pixels"] = {
                camera: self.renderer.color(simulation.data, camera) for camera in self.cameras
            }
            self._frame = observation["pixels"][self.cameras[0]]
        return observation

    def environment_state(self) -> NDArray[np.float32]:
        """Return the privileged state (see `features.environment_state_names`)."""
        to_base = self.world.robot_base.inverse()
        parts: list[FloatArray] = []
        for piece, region in self.definition.start.items():
            pose_b = to_base @ self.world.pose(piece)
            joints = np.array([self.world.joint(name) for name in piece.joints])
            shuffled = [(to_base @ self.world.frame(name)).position_w for name in region.shuffled]
            parts += [pose_b.position_w, pose_b.x_axis, pose_b.y_axis, joints, *shuffled]
            if self.world.liquid is not None and isinstance(piece, Fillable):
                volume = self.world.liquid.inside[piece.name]
                parts.append(np.array([piece.profile.depth(volume)]))
        state: NDArray[np.float32] = np.concatenate(parts).astype(np.float32)
        return state

    def _info(self) -> Info:
        progress = self.progress
        latched = progress.substeps.items()
        liquid = self.world.liquid
        return {
            "is_success": progress.outcome == SUCCESS,
            "ever_success": progress.ever,
            "outcome": progress.outcome,
            "facts": {name: bool(holds) for name, holds in progress.facts.items()},
            "substeps": {name: np.inf if time is None else time for name, time in latched},
            **({} if liquid is None else liquid.millilitres),
            "seed": self.seed,
            "prelude_failures": self.prelude_failures,
            "applied_action": self._filter.applied.copy(),
            "clipped_actions": self._filter.clipped,
            "nonfinite_actions": self._filter.nonfinite,
        }


def _observation_space(features: dict[str, Feature]) -> spaces.Dict:
    boxes = {path: _box(feature) for path, feature in features.items()}
    pictures = {
        path.removeprefix("pixels/"): boxes.pop(path)
        for path, feature in features.items()
        if feature.is_picture
    }
    return spaces.Dict({**boxes, "pixels": spaces.Dict(pictures)} if pictures else boxes)


def _box(feature: Feature) -> spaces.Space[Any]:
    if feature.is_picture:
        return spaces.Box(0, 255, feature.shape, np.uint8)
    return spaces.Box(-_LARGEST, _LARGEST, feature.shape, np.float32)


def _action_space() -> spaces.Box[np.float32]:
    low = np.array([*PANDA.joint_lower, 0.0], dtype=np.float32)
    high = np.array([*PANDA.joint_upper, PANDA.gripper_max_opening], dtype=np.float32)
    return spaces.Box(low, high, dtype=np.float32)
