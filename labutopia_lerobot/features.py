"""The one declaration of what is observed and commanded.

The environment's spaces, LeRobot's `EnvConfig.features` and the dataset's features are all made
from what is here, so that keys, shapes and order cannot diverge. Imports neither mujoco nor torch.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from labutopia_lerobot.pictures import FARTHEST_M, camera_and_kind, picture_names
from labutopia_lerobot.robots import Robot, load_robot
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.scenario.privileged_state import displayed_by, environment_state_names
from labutopia_lerobot.setting import (
    DEPTH,
    DISPLAYS,
    DRIFT,
    FORCES,
    READINGS,
    ROBOT_NAMES,
    SCAN,
    Setting,
    UnknownOptionError,
)
from labutopia_lerobot.task import Task
from labutopia_lerobot.world import (
    LEFT_PAD,
    RIGHT_PAD,
    World,
)
from labutopia_lerobot.world.reading import observed_of_reading

_LARGEST = 10.0
"""No observed number is larger: angles [rad], positions in the room [m], cosines."""

_LARGEST_ROOM = 50.0
"""No room is longer [m]."""

_DEPTH_PATH = "images."
"""Prefix of depths in the environment's observation; the name of the picture follows."""


@dataclass(frozen=True)
class Feature:
    """One array that is observed or commanded.

    Attributes:
        key: What LeRobot's policies and datasets call it.
        dtype: Name of its NumPy type; `uint8` for pictures but depth, else `float32`.
        shape: Its shape for one environment at one time.
        names: What its elements are called; for a picture, what its axes are.
        low: No element is smaller.
        high: No element is larger.
    """

    key: str
    dtype: str
    shape: tuple[int, ...]
    names: tuple[str, ...]
    low: float = -_LARGEST
    high: float = _LARGEST

    @property
    def is_picture(self) -> bool:
        """Whether it is a picture (height, width, channels), not a row of numbers."""
        return len(self.shape) == 3

    @property
    def is_depth(self) -> bool:
        """Whether it is a picture of distances along the optical axis [m], of one channel."""
        return self.is_picture and self.dtype == "float32"


def _robot_state(robot: Robot) -> Feature:
    """Declare what is observed of a robot; where a base is in the room goes as far as rooms do."""
    largest = _LARGEST if robot.base is None else _LARGEST_ROOM
    names = robot.state_names
    return Feature("observation.state", "float32", (len(names),), names, -largest, largest)


def _scan(robot: Robot) -> Feature:
    """Declare what the laser scanner of a robot sees.

    Raises:
        UnknownOptionError: If it has none.
    """
    scanner = _base_of(robot, f"extras=[{SCAN}]", "has no laser scanner. Leave it out").scanner
    return Feature(
        "observation.scan", "float32", (scanner.beams,), scanner.names, 0.0, scanner.farthest
    )


def _base_of(robot: Robot, asked: str, lacks: str) -> MobileBase:
    """Return the base of a robot.

    Raises:
        UnknownOptionError: If it has none; the message names the robots that have one.
    """
    if robot.base is None:
        having = [name for name in ROBOT_NAMES if load_robot(name).base is not None]
        raise UnknownOptionError(
            f"{asked}: robot={robot.name!r} stands and {lacks}, or a robot that drives: "
            f"{', '.join(having)}"
        )
    return robot.base


ACTION = "action"
"""Key of what is commanded."""


def action_feature(setting: Setting) -> Feature:
    """Declare what is commanded: absolute targets of the robot's elements."""
    names = load_robot(setting.robot).names
    return Feature(ACTION, "float32", (len(names),), names)


