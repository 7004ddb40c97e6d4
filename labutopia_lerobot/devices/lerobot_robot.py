"""The environment as a LeRobot `Robot`: for policy servers, teleoperation and `lerobot-record`.

Its features are those of our datasets, so that policies and recordings fit. Every `send_action` is
one control period, however long it takes on the clock. An episode that is over stays as it is;
the next begins when an action asks for it (`NEXT_EPISODE`), which a person does while LeRobot's
recorder says "Reset the environment".
"""

import logging
from typing import TYPE_CHECKING, Any

import numpy as np
from lerobot.robots import Robot

from labutopia_lerobot.devices.config_lerobot_robot import LabUtopiaRobotConfig
from labutopia_lerobot.robots import load_robot

if TYPE_CHECKING:
    from labutopia_lerobot.env import LabEnv

NEXT_EPISODE = "next_episode"
"""An action that has this key, and is true there, begins the next episode; it moves nothing."""


class LabUtopiaRobot(Robot):
    """A robot in a simulated laboratory.

    The first episode begins when it is connected: compiling takes seconds, which no recording
    should contain. The thread that connects it has to look at it and move it, as its OpenGL context
    is its own.

    Args:
        config: Options of the environment.
    """

    config_class = LabUtopiaRobotConfig
    name = "labutopia"

    def __init__(self, config: LabUtopiaRobotConfig) -> None:
        super().__init__(config)
        self.config = config
        self._setting = config.setting
        robot = load_robot(self._setting.robot)
        self._names, self._state_names = robot.names, robot.state_names
        self._env: LabEnv | None = None
        self._seed, self._over = config.seed, False

    @property
    def cameras(self) -> dict[str, Any]:
        """Cameras by name, which LeRobot counts."""
        return dict.fromkeys(self._setting.cameras)

    @property
    def observation_features(self) -> dict[str, type | tuple[int, ...]]:
        """Observed features: the elements of the robot, and pictures."""
        size = (self._setting.height, self._setting.width, 3)
        pictures = dict.fromkeys(self._setting.cameras, size)
        return {**dict.fromkeys(self._state_names, float), **pictures}

    @property
    def action_features(self) -> dict[str, type]:
        """Commanded features: absolute targets of the elements [rad or m]."""
        return dict.fromkeys(self._names, float)

    @property
    def is_connected(self) -> bool:
        return self._env is not None

    def connect(self, calibrate: bool = True) -> None:
        """Begin the first episode; a simulated robot needs no calibration."""
        from labutopia_lerobot.env import LabEnv  # here: it imports mujoco

        self._env = LabEnv(self._setting)
        self._begin(self.config.seed)

    @property
    def is_calibrated(self) -> bool:
        return True

    def calibrate(self) -> None:
        """Do nothing: what is measured is exact."""

    def configure(self) -> None:
        """Do nothing: everything stands in the configuration."""

    def get_observation(self) -> dict[str, Any]:
        """Return the elements of the robot [rad or m], and the pictures, of now."""
        state = zip(self._state_names, self._observation["agent_pos"].tolist(), strict=True)
        return {**dict(state), **self._observation["pixels"]}

    def send_action(self, action: dict[str, Any]) -> dict[str, Any]:
        """Command the robot for one control period, and return what acted."""
        command = np.array([float(action[name]) for name in self._names], np.float32)
        if action.get(NEXT_EPISODE):
            self._begin(self._seed + 1)
        elif not self._over:
            self._observation, _, terminated, truncated, info = self._playing.step(command)
            self._over = terminated or truncated
            command = info["applied_action"]
            if self._over:
                logging.info("Episode of seed %d is over: %s", self._seed, info["outcome"])
        return dict(zip(self._names, command.tolist(), strict=True))

    def disconnect(self) -> None:
        """Give everything back."""
        self._playing.close()
        self._env = None

    @property
    def _playing(self) -> "LabEnv":
        if self._env is None:
            raise ConnectionError("connect() comes first")
        return self._env

    def _begin(self, seed: int) -> None:
        self._observation, _ = self._playing.reset(seed=seed)
        self._seed, self._over = seed, False
