"""Do the videos show what the cameras see? Decoded pixels against pixels that are drawn again."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import IMAGES
from labutopia_lerobot.datasets.tables import RENDERER, Row
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.pictures import COLOR, camera_and_kind
from labutopia_lerobot.runtime.video import ENCODINGS, read_frames
from labutopia_lerobot.sim.classic_renderer import opengl_renderer_name

_GRID = 8
"""A picture is compared block by block, on a grid of as many rows and columns."""

TOLERANCE = 4.0
"""Greatest deviation of a picture's blocks, root mean square [levels of 255]. Measured at 256 x
256, 96 x 96 and 64 x 48 pixels, cameras front, top and wrist: compression makes up to 2.8
(`level3/pick`, all axes, 64 x 48; elsewhere 2.5); a mirrored picture at least 2.8 and mostly 4 and
more; exchanged colours at least 9; 5 % less light 6.5; that of another episode of `level1/pick`
mostly 4 (wrist) and 7 (front)."""


PIXELS_TOLERANCE = 1.0
"""Share of a depth's or segmentation's pixels that may differ on another renderer [%], which may
draw the edges of things otherwise: chosen, not measured. On the same one none may: both are
lossless."""


@dataclass(frozen=True)
class Deviation:
    """Deviation of a stored picture from the one drawn again.

    Attributes:
        frame: Its number.
        by: Difference of the blocks of colours [levels of 255], or share of the pixels of a
            depth or segmentation that are others [%].
        allowed: How much of that is allowed.
        text: The same in words.
    """

    frame: int
    by: float
    allowed: float
    text: str


class PictureCheck:
    """Compares frames of an episode's videos with what its cameras see; `look` is called in order.

    Args:
        subject: The dataset.
        row: The episode.
        wanted: Which frames to compare.

    Attributes:
        worst: Feature key -> the picture that deviates most.
    """

    def __init__(self, subject: VerifiedDataset, row: Row, wanted: Collection[int]) -> None:
        self._wanted = frozenset(wanted)
        self._drawn_by = row.get(RENDERER)
        self._decoded = {
            key: _decoded(
                subject.video(row, key), subject.first_frame(row, key), wanted, _kind(key)
            )
            for key in subject.cameras
            if key.startswith(IMAGES)
        }
        self.worst: dict[str, Deviation] = {}

    def look(self, number: int, env: LabEnv) -> None:
        """Compare a frame, if it is wanted, with what the environment shows."""
        if number not in self._wanted:
            return
        drawn = env.workcell.pictures([key.removeprefix(IMAGES) for key in self._decoded])
        for key, frames in self._decoded.items():
            frame, stored = next(frames, (-1, None))
            deviation = self._deviation(
                number, stored if frame == number else None, drawn[key.removeprefix(IMAGES)], key
            )
            if key not in self.worst or deviation.by > self.worst[key].by:
                self.worst[key] = deviation

    def _deviation(
        self, number: int, stored: NDArray[Any] | None, drawn: NDArray[Any], key: str
    ) -> Deviation:
        kind = _kind(key)
        if kind == COLOR:
            by = 255.0 if stored is None else block_difference(stored, drawn)
            text = f"off by {by:.1f} levels, where {TOLERANCE:g} are allowed"
            return Deviation(number, by, TOLERANCE, text)
        by = 100.0 if stored is None else other_pixels(stored, drawn, kind)
        allowed = 0.0 if self._drawn_by == opengl_renderer_name() else PIXELS_TOLERANCE
        text = f"{by:.2g} % of its pixels are others, where {allowed:g} are allowed"
        return Deviation(number, by, allowed, text)


def block_difference(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> float:
    """Return by how much the blocks of two pictures differ, root mean square [levels of 255].

    It is over the means of all blocks, in all channels: what compression does to single pixels
    cancels, what it does to one small bright thing counts little, what stands elsewhere much.

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
    return float(np.sqrt(np.square(means[0] - means[1]).mean()))


def other_pixels(first: NDArray[Any], second: NDArray[Any], kind: str) -> float:
    """Return which share of the pixels of two depths or segmentations are others [%].

    Args:
        first: Shape (height, width, channels).
        second: The same.
        kind: Depth or segmentation; depths are the same within a level.
    """
    if first.shape != second.shape:
        return 100.0
    slack = 0.0 if second.dtype == np.uint8 else ENCODINGS[kind].step
    differ = np.abs(first.astype(float) - second.astype(float)) > slack
    return float(100.0 * differ.any(axis=-1).mean())


def _kind(key: str) -> str:
    return camera_and_kind(key.removeprefix(IMAGES))[1]


def _decoded(
    path: Path, first: int, wanted: Collection[int], kind: str
) -> Iterator[tuple[int, NDArray[Any]]]:
    try:
        yield from read_frames(path, first, wanted, kind)
    except (OSError, ValueError):  # reported by the check of the files
        return
