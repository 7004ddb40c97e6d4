"""A strip of pictures: the first episode at a glance, a row per camera."""

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.datasets.declaration import IMAGES
from labutopia_lerobot.datasets.description import VIDEO
from labutopia_lerobot.datasets.tables import read_episodes, video_file
from labutopia_lerobot.pictures import COLOR, camera_and_kind
from labutopia_lerobot.runtime.video import read_frames

STRIP = "assets/strip.jpg"
"""Path of the strip in a repository."""

_PICTURES = 6
_HEIGHT = 128
"""Height of a picture in the strip [pixels]."""


def picture_strip(root: Path, info: dict[str, Any]) -> bytes | None:
    """Return pictures of the first episode at equal times as a JPEG, or None without cameras.

    Args:
        root: Folder of the dataset.
        info: LeRobot's description of it.
    """
    first = read_episodes(root)[0]
    wanted = np.linspace(0, first["length"] - 1, _PICTURES).round().astype(int).tolist()
    videos = [
        video_file(root, first, key)
        for key, feature in info["features"].items()
        if feature["dtype"] == VIDEO and camera_and_kind(key.removeprefix(IMAGES))[1] == COLOR
    ]
    if not videos:
        return None
    rows = [[_small(picture) for _, picture in read_frames(v, 0, wanted)] for v in videos]
    strip = BytesIO()
    Image.fromarray(np.vstack([np.hstack(row) for row in rows])).save(strip, "JPEG", quality=85)
    return strip.getvalue()


def _small(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    height, width, _ = picture.shape
    size = round(width * _HEIGHT / height), _HEIGHT
    return np.asarray(Image.fromarray(picture).resize(size))
