"""Disk space of a recording, checked before anything is played."""

import shutil
from collections.abc import Mapping

from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.pictures import COLOR, camera_and_kind, picture_names
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import DEPTH, SEGMENTATION, Setting
from labutopia_lerobot.world import CONTROL_HZ

_BYTES_PER_PIXEL = {COLOR: 0.03, DEPTH: 0.3, SEGMENTATION: 0.06}
"""Size of a video per pixel and frame; of `level1/pick` at 256 pixels 0.016 to 0.020 were measured,
of its depth and segmentation 0.21 and 0.03 (camera front)."""

_BYTES_PER_FRAME = 600
"""Size of the tables per frame, as they are put aside: about 150 numbers of four bytes."""

_SHARE_OF_LIMIT = 0.6
"""Length of a demonstration as a share of its time limit: 0.2 to 0.7 by docs/tasks.md."""


class NoSpaceError(UserError):
    """The disk is too small for the recording; the message says what it takes."""


def expected_frames(setting: Setting, episodes: int) -> float:
    """Return about how many frames demonstrations have, before they are played."""
    seconds = _SHARE_OF_LIMIT * canonical_task(setting).time_limit_s
    return max(episodes, 0) * seconds * CONTROL_HZ


def needed_bytes(config: RecordingConfig, missing: Mapping[str, int]) -> int:
    """Return about how many bytes a recording takes on the disk at its peak.

    Args:
        config: Options of the recording.
        missing: Task -> how many demonstrations are still to be played.
    """
    total = 0.0
    for task, episodes in missing.items():
        setting = config.setting(task)
        kinds = [camera_and_kind(name)[1] for name in picture_names(setting)]
        a_pixel = sum(_BYTES_PER_PIXEL[kind] for kind in kinds)
        a_frame = a_pixel * setting.width * setting.height + _BYTES_PER_FRAME
        # What is played, and all of it put together.
        total += a_frame * (
            expected_frames(setting, episodes) + expected_frames(setting, config.episodes)
        )
    return int(total)


def require_space(config: RecordingConfig, missing: Mapping[str, int]) -> None:
    """Make sure that a recording has room.

    Args:
        config: Options of the recording.
        missing: Task -> how many demonstrations are still to be played.

    Raises:
        NoSpaceError: If there is too little.
    """
    folder = next(path for path in (config.folder, *config.folder.parents) if path.exists())
    free = shutil.disk_usage(folder).free
    needed = needed_bytes(config, missing)
    if needed > free:
        raise NoSpaceError(
            f"The recording takes about {size_text(needed)}, but {folder} has "
            f"{size_text(free)} free. Make room, choose another root=, or record fewer "
            "episodes=, cameras=, extras= or pixels"
        )


def size_text(size: float) -> str:
    """Return a size [bytes] in words."""
    return f"{size / 1e9:.1f} GB" if size >= 1e8 else f"{size / 1e6:.0f} MB"