def observation_features(setting: Setting, load_task: Callable[[], Task]) -> dict[str, Feature]:
    """Declare what is observed.

    Args:
        setting: Task, robot, observation and the other options.
        load_task: Returns the canonical task; called for `obs="state"` and for readings only,
            since it may import mujoco.

    Returns:
        The path in the environment's observation (`agent_pos`, `environment_state`, `forces`,
        `readings`, `scan`, `pixels/<picture>`, `images.<depth>`) -> the feature.
    """
    robot = load_robot(setting.robot)
    if setting.odometry == DRIFT:
        _base_of(robot, "odometry=drift", "has none. Choose odometry=exact")
    features = {"agent_pos": _robot_state(robot)}
    if setting.obs == "state":
        task = load_task()
        names = environment_state_names(task, setting.hidden)
        for what in setting.hidden:
            if environment_state_names(task, [what]) == environment_state_names(task):
                raise UnknownOptionError(
                    f"hidden=[{what}]: the state of {setting.task} has none. Leave it out"
                )
        # What displays show has no bounds that are known here.
        bounded = DISPLAYS in setting.hidden or not reading_names(task)
        largest = _LARGEST if bounded else np.inf
        features["environment_state"] = Feature(
            "observation.environment_state", "float32", (len(names),), names, -largest, largest
        )
    if FORCES in setting.extras:
        pads = (LEFT_PAD, RIGHT_PAD)
        features[FORCES] = Feature("observation.forces", "float32", (2,), pads, 0.0, np.inf)
    if READINGS in setting.extras:
        names = reading_names(load_task())
        if not names:
            raise UnknownOptionError(
                f"extras=[{READINGS}]: nothing in {setting.task} shows a reading. Leave it out"
            )
        features[READINGS] = Feature(
            "observation.readings", "float32", (len(names),), names, -np.inf, np.inf
        )
    if SCAN in setting.extras:
        features[SCAN] = _scan(robot)
    for name in picture_names(setting):
        key, axes = f"observation.images.{name}", ("height", "width", "channels")
        size = setting.height, setting.width
        if camera_and_kind(name)[1] == DEPTH:
            # LeRobot takes bytes only under `pixels`, and passes on as `observation.<path>` what it
            # does not know.
            features[_DEPTH_PATH + name] = Feature(
                key, "float32", (*size, 1), axes, 0.0, FARTHEST_M
            )
        else:
            features[f"pixels/{name}"] = Feature(key, "uint8", (*size, 3), axes, 0, 255)
    return features


def observed_pictures(observation: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """Return the pictures of an environment's observation by name."""
    depths = {path: value for path, value in observation.items() if path.startswith(_DEPTH_PATH)}
    return {
        **observation.get("pixels", {}),
        **{path.removeprefix(_DEPTH_PATH): value for path, value in depths.items()},
    }


def with_pictures(pictures: Mapping[str, NDArray[Any]]) -> dict[str, Any]:
    """Return the part of an environment's observation that pictures are, given by name."""
    depths = {name for name in pictures if camera_and_kind(name)[1] == DEPTH}
    return {
        "pixels": {name: value for name, value in pictures.items() if name not in depths},
        **{_DEPTH_PATH + name: pictures[name] for name in pictures if name in depths},
    }


def forces(world: World) -> NDArray[np.float32]:
    """Return the sum of the normal forces on each pad at the last physics step [N], shape (2,)."""
    return np.array([world.normal_force(LEFT_PAD), world.normal_force(RIGHT_PAD)], np.float32)


def reading_names(task: Task) -> tuple[str, ...]:
    """Name the elements of `readings`: each that a display of the task shows, and if it settled."""
    shown = dict.fromkeys(name for piece in task.start for name in displayed_by(piece))
    return tuple(each for name in shown for each in observed_of_reading(name))


def readings(world: World, names: tuple[str, ...]) -> NDArray[np.float32]:
    """Return what displays show, in their units, and whether it is settled (`Reading.observed`).

    Args:
        world: The world.
        names: As `reading_names` has them.

    Returns:
        Shape (len(names),).
    """
    return np.array([n for name in names[::2] for n in world.reading(name).observed], np.float32)


def observation_space(features: Mapping[str, Feature]) -> spaces.Dict:
    """Return the space of observations; pictures are a space of their own, `pixels`."""
    boxes = {path: _box(feature) for path, feature in features.items()}
    pictures = {
        path.removeprefix("pixels/"): boxes.pop(path)
        for path in features
        if path.startswith("pixels/")
    }
    return spaces.Dict({**boxes, "pixels": spaces.Dict(pictures)} if pictures else boxes)


def _box(feature: Feature) -> spaces.Space[Any]:
    return spaces.Box(feature.low, feature.high, feature.shape, np.dtype(feature.dtype).type)


def action_space(setting: Setting) -> spaces.Box[np.float32]:
    """Return the space of actions: every element of the robot between its limits."""
    robot = load_robot(setting.robot)
    low, high = np.array(robot.lower, np.float32), np.array(robot.upper, np.float32)
    return spaces.Box(low, high, dtype=np.float32)
