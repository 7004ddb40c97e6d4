"""Surfaces of a Filament scene that change shape or texture from picture to picture."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing

if TYPE_CHECKING:
    from mujoco import mjrf

_ROUGHNESS = 0.25
"""Roughness of a liquid: still water mirrors lamps, small waves blur them; chosen."""
_CLEAR = 0.3
"""Opacity of clear glass as a part of that of its outline; chosen."""


class FilamentLiquid:
    """The surface of a liquid: a mesh that is new in every picture.

    Args:
        context: Filament's.
        scene: Where it is seen.
        drawing: The liquid.
    """

    def __init__(
        self, context: "mjrf.Context", scene: "mjrf.Scene", drawing: LiquidDrawing
    ) -> None:
        self._context, self._scene, self._drawing = context, scene, drawing
        self._shown: tuple[Any, ...] = ()  # Filament does not keep what it shows

    def update(self) -> None:
        """Show the surface that was extracted last."""
        from mujoco import mjrf

        self.close()
        corners, normals, texels = self._drawing.quads
        if not len(corners):
            return
        uses, kinds = mjrf.VertexAttributeUsage, mjrf.VertexAttributeType
        first = np.arange(0, len(corners), 4, dtype=np.uint32)[:, None]
        triangles = (first + np.array([0, 1, 2, 0, 2, 3], np.uint32)).ravel()
        config = mjrf.MeshConfig(
            max_vertices=len(corners),
            max_indices=len(triangles),
            index_type=mjrf.IndexType.INDEX_TYPE_U32,
            interleaved=False,
            attributes=[
                mjrf.VertexAttribute(
                    usage=uses.VERTEX_ATTRIBUTE_USAGE_POSITION,
                    type=kinds.VERTEX_ATTRIBUTE_TYPE_FLOAT3,
                ),
                mjrf.VertexAttribute(
                    usage=uses.VERTEX_ATTRIBUTE_USAGE_NORMAL,
                    type=kinds.VERTEX_ATTRIBUTE_TYPE_FLOAT3,
                ),
                mjrf.VertexAttribute(
                    usage=uses.VERTEX_ATTRIBUTE_USAGE_UV,
                    type=kinds.VERTEX_ATTRIBUTE_TYPE_FLOAT2,
                ),
            ],
        )
        places = np.zeros((len(corners), 2), np.float32)
        material = mjrf.Material(color=self._drawing.tint, roughness=_ROUGHNESS, metallic=0.0)
        texture = None
        if len(texels):  # one for every quad, in a column
            middles = (np.arange(len(texels)) + 0.5) / len(texels)
            places[:, 1] = np.repeat(middles, 4)
            texture = new_texture(self._context, texels[:, None])
            material.color_texture = texture
        mesh, content = self._context.create_mesh(config), mjrf.MeshData(compute_bounds=True)
        content.set_vertices(config, corners.tobytes() + normals.tobytes() + places.tobytes())
        content.set_indices(config, triangles.tobytes())
        mesh.upload(content)
        surface = self._context.create_renderable(mjrf.RenderableParams(cast_shadow=False))
        surface.set_mesh(mesh, 0, len(triangles))
        surface.set_material(material)
        surface.set_pose(np.zeros(3, np.float32), np.eye(3, dtype=np.float32).ravel())
        surface.set_size(np.ones(3, np.float32))
        self._scene.add_renderable(surface)
        self._shown = (surface, mesh, texture, content)

    def close(self) -> None:
        """Take it out of the scene."""
        if self._shown:
            self._scene.remove_renderable(self._shown[0])
        self._shown = ()


class FilamentPaintings:
    """What processes have painted, on the geoms that show it.

    Args:
        context: Filament's.
        model: What the geoms are in.
    """

    def __init__(self, context: "mjrf.Context", model: mujoco.MjModel) -> None:
        self._context, self._model = context, model
        self._times: dict[int, int] = {}  # texture -> how often it had been painted
        self._textures: dict[int, mjrf.Texture] = {}

    def update(
        self, paintings: Mapping[int, int], shown: Callable[[int], "mjrf.Renderable"]
    ) -> None:
        """Show what has been painted.

        Args:
            paintings: Number of each painted texture -> how often it has been.
            shown: Returns what shows a geom.
        """
        for number, times in paintings.items():
            if self._times.get(number) != times:
                self._times[number] = times
                self._textures[number] = new_texture(self._context, self._pixels(number))
            for geom in self._geoms(number):
                pane = shown(geom)
                material = pane.get_material()
                material.color_texture = self._textures[number]
                pane.set_material(material)

    def _pixels(self, texture: int) -> NDArray[np.uint8]:
        model = self._model
        size = model.tex_height[texture], model.tex_width[texture], model.tex_nchannel[texture]
        first = int(model.tex_adr[texture])
        pixels: NDArray[np.uint8] = model.tex_data[first : first + math.prod(size)]
        return pixels.reshape(size)

    def _geoms(self, texture: int) -> list[int]:
        role = mujoco.mjtTextureRole.mjTEXROLE_RGB
        materials = np.flatnonzero(self._model.mat_texid[:, role] == texture)
        geoms: list[int] = np.flatnonzero(np.isin(self._model.geom_matid, materials)).tolist()
        return geoms


def thin_out(model: mujoco.MjModel, wall: int, shown: "mjrf.Renderable") -> None:
    """Let a wall of clear glass be seen through.

    Its texture says how much by the angle, but of textures Filament takes the colour only; that
    glass mirrors more where it is seen from the side, it knows by itself.
    """
    from mujoco import mjrf

    textured, color = shown.get_material(), model.mat_rgba[model.geom_matid[wall]].copy()
    color[3] *= _CLEAR
    shown.set_material(
        mjrf.Material(color=color, specular=textured.specular, glossiness=textured.glossiness)
    )


def new_texture(context: "mjrf.Context", pixels: NDArray[np.uint8]) -> "mjrf.Texture":
    """Return a texture, from shape (height, width, 3 or 4), the lowest row first."""
    from mujoco import mjrf

    formats = {3: mjrf.PixelFormat.PIXEL_FORMAT_RGB8, 4: mjrf.PixelFormat.PIXEL_FORMAT_RGBA8}
    config = mjrf.TextureConfig()
    config.height, config.width, channels = pixels.shape
    config.format = formats[channels]
    texture = context.create_texture(config)
    content = mjrf.TextureData()
    content.set_image(pixels.tobytes())
    texture.upload(content)
    return texture
