"""Episodes of the original LabUtopia, as its collectors write them: HDF5, 60 Hz.

An episode has `camera_N_rgb` (frames, 3, height, width) uint8, `agent_pose` and `actions`
(frames, 8) float32, seven joint angles [rad] and the position of one finger [m], and
`language_instruction`. It is a file (`episode_0000.h5`) or a group of a merged one
(`data_collectors` and the merge script of the original, commit 9c64dd2). An action is the pose that
was measured 1/60 s later, not what was commanded.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import printable

if TYPE_CHECKING:
    import h5py

RATE_HZ = 60
"""Frames per second (the original's physics and rendering step)."""

CAMERAS = {"camera_1_rgb": "front", "camera_2_rgb": "top", "camera_3_rgb": "wrist"}
"""Names of its cameras here: facing the robot, overhead, on the hand."""

_POSE, _ACTIONS, _INSTRUCTION = "agent_pose", "actions", "language_instruction"
_NAVIGATION = {"joint_positions", "robot_position"}
_ELEMENTS = 8
_AT_ONCE = 64
"""Frames that are read together: one chunk of the original's files."""


class OriginalFileError(UserError):
    """A file that is no manipulation episode of the original; the message says what is wrong."""


@dataclass(frozen=True)
class OriginalEpisode:
    """An episode, at half its rate.

    Attributes:
        name: Where it comes from.
        instruction: Instruction of the episode; may be empty (the original's press).
        states: Joint angles [rad] and opening between the pads [m], shape (frames, 8).
        next_states: The same 1/30 s later; what the original has for actions.
    """

    name: str
    instruction: str
    states: NDArray[np.float32]
    next_states: NDArray[np.float32]
    _group: "h5py.Group"

    @property
    def sizes(self) -> dict[str, tuple[int, int]]:
        """Camera -> height and width of its pictures [pixels]."""
        return {CAMERAS[key]: self._group[key].shape[2:] for key in CAMERAS if key in self._group}

    def pictures(self, camera: str) -> Iterator[NDArray[np.uint8]]:
        """Yield the pictures of a camera, each of shape (height, width, 3)."""
        stored = self._group[next(key for key, name in CAMERAS.items() if name == camera)]
        frames = 2 * len(self.states)
        for start in range(0, frames, _AT_ONCE):
            several = stored[start : min(start + _AT_ONCE, frames) : 2]
            yield from np.ascontiguousarray(np.moveaxis(several, 1, -1))


@contextmanager
def open_original(file: Path) -> "Iterator[list[OriginalEpisode]]":
    """Open a file of the original and yield its episodes.

    Raises:
        OriginalFileError: If h5py is not installed, or the file is none of these.
    """
    try:
        import h5py
    except ImportError:
        raise OriginalFileError(
            "h5py is not installed: pip install 'lerobot_env_labutopia[convert]'"
        ) from None
    try:
        opened = h5py.File(file, "r")
    except OSError as error:
        raise OriginalFileError(f"{file} cannot be read as HDF5: {error}") from None
    with opened as root:
        try:
            episodes = _episodes(file, root)
        except (AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
            raise OriginalFileError(f"{file} is damaged: {error}") from None
        yield episodes


def _episodes(file: Path, root: "h5py.File") -> list[OriginalEpisode]:
    _require_own(file, file.name, root)
    groups = (
        {file.name: root}
        if _holds_arrays(root)
        else {f"{file.name}/{name}": group for name, group in root.items()}
    )
    if not groups:
        raise OriginalFileError(f"{file} holds nothing")
    return [_read(file, name, group) for name, group in groups.items()]


def _holds_arrays(group: Any) -> bool:
    return any(hasattr(child, "shape") for child in group.values())


def _read(file: Path, name: str, group: "h5py.Group") -> OriginalEpisode:
    keys = set(group) if hasattr(group, "keys") else set()
    _require_own(file, name, group)
    if _NAVIGATION & keys:
        raise OriginalFileError(
            f"{name} in {file} is of the original's navigation (it has "
            f"{', '.join(sorted(_NAVIGATION & keys))}): only manipulation can be converted"
        )
    missing = {_POSE, _ACTIONS, _INSTRUCTION} - keys
    if missing or not keys & CAMERAS.keys():
        lacks = ", ".join(sorted(missing) or sorted(CAMERAS))
        raise OriginalFileError(f"{name} in {file} lacks {lacks}: it is no episode of the original")
    frames = len(group[_POSE])
    shapes = {key: group[key].shape for key in (_POSE, _ACTIONS)}
    lengths = {key: len(group[key]) for key in keys & CAMERAS.keys()}
    if set(shapes.values()) != {(frames, _ELEMENTS)} or set(lengths.values()) != {frames}:
        raise OriginalFileError(
            f"{name} in {file} does not fit together: {shapes | lengths}; {_POSE} and {_ACTIONS} "
            f"must have the shape (frames, {_ELEMENTS}), and pictures as many frames"
        )
    for key in keys & CAMERAS.keys():
        if group[key].ndim != 4 or group[key].shape[1] != 3 or group[key].dtype != np.uint8:
            raise OriginalFileError(
                f"{name} in {file}: {key} has the shape {group[key].shape} of {group[key].dtype}; "
                "pictures have (frames, 3, height, width) of uint8"
            )
    _require_numbers(name, file, group)
    kept = frames // 2
    if kept < 2:
        raise OriginalFileError(f"{name} in {file} is too short: {frames} frames")
    try:
        stored = group[_INSTRUCTION].asstr()[()]
        instruction = printable(str(stored if isinstance(stored, str) else stored[0]))
    except (IndexError, TypeError, UnicodeDecodeError):
        raise OriginalFileError(f"{name} in {file}: {_INSTRUCTION} is no text") from None
    # An action is the pose one frame on; that of the odd frames is the next pose that is kept.
    return OriginalEpisode(
        name=name,
        instruction=instruction,
        states=_with_opening(group[_POSE][: 2 * kept : 2]),
        next_states=_with_opening(group[_ACTIONS][1 : 2 * kept : 2]),
        _group=group,
    )


def _require_own(file: Path, name: str, group: "h5py.Group") -> None:
    """Make sure that an episode holds its data itself: links lead to other files of the machine.

    Raises:
        OriginalFileError: If it does not.
    """
    import h5py

    if not isinstance(group, h5py.Group):
        return
    for key in group:
        elsewhere = not isinstance(group.get(key, getlink=True), h5py.HardLink)
        if not elsewhere and isinstance(dataset := group[key], h5py.Dataset):
            elsewhere = bool(dataset.external) or dataset.is_virtual
        if elsewhere:
            raise OriginalFileError(
                f"{name} in {file} is refused: {printable(key)} is a link, and its data lie "
                "elsewhere"
            )


def _require_numbers(name: str, file: Path, group: "h5py.Group") -> None:
    for key in (_POSE, _ACTIONS):
        if group[key].dtype.kind not in "fiu" or not np.isfinite(group[key][()]).all():
            raise OriginalFileError(f"{name} in {file}: {key} holds numbers that are not finite")


def _with_opening(poses: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return poses whose last element is the distance between the pads, twice that of a finger."""
    doubled: NDArray[np.float32] = poses.astype(np.float32)
    doubled[:, -1] *= 2.0
    return doubled
