"""Textures as PNG files beside what uses them."""

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image


def texture_folder(out: Path) -> str:
    """Return the name of the folder for the textures of an exported file, beside it."""
    return f"{out.stem}_textures"


def write_texture(folder: Path, name: str, pixels: NDArray[np.uint8]) -> str:
    """Write a texture and return the name of its file.

    Args:
        folder: Where to; made if there is none.
        name: Of the texture.
        pixels: Shape (height, width, channels), the lowest row first, as MuJoCo has them.
    """
    folder.mkdir(exist_ok=True)
    file = re.sub(r"[^\w.-]", "_", name) + ".png"
    upright = pixels[::-1]
    Image.fromarray(upright[..., 0] if upright.shape[2] == 1 else upright).save(folder / file)
    return file
