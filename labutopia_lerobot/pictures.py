"""The pictures that are observed: their names and kinds. Imports neither mujoco nor torch.

A picture is called as its camera is, `front`, or, if it is no colour, `front_depth` and
`front_segmentation`, the former as LeRobot's own robots call theirs. Observations, videos and files
go by these names, and everything else follows from the kind.
"""

from labutopia_lerobot.setting import DEPTH, SEGMENTATION, Setting

COLOR = "color"
"""Red, green and blue, 0 to 255."""

FARTHEST_M = 4.095
"""Depths from here on are stored as this [m]. LeRobot has 12 bits, which hold depth in whole
millimetres so far. Bench and robot are nearer than 3 m to every camera."""

BACKGROUND, ROBOT, LIQUID = "background", "robot", "liquid"
"""Classes 0, 1 and 2 of a segmentation: room and bench; arm and hand; whatever flows, wherever it
is. Things of the task follow, in the order of its start, and then distractors. A vessel
is seen where its glass is, and so hides the liquid behind it, as it does in depth."""


def picture_names(setting: Setting) -> tuple[str, ...]:
    """Name the pictures that are observed: those of all cameras, kind after kind."""
    if setting.obs == "state":
        return ()
    kinds = [kind for kind in (DEPTH, SEGMENTATION) if kind in setting.extras]
    return (*setting.cameras, *(f"{camera}_{kind}" for kind in kinds for camera in setting.cameras))


def camera_and_kind(name: str) -> tuple[str, str]:
    """Return the camera of a picture and what it shows: color, depth or segmentation."""
    camera, _, kind = name.partition("_")
    return camera, kind or COLOR
