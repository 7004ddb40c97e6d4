"""Do the videos show what the cameras see? Decoded pixels against pixels that are drawn again."""

from collections.abc import Collection, Iterator
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import IMAGES
from labutopia_lerobot.datasets.tables import Row
from labutopia_lerobot.datasets.verification.subject import Subject
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.runtime.video import read_frames

_GRID = 8
"""A picture is compared block by block, on a grid of as many rows and columns."""

TOLERANCE = 12.0
"""How far the mean of a block may be off [levels of 255]. Measured in `level1/pick`, cameras front
and wrist: compression makes up to 2.9 at 256 x 256 pixels and up to 8.6 at 64 x 48; a mirrored
picture at least 25 and 14; that of another episode mostly 9 (wrist) and 30 (front)."""


class PictureCheck:
    """Compares frames of an episode's videos with what its cameras see; `look` is called in order.

    Args:
        subject: The dataset.
        row: The episode.
        wanted: Which frames to compare.

    Attributes:
        worst: Feature key -> the frame that is furthest off, and by how much [levels].
    """

    def __init__(self, subject: Subject, row: Row, wanted: Collection[int]) -> None:
        self._wanted = frozenset(wanted)
        self._decoded = {
            key: _decoded(subject.video(row, key), subject.first_frame(row, key), wanted)
            for key in subject.cameras
            if key.startswith(IMAGES)
        }
        self.worst: dict[str, tuple[int, float]] = {}

    def look(self, number: int, env: LabEnv) -> None:
        """Compare a frame, if it is wanted, with what the environment shows."""
        if number not in self._wanted:
            return
        drawn = env.workcell.pictures([key.removeprefix(IMAGES) for key in self._decoded])
        for key, frames in self._decoded.items():
            found, stored = next(frames, (-1, None))
            picture = drawn[key.removeprefix(IMAGES)]
            off = (
                block_difference(stored, picture)
                if found == number and stored is not None
                else 255.0
            )
            if off > self.worst.get(key, (0, -1.0))[1]:
                self.worst[key] = (number, off)


def block_difference(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> float:
    """Return by how much two pictures differ where they differ most [levels of 255].

    It is the greatest difference between the means of a block of pixels, in any channel: what
    compression does to single pixels cancels, what stands elsewhere does not.

    Args:
        first: Shape (height, width, 3).
        second: The same.
    """
    if first.shape != second.shape:
        return 255.0
    means = [
        cv2.resize(p.astype(np.float32), (_GRID, _GRID), interpolation=cv2.INTER_AREA)
        for p in (first, second)
    ]
    return float(np.abs(means[0] - means[1]).max())


def _decoded(
    path: Path, first: int, wanted: Collection[int]
) -> Iterator[tuple[int, NDArray[np.uint8]]]:
    try:
        yield from read_frames(path, first, wanted)
    except (OSError, ValueError):  # told by the check of the files
        return
