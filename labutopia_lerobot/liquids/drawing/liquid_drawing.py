"""Drawing a liquid in MuJoCo's pictures: its surface as a skin that is new in every frame.

MuJoCo sends the vertices of a skin to OpenGL for every picture, and how many of them and of its
faces count can be set in the scene. The skin made here has four vertices of its own for every quad,
so that its list of faces never changes, and room for the surface of all particles as separate
drops. `mjr_uploadMesh`, the other way to draw a mesh that changes, costs as much by itself as
drawing the skin does, and a sphere per particle several times as much as the whole picture.

Where there are several substances, or particles have colours of their own, every quad of the skin
has a texel of its own, and the texture is new in every frame too. One substance needs no texture.
"""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.column import Column, column_surface
from labutopia_lerobot.liquids.drawing.heap import Heap, heap_colors, heap_surface
from labutopia_lerobot.liquids.drawing.sediment import Sediment, sediment_surface
from labutopia_lerobot.liquids.drawing.surface import (
    LiquidSurface,
    VesselPose,
    liquid_surface,
    together,
)
from labutopia_lerobot.liquids.drawing.surface_colors import REACH, colors_at
from labutopia_lerobot.substances.substance import Color
from labutopia_lerobot.world.model import SKIN_GROUP

QUADS_PER_PARTICLE = 64
"""Room in the skin: a drop of one particle has 39 quads on average (of 300 measured) and 54 at
most (of 2,000), and particles that touch have fewer."""

_SPECULAR, _SHININESS = 0.6, 0.9
_BALL = (3 / (4 * np.pi)) ** (1 / 3)  # radius of the ball with the volume of a cube of edge 1
_PAINTED = 0.99
"""Opacity that particles with colours of their own are drawn with, of which a texel has a part:
MuJoCo does not blend what is quite opaque."""
_FAR = 100.0  # where liquids are, to the sorting of transparent things [m]


