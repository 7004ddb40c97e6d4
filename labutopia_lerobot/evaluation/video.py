"""Films of episodes."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.video import VideoWriter


def write_video(file: Path, frames: Sequence[NDArray[np.uint8]]) -> None:
    """Write pictures, shape (height, width, 3) each, as H.264 in MP4 at the control rate."""
    height, width, _ = frames[0].shape
    file.parent.mkdir(parents=True, exist_ok=True)
    with VideoWriter(file, width, height) as video:
        for frame in frames:
            video.add(frame)
