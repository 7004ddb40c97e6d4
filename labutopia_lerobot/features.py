"""The one declaration of what is observed and commanded.

The environment's spaces, LeRobot's `EnvConfig.features` and the dataset's features are all made
from what is here, so that keys, shapes and order cannot diverge. Imports neither mujoco nor torch.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from labutopia_lerobot.options import UnknownOptionError, require_choices
from labutopia_lerobot.substances.filling import Fillable
from labutopia_lerobot.task import Task

STATE_NAMES = (*(f"joint{number}" for number in range(1, 8)), "gripper")
"""Elements of state and action: seven joint angles [rad], distance between the pads [m]."""

CAMERAS = ("front", "top", "wrist")
"""Every camera of a scene: facing the robot, overhead, on the hand."""

IMAGE_SIZE = 256
"""Width and height of a picture by default [pixels] (paper, "Model Input And Output")."""

OBSERVATION_KINDS = ("pixels", "state")
"""`pixels`: cameras and `agent_pos`. `state`: `agent_pos` and privileged `environment_state`."""

_POSE_NAMES = ("x", "y", "z", "xx", "xy", "xz", "yx", "yy", "yz")


@dataclass(frozen=True)
class Feature:
    """One array that is observed or commanded.

    Attributes:
        key: What LeRobot's policies and datasets call it.
        dtype: Name of its NumPy type; `uint8` for pictures, else `float32`.
        shape: Its shape for one environment at one time.
        names: What its elements are called; for a picture, what its axes are.
    """

    key: str
    dtype: str
    shape: tuple[int, ...]
    names: tuple[str, ...]

    @property
    def is_picture(self) -> bool:
        """Whether it is a picture (height, width, 3), not a row of numbers."""
        return self.dtype == "uint8"


def _numbers(key: str, names: tuple[str, ...]) -> Feature:
    return Feature(key, "float32", (len(names),), names)


ACTION = _numbers("action", STATE_NAMES)
"""What is commanded: absolute targets of the state."""


def observation_features(
    load_task: Callable[[], Task],
    obs: str = "pixels",
    cameras: Sequence[str] = CAMERAS,
    width: int = IMAGE_SIZE,
    height: int = IMAGE_SIZE,
) -> dict[str, Feature]:
    """Declare what is observed.

    Args:
        load_task: Returns the task; called for `obs="state"` only, since it may import mujoco.
        obs: `pixels` or `state`.
        cameras: Which cameras `obs="pixels"` has.
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].

    Returns:
        The path in the environment's observation (`agent_pos`, `environment_state`,
        `pixels/<camera>`) -> the feature.

    Raises:
        UnknownOptionError: If `obs` or a camera is unknown, or no camera is named.
    """
    require_choices("obs", [obs], OBSERVATION_KINDS)
    require_choices("cameras", cameras, CAMERAS)
    if not cameras:
        raise UnknownOptionError(f"cameras names none. Choose from: {', '.join(CAMERAS)}")
    features = {"agent_pos": _numbers("observation.state", STATE_NAMES)}
    if obs == "state":
        names = environment_state_names(load_task())
        features["environment_state"] = _numbers("observation.environment_state", names)
        return features
    axes = ("height", "width", "channels")
    for camera in cameras:
        key = f"observation.images.{camera}"
        features[f"pixels/{camera}"] = Feature(key, "uint8", (height, width, 3), axes)
    return features


def environment_state_names(task: Task) -> tuple[str, ...]:
    """Name the elements of `environment_state`.

    For each thing its position [m] in the robot's base frame and the first two axes of its frame
    there: the continuous representation of rotations (Zhou et al. 2019, "On the Continuity of
    Rotation Representations in Neural Networks"), since quaternions jump. Then the position of each
    of its hinges [rad] and slides [m], and the place [m] of each of its parts that is shuffled.
    Where there is liquid: how deep it would be in each vessel [m], were that upright.
    """
    return tuple(
        name
        for piece, region in task.start.items()
        for name in (
            *(f"{piece.name}.{part}" for part in _POSE_NAMES),
            *piece.joints,
            *(f"{body}.{axis}" for body in region.shuffled for axis in "xyz"),
            *([f"{piece.name}.fill"] if task.contents and isinstance(piece, Fillable) else []),
        )
    )
