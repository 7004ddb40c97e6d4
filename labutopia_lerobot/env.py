"""The Gymnasium environment of a task; it meets LeRobot's environment contract."""

import operator
from typing import Any

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

from labutopia_lerobot.features import (
    action_space,
    forces,
    observation_features,
    observation_space,
    reading_names,
    readings,
    with_pictures,
)
from labutopia_lerobot.pictures import picture_names
from labutopia_lerobot.scenario import Scenario
from labutopia_lerobot.scenario.privileged_state import (
    ObservedPiece,
    environment_state,
    observed_pieces,
)
from labutopia_lerobot.setting import DENSE, FORCES, READINGS, SCAN, Setting, require_choices
from labutopia_lerobot.sim.dense_reward import advance
from labutopia_lerobot.sim.workcell import Workcell
from labutopia_lerobot.sim.workcells import Workcells
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.task import SUCCESS, TIMEOUT
from labutopia_lerobot.world import CONTROL_HZ

Observation = dict[str, Any]
Info = dict[str, Any]


class LabEnv(gymnasium.Env[Observation, NDArray[np.float32]]):
    """One task in MuJoCo.

    Nothing is compiled and no OpenGL context is made before the first `reset`, so that an instance
    can be made in one process and played in another.

    Observations: `agent_pos` float32, measured joint angles [rad] and gripper opening [m]; of a
    mobile base also its velocities forward and to the left [m/s] and of turning [rad/s], and where
    it is in the room, x, y [m] and heading [rad] (with `odometry="drift"` where it believes to be);
    with `obs="pixels"` also `pixels`, a dict of camera -> (height, width, 3) uint8; with
    `obs="state"` `environment_state`, privileged object poses (see
    `privileged_state.environment_state_names`). Of `extras`, `forces` float32, left and right pad
    [N];
    `readings` float32 (see `features.readings`); `scan` float32, how far the laser scanner of a
    base sees [m], from right to left (see `robots.laser_scanner`); for every camera
     `pixels["<camera>_segmentation"]` uint8, the number of what is seen in all three
    channels (see `sim.segments`), and `images.<camera>_depth` float32, (height, width, 1) [m].

    Actions: float32, absolute targets of the same but where the base is. What acted is
    `info["applied_action"]`.

    Args:
        setting: Task, robot, observation and the other options.
        render_mode: `rgb_array`.

    Raises:
        TaskError: If the task does not have the step of the setting.
        UnknownOptionError: If the task does not have the axes of the setting.
        ImpossibleStartError: If things cannot stand where the task wants them.
        ImpossibleFillingError: If vessels cannot hold what the task puts into them.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": CONTROL_HZ}  # noqa: RUF012 (Gymnasium)

    def __init__(self, setting: Setting, render_mode: str | None = "rgb_array") -> None:
        require_choices("render_mode", [render_mode], self.metadata["render_modes"])
        self.setting = setting
        self.render_mode = render_mode
        self._observed: tuple[ObservedPiece, ...] = ()
        self._workcells = Workcells(setting)
        self._playing: tuple[Workcell, Scenario, int] | None = None
        self._frame: NDArray[np.uint8] | None = None
        self._advance = 0.0
        self._max_episode_steps = self._workcells.task.max_steps
        self.observation_space = observation_space(
            observation_features(setting, lambda: self._workcells.task)
        )
        self.action_space = action_space(setting)

    @property
    def workcell(self) -> Workcell:
        """The work cell that the present episode is played in.

        Raises:
            ResetNeeded: If there is none yet.
        """
        return self._episode[0]

    @property
    def task(self) -> str:
        """The instruction of the present episode, or the canonical one before the first."""
        played = self._playing
        return (self._workcells.task if played is None else played[0].task).instruction

    @property
    def task_description(self) -> str:
        """The same, where LeRobot looks for it."""
        return self.task

    def expert(self, pace: float = 1.0) -> Expert:
        """Return the scripted expert of the present episode; `start` it.

        Args:
            pace: How fast its hand moves, as a share of its usual speeds.

        Raises:
            ResetNeeded: If there is no episode yet.
        """
        return self.workcell.expert(pace=pace)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, Info]:
        """Begin the episode of this seed; without one, the next of Gymnasium's own sequence.

        Args:
            seed: Seed of the episode.
            options: `after`: name of a step; the expert plays up to its end, and the episode begins
                there. What others pass to each other here is ignored.

        Raises:
            TaskError: If there is no such step, or none behind it.
            UnknownOptionError: If a step is played alone, which has its own beginning.
        """
        seed = None if seed is None else operator.index(seed)  # NumPy's integers too, no floats
        super().reset(seed=seed)
        self.seed = int(self.np_random.integers(2**31)) if seed is None else seed
        self._playing = self._workcells.begin(self.seed, (options or {}).get("after"))
        self._observed = observed_pieces(self.workcell.task, self.setting.hidden)
        if self.setting.reward == DENSE:
            self._advance = advance(self.workcell.progress, self.workcell.world)
        return self._observe(), self._info()

    def step(self, action: NDArray[np.float32]) -> tuple[Observation, float, bool, bool, Info]:
        """Command the robot for one control period; the reward is 1 on success, else 0.

        With `reward=dense` it is by how much the episode came further (see `sim.dense_reward`).

        Raises:
            ResetNeeded: If there is no episode yet.
            ValueError: If the action does not have as many elements as the robot.
        """
        progress = self.workcell.progress
        was_over = progress.over
        self.workcell.step(action)
        outcome, info = progress.outcome, self._info()
        if self.setting.reward == DENSE:
            before, self._advance = self._advance, advance(progress, self.workcell.world)
            reward = self._advance - before
        else:
            reward = float(outcome == SUCCESS and not was_over)
        terminated = progress.over and outcome != TIMEOUT
        return self._observe(), reward, terminated, outcome == TIMEOUT, info

    def render(self) -> NDArray[np.uint8]:
        """Return the present picture of the first camera, shape (height, width, 3)."""
        if self._frame is None:
            self._frame = self.workcell.color(self.setting.cameras[0])
        return self._frame.copy()

    def depth(self, camera: str) -> NDArray[np.float32]:
        """Return the distance along a camera's optical axis [m], shape (height, width)."""
        return self.workcell.depth(camera)

    def segmentation(self, camera: str) -> NDArray[np.int32]:
        """Return which body a camera sees, shape (height, width); -1 where it sees none.

        `env.workcell.simulation.scene.model.body(index).name` is the name of a body.
        """
        return self.workcell.segmentation(camera)

    def close(self) -> None:
        """Give the OpenGL contexts back."""
        self._workcells.close()

    def __reduce__(self) -> tuple[type["LabEnv"], tuple[Setting, str | None]]:
        """Be pickled as what it was made of: it begins anew where it arrives."""
        return LabEnv, (self.setting, self.render_mode)

    def environment_state(self) -> NDArray[np.float32]:
        """Return the privileged state (see `privileged_state.environment_state_names`)."""
        return environment_state(self._observed, self.workcell.world)

    @property
    def _episode(self) -> tuple[Workcell, Scenario, int]:
        if self._playing is None:
            raise ResetNeeded(f"There is no episode of {self.setting.task} yet: call reset() first")
        return self._playing

    def _observe(self) -> Observation:
        self._frame = None
        state = self.workcell.simulation.robot_state.astype(np.float32)
        observation: Observation = {"agent_pos": state}
        if self.setting.obs == "state":
            observation["environment_state"] = self.environment_state()
        else:
            pictures = self.workcell.pictures(picture_names(self.setting))
            observation |= with_pictures(pictures)
            self._frame = pictures[self.setting.cameras[0]]
        if FORCES in self.setting.extras:
            observation[FORCES] = forces(self.workcell.world)
        if READINGS in self.setting.extras:
            names = reading_names(self._workcells.task)
            observation[READINGS] = readings(self.workcell.world, names)
        if SCAN in self.setting.extras:
            observation[SCAN] = self.workcell.scan()
        return observation

    def _info(self) -> Info:
        workcell, scenario, failures = self._episode
        drawn = {"seed": self.seed, "drawn": dict(scenario.drawn), "setup_failures": failures}
        return workcell.info() | drawn
