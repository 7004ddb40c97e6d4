"""A strip of pictures: the first episode at a glance, a row per camera."""

from io import BytesIO
from pathlib import Path
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.datasets.tables import read_episodes

STRIP = "assets/strip.jpg"
"""Where it lies in a repository."""

_PICTURES = 6
_HEIGHT = 128
"""Of a picture in the strip [pixels]."""


def picture_strip(root: Path, info: dict[str, Any]) -> bytes | None:
    """Return pictures of the first episode at equal times as a JPEG, or None without cameras.

    Args:
        root: Folder of the dataset.
        info: LeRobot's description of it.
    """
    frames = read_episodes(root)[0]["length"]
    wanted = np.linspace(0, frames - 1, _PICTURES).round().astype(int).tolist()
    rows = [
        np.hstack(
            _pictures(
                root / info["video_path"].format(video_key=key, chunk_index=0, file_index=0), wanted
            )
        )
        for key, feature in info["features"].items()
        if feature["dtype"] == "video"
    ]
    if not rows:
        return None
    strip = BytesIO()
    Image.fromarray(np.vstack(rows)).save(strip, "JPEG", quality=85)
    return strip.getvalue()


def _pictures(video: Path, wanted: list[int]) -> list[NDArray[np.uint8]]:
    """Return some of the first frames of a video, shape (128, width, 3) each."""
    pictures = []
    with av.open(str(video)) as container:
        for index, frame in enumerate(container.decode(video=0)):
            if index in wanted:
                image = Image.fromarray(frame.to_ndarray(format="rgb24"))
                width = round(image.width * _HEIGHT / image.height)
                pictures.append(np.asarray(image.resize((width, _HEIGHT))))
            if index == wanted[-1]:
                break
    return pictures
