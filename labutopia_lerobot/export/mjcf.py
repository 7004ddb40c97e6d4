"""MJCF: meshes and numbers in one XML file, textures that are drawn in code as PNG beside it."""

from pathlib import Path

import mujoco
import numpy as np

from labutopia_lerobot.export.texture_files import texture_folder, write_texture


def write_mjcf(spec: mujoco.MjSpec, out: Path) -> None:
    """Write a spec.

    Args:
        spec: What to write.
        out: The XML file; textures go into `<stem>_textures` beside it.
    """
    written = spec.copy()
    written.modelfiledir = str(out.parent)  # where it looks for the textures that it names
    folder = texture_folder(out)
    for texture in written.textures:
        if texture.data:  # MuJoCo writes what it can draw itself, and what comes from files
            shape = texture.height, texture.width, texture.nchannel
            pixels = np.frombuffer(texture.data, np.uint8).reshape(shape)
            file = write_texture(out.parent / folder, texture.name, pixels)
            texture.file, texture.data = f"{folder}/{file}", b""
    out.write_text(written.to_xml())
