"""A display: a dark pane whose texture shows what an instrument reads, live."""

from dataclasses import dataclass
from functools import lru_cache
from typing import override

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world.model import VISUAL_GROUP

_ROWS = 48
"""Height of a texture [pixels]."""
_DARK, _LIT = (9, 14, 17), (150, 235, 220)
"""Colours of a vacuum fluorescent display; ours."""


@dataclass(frozen=True)
class Display(Process):
    """A pane that shows a line of text.

    Attributes:
        name: Name of its geom, of its texture and of its material.
        size: Width and height [m].
        of: The process whose text it shows.
        ink: Colour of the text, red, green, blue, 0 to 255.
        paper: Colour behind it.
    """

    name: str
    size: tuple[float, float]
    of: Process
    ink: tuple[int, int, int] = _LIT
    paper: tuple[int, int, int] = _DARK

    @property
    @override
    def displayed(self) -> tuple[str, ...]:
        return (self.of.name,)

    @override
    def show(self, apparatus: Apparatus) -> None:
        text = self.of.text(apparatus)
        apparatus.paint(self.name, text, lambda: self.picture(text))

    def add_to(
        self, spec: mujoco.MjSpec, panel: mujoco.MjsBody, pos: Vector, quat: Quaternion
    ) -> None:
        """Build it onto a panel.

        Args:
            spec: What the panel is in.
            panel: What carries it.
            pos: Its middle, just above the surface of the panel [m].
            quat: Orientation in the panel's frame, scalar-first: z into the panel, x up.
        """
        wide, high = self.size
        texture = spec.add_texture(
            name=self.name,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            width=self.pixels[0],
            height=self.pixels[1],
            nchannel=3,
        )
        texture.data = self.picture("").tobytes()
        material = spec.add_material(name=self.name, specular=0.3, shininess=0.6, emission=0.6)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = self.name
        turn = Rotation.from_quat(quat, scalar_first=True)
        corners = [(-high, -wide), (-high, wide), (high, wide), (high, -wide)]  # from lower left
        vertices = turn.apply([(x / 2, y / 2, 0.0) for x, y in corners])
        spec.add_mesh(
            name=self.name,
            uservert=vertices.ravel(),
            usernormal=np.tile(turn.apply((0.0, 0.0, -1.0)), 4),
            usertexcoord=[0, 0, 1, 0, 1, 1, 0, 1],
            userface=[0, 1, 2, 0, 2, 3],
            userfacenormal=[0, 1, 2, 0, 2, 3],
            userfacetexcoord=[0, 1, 2, 0, 2, 3],
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        panel.add_geom(
            name=self.name,
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=self.name,
            material=self.name,
            pos=pos,
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height of the texture [pixels]."""
        return round(_ROWS * self.size[0] / self.size[1]), _ROWS

    def picture(self, text: str) -> NDArray[np.uint8]:
        """Return the texture that shows a text, shape (height, width, 3)."""
        return _picture(text, self.pixels, self.ink, self.paper)


@lru_cache(maxsize=256)
def _picture(
    text: str, pixels: tuple[int, int], ink: tuple[int, int, int], paper: tuple[int, int, int]
) -> NDArray[np.uint8]:
    picture = Image.new("RGB", pixels, paper)
    wide, high = pixels
    size = 0.8 * high
    draw = ImageDraw.Draw(picture)
    while draw.textlength(text, ImageFont.load_default(size)) > 0.92 * wide:
        size *= 0.94
    font = ImageFont.load_default(size)
    draw.text((0.95 * wide, 0.5 * high), text, fill=ink, font=font, anchor="rm")
    return np.asarray(picture)[::-1].copy()  # textures begin at the lower edge
