"""Meanings of the features of our datasets, for cards: the key alone does not say the unit."""

from dataclasses import dataclass
from fnmatch import fnmatch


@dataclass(frozen=True)
class Meaning:
    """Meaning of a feature.

    Attributes:
        unit: Of its elements.
        text: One line.
    """

    unit: str
    text: str


_OBJECTS = (
    "per thing its position in the robot's base frame and the first two axes of its frame there, "
    "then its joints, the places of handles, of shuffled parts and where it is to be put back, "
    "whether its lamp is lit, what its displays show and if it is settled, its sizes, how deep its "
    "liquid is and what is dissolved in it, as the names say"
)
_OBJECT_UNITS = "m, rad; axes 1; displays their own"

_MEANINGS = {
    "commanded_action": Meaning("rad; gripper m", "targets as they were commanded"),
    "next.reward": Meaning("1", "1 for the action that brings success, else 0"),
    "next.done": Meaning("", "whether the episode is over after the action"),
    "next.success": Meaning("", "whether it has succeeded after the action"),
    "annotation.step": Meaning("", "step of the task that is being done"),
    "annotation.substep": Meaning("", "substep that has latched last"),
    "annotation.phase": Meaning("", "phase of the expert"),
    "language_*": Meaning("", "LeRobot's language columns"),
    "action": Meaning(
        "rad; gripper m", "targets that acted, after clipping to position and velocity limits"
    ),
    "observation.state": Meaning(
        "rad; gripper m", "joint angles and distance between the pads, measured before the action"
    ),
    "observation.environment_state": Meaning(_OBJECT_UNITS, _OBJECTS),
    "privileged.environment_state": Meaning(
        _OBJECT_UNITS, f"{_OBJECTS}; under a key that no policy of LeRobot takes as input"
    ),
    "observation.forces": Meaning(
        "N", "sum of the normal forces on each pad, at the last physics step before the action"
    ),
    "observation.readings": Meaning(
        "the instrument's", "what displays show before the action, and 1 behind it if settled"
    ),
    "observation.scan": Meaning(
        "m", "distance along each ray of the base's laser scanner before the action, right to left"
    ),
    "observation.images.*_depth": Meaning(
        "m", "distance along the optical axis before the action, in whole millimetres"
    ),
    "observation.images.*_segmentation": Meaning(
        "1", "number of what is seen before the action, in all channels; labutopia/segments names"
    ),
    "observation.images.*": Meaning("0 to 255", "picture before the action, RGB"),
    "timestamp": Meaning("s", "since the episode began"),
    "frame_index": Meaning("1", "frame of the episode"),
    "episode_index": Meaning("1", "episode of the dataset"),
    "index": Meaning("1", "frame of the dataset"),
    "task_index": Meaning("1", "line of meta/tasks.parquet: the instruction"),
}


def meaning(key: str) -> Meaning | None:
    """Return what a feature means, or None for one that is not known here."""
    return next((value for pattern, value in _MEANINGS.items() if fnmatch(key, pattern)), None)