class LiquidDrawing:
    """One liquid as it is drawn: made with a scene's specification, used after its compilation.

    Drawing takes four calls: `add_to` at compile time, `extract` once per frame, and `draw` and
    `upload` once per picture, after the scene was updated. Without any skin, `draw_particles` shows
    balls.

    Attributes:
        name: Name of the liquid, of its skin and of its body, by which segmentation calls it.
        colors: Colour and opacity of every substance, shape (substances, 4); MuJoCo blends every
            transparent face twice.
        spacing: Edge of the cube that has a particle's volume [m].
    """

    def __init__(
        self, name: str, colors: Sequence[Color], spacing: float, capacity: int, painted: bool
    ) -> None:
        self.name = name
        self.spacing = spacing
        self.colors: NDArray[np.float64] = np.array(colors, dtype=float)
        self._textured = painted or len(colors) > 1
        most = _PAINTED if painted else self.colors[:, 3].max()
        plain = (1.0, 1.0, 1.0, most) if self._textured else self.colors[0]
        self._tint = np.array(plain, np.float32)
        self._capacity = capacity
        self._texels: NDArray[np.uint8] = np.zeros((0, 4), np.uint8)
        self._corners: NDArray[np.float32] = np.zeros((0, 3), np.float32)
        self._normals: NDArray[np.float32] = np.zeros((0, 3), np.float32)

    @classmethod
    def add_to(
        cls,
        spec: mujoco.MjSpec,
        name: str,
        colors: Sequence[Color],
        spacing: float,
        particles: int,
        skin: bool = True,
        painted: bool = False,
    ) -> "LiquidDrawing":
        """Make room for a liquid in a scene: an empty body, and a skin that hangs on it.

        Args:
            spec: Of the scene.
            name: Not yet the name of a body or a skin.
            colors: Red, green, blue and opacity, 0 to 1, of every substance.
            spacing: Edge of the cube that has a particle's volume [m].
            particles: The most that are ever drawn.
            skin: Whether there is a skin: without, `draw` and `upload` draw nothing; see `quads`.
            painted: Whether particles have other colours than those of the substances.
        """
        spec.worldbody.add_body(name=name)
        quads = QUADS_PER_PARTICLE * particles
        drawing = cls(name, colors, spacing, quads, painted)
        if not skin:
            return drawing
        vertices = np.arange(4 * quads, dtype=np.int32)
        first = vertices[::4, None]
        added = spec.add_skin(
            name=name,
            group=SKIN_GROUP,
            vert=np.zeros(3 * len(vertices), np.float32),
            face=(first + np.array([0, 1, 2, 0, 2, 3], np.int32)).ravel(),
            bodyname=[name],
            bindpos=np.zeros(3),
            bindquat=np.array([1.0, 0.0, 0.0, 0.0]),
            vertid=[vertices],
            vertweight=[np.ones(len(vertices), np.float32)],
        )
        if drawing._textured:
            side = int(np.ceil(np.sqrt(quads)))
            kind = mujoco.mjtTexture.mjTEXTURE_2D
            texture = spec.add_texture(name=name, type=kind, nchannel=4, width=side, height=side)
            texture.data = bytes(4 * side * side)
            spec.add_material(name=name).textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
            quad = np.arange(quads)
            middles = (np.column_stack([quad % side, quad // side]) + 0.5) / side
            added.texcoord = np.repeat(middles, 4, axis=0).astype(np.float32).ravel()
            added.material = name
        return drawing

    def extract(
        self,
        positions_w: NDArray[np.float64],
        vessels: Sequence[VesselPose],
        bench_height: float,
        colors: NDArray[np.float64] | None = None,
        columns: Sequence[Column] = (),
        heaps: Sequence[Heap] = (),
        sediments: Sequence[Sediment] = (),
    ) -> LiquidSurface:
        """Find the surface that the next pictures show, and return it.

        Args:
            positions_w: The particles, shape (n, 3), metres, world frame.
            vessels: All that may hold some of the liquid.
            bench_height: Height of the bench top [m].
            colors: Colour and opacity of every particle, shape (n, 4); all is the first substance
                if not said.
            columns: What stands in narrow tubes.
            heaps: Crystals that lie on bottoms; only where particles have colours of their own.
            sediments: What has settled on bottoms; likewise.

        Raises:
            RuntimeError: There are more particles than `add_to` was given.
        """
        surface = liquid_surface(positions_w, self.spacing, vessels, bench_height)
        loose = len(surface.quads)
        # What is drawn last is seen through all that was drawn before.
        standing = [column_surface(column) for column in columns]
        settled = [sediment_surface(sediment) for sediment in sediments]
        lying = [heap_surface(heap) for heap in heaps]
        surface = together([surface, *standing, *settled, *lying])
        if len(surface.quads) > self._capacity:
            raise RuntimeError(
                f"The surface of {len(positions_w)} particles of {self.name} has "
                f"{len(surface.quads)} quads; there is room for {self._capacity}"
            )
        self._corners = surface.vertices_w[surface.quads.ravel()]
        self._normals = surface.normals_w[surface.quads.ravel()]
        if self._textured:
            middles = surface.vertices_w[surface.quads[:loose]].mean(axis=1)
            plain = [*(one.color for one in columns), *(one.color for one in sediments)]
            colors = self._colors(len(positions_w), colors)
            texels = np.vstack(
                [
                    colors_at(middles, positions_w, colors, REACH * self.spacing),
                    *(
                        np.tile(color, (len(one.quads), 1))
                        for color, one in zip(plain, [*standing, *settled], strict=True)
                    ),
                    *(heap_colors(heap) for heap in heaps),
                ]
            )
            # The picture is drawn with the greatest opacity, of which a texel has a part.
            texels[:, 3] = np.minimum(texels[:, 3] / self._tint[3], 1.0)
            self._texels = np.rint(255 * texels).astype(np.uint8)
        return surface

    def _colors(self, count: int, colors: NDArray[np.float64] | None) -> NDArray[np.float64]:
        """Return the colour of every particle, shape (n, 4)."""
        return np.tile(self.colors[0], (count, 1)) if colors is None else colors

    def draw(self, scene: mujoco.MjvScene, model: mujoco.MjModel) -> None:
        """Put the surface into an updated scene.

        Args:
            scene: To be rendered next.
            model: What `add_to`'s specification was compiled to.
        """
        skin = model.skin(self.name).id
        start, count = 3 * scene.skinvertadr[skin], len(self._corners)
        scene.skinvert[start : start + 3 * count] = self._corners.ravel()
        scene.skinnormal[start : start + 3 * count] = self._normals.ravel()
        scene.skinvertnum[skin] = count
        scene.skinfacenum[skin] = count // 2
        if not count:
            return
        geom = scene.geoms[scene.ngeom]
        # Transparent geoms are drawn in the order of their distance. A liquid has none of its own,
        # it is in many places: beyond everything, it lies behind all glass, as in a vessel it does.
        head, ahead = scene.camera[0].pos, scene.camera[0].forward
        mujoco.mjv_initGeom(
            geom,
            mujoco.mjtGeom.mjGEOM_SKIN,
            np.zeros(3),
            np.array(head + _FAR * ahead, float),
            np.eye(3).ravel(),
            self.tint,
        )
        geom.objtype, geom.objid = mujoco.mjtObj.mjOBJ_SKIN, skin
        geom.category = mujoco.mjtCatBit.mjCAT_DYNAMIC
        geom.specular, geom.shininess = _SPECULAR, _SHININESS
        geom.segid = scene.ngeom
        if self._textured:
            geom.matid, geom.texcoord = model.material(self.name).id, 1
        scene.ngeom += 1

    @property
    def quads(self) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.uint8]]:
        """The surface that was extracted last.

        Corners, four for every quad, shape (4 quads, 3), metres, world frame; their normals; the
        share that every quad has of `tint`, shape (quads, 4), 0 to 255, empty for one substance.
        """
        return self._corners, self._normals, self._texels

    @property
    def tint(self) -> NDArray[np.float32]:
        """Colour that the surface is drawn with, shape (4,): its own, or that of full texels."""
        return self._tint

    def upload(self, model: mujoco.MjModel, context: mujoco.MjrContext) -> None:
        """Send the colours of particles to OpenGL, whose context must be current."""
        if self._textured and len(self._texels):
            texture = model.texture(self.name).id
            start = model.tex_adr[texture]
            texels = self._texels.ravel()
            model.tex_data[start : start + len(texels)] = texels
            mujoco.mjr_uploadTexture(model, context, texture)

    def draw_particles(
        self,
        scene: mujoco.MjvScene,
        positions_w: NDArray[np.float64],
        colors: NDArray[np.float64] | None = None,
    ) -> None:
        """Fill a scene with a ball for every particle, for viewers that draw no changing skin.

        Args:
            scene: That of the viewer's user; what was in it goes.
            positions_w: The particles, shape (n, 3), metres, world frame.
            colors: As in `extract`.
        """
        size = np.array([_BALL * self.spacing, 0.0, 0.0])
        scene.ngeom = len(positions_w)
        every = self._colors(len(positions_w), colors).astype(np.float32)
        for geom, position, color in zip(scene.geoms, positions_w, every, strict=False):
            kind = mujoco.mjtGeom.mjGEOM_SPHERE
            mujoco.mjv_initGeom(geom, kind, size, position, np.eye(3).ravel(), color)
