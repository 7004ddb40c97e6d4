"""Pictures of a simulation: colour, metric depth, segmentation.

Depth and segmentation take liquids and glass for what they are, surfaces: neither looks through.
"""

from collections.abc import Sequence
from functools import cache

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.scenes.views import FIXED_CAMERAS, WIDEST_PICTURE
from labutopia_lerobot.sim.contact_shadows import ContactShadows
from labutopia_lerobot.sim.eye import copy_eye, turned_by_pixels
from labutopia_lerobot.sim.gleaming_walls import GleamingWalls
from labutopia_lerobot.sim.linear_light import light_of
from labutopia_lerobot.sim.opengl import BACKENDS, refused_backend
from labutopia_lerobot.sim.supersampling import Sample
from labutopia_lerobot.sim.texture_filter import sample_one_level
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import BEYOND_GROUP, SKIN_GROUP

_CURE = (
    "No picture without OpenGL. On a headless Linux machine type\n"
    "  apt-get install libegl1 libgl1 libgl1-mesa-dri\n"
    "and set MUJOCO_GL=egl (or osmesa, with libosmesa6); observations of `state` need no OpenGL."
)


_FAR = (0.0, 0.0, -1e3)
"""Position where no camera sees a thing [m]."""


class NoOpenGLError(UserError, RuntimeError):
    """No working OpenGL; the message says how to get one."""


class ClassicRenderer:
    """Draws a model through its named cameras; owns an OpenGL context.

    Args:
        model: What to draw.
        width: Width of every picture [pixels].
        height: Height of every picture [pixels].
        liquids: The liquids in the model; pictures show the surfaces that they have extracted last.
        apparatus: Processes of the model; pictures show what they show.
        shadows: Spots on the bench in colour pictures, if any.

    Raises:
        NoOpenGLError: If no OpenGL context can be had.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        width: int,
        height: int,
        liquids: Sequence[LiquidDrawing] = (),
        apparatus: Apparatus | None = None,
        shadows: ContactShadows | None = None,
    ) -> None:
        self._renderer = _open(model, width, height)
        # MuJoCo's renderer has no public way to what it has uploaded.
        self._context = self._renderer._mjr_context
        with self._renderer._gl_context.as_current():
            sample_one_level(self._context, range(model.ntex))
        self._options = mujoco.MjvOption()
        self._options.geomgroup[3:] = 0  # collision geometry and planner hulls stay unseen
        self._options.sitegroup[:] = 0
        self._options.skingroup[SKIN_GROUP] = 0  # liquids draw themselves
        self._wide = width > WIDEST_PICTURE * height
        self._liquids = tuple(liquids)
        self._planes = np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE).tolist()
        self._gleaming = GleamingWalls(model)
        self._places: dict[int, int] = {}  # of the walls among the scene's geoms, as last seen
        self._shadows = shadows
        self._apparatus = apparatus
        self._uploaded: dict[int, int] = {}  # texture -> how often it had been painted

    def color(self, data: mujoco.MjData, camera: str | mujoco.MjvGLCamera) -> NDArray[np.uint8]:
        """Return what a camera, or an eye anywhere, sees, shape (height, width, 3)."""
        self._update(data, camera)
        if self._shadows is not None:
            self._shadows.draw(self._renderer.scene, data)
        picture: NDArray[np.uint8] = self._renderer.render()
        return picture

    def exposure(
        self, data: mujoco.MjData, eye: mujoco.MjvGLCamera, sample: Sample
    ) -> NDArray[np.float32]:
        """Return what an eye sees, linear (see `Renderer`); its lamps cast no shadows."""
        height = self._renderer.height
        self._update(data, turned_by_pixels(eye, sample.right, sample.up, height))
        if self._shadows is not None:
            self._shadows.draw(self._renderer.scene, data)
        return light_of(self._renderer.render())

    def depth(self, data: mujoco.MjData, camera: str) -> NDArray[np.float32]:
        """Return the distance along the optical axis [m], shape (height, width)."""
        self._renderer.enable_depth_rendering()
        try:
            self._update(data, camera)
            picture: NDArray[np.float32] = self._renderer.render()
        finally:
            self._renderer.disable_depth_rendering()
        return picture

    def segmentation(self, data: mujoco.MjData, camera: str) -> NDArray[np.int32]:
        """Return the body id of every pixel, shape (height, width); -1 where there is none.

        A liquid has a body of its own, of its name; what is soft counts as the thing it is part of.
        """
        self._renderer.enable_segmentation_rendering()
        try:
            self._update(data, camera)
            objects, kinds = np.moveaxis(self._renderer.render(), -1, 0)
        finally:
            self._renderer.disable_segmentation_rendering()
        model = self._renderer.model
        body_of = {
            mujoco.mjtObj.mjOBJ_GEOM: model.geom_bodyid,
            mujoco.mjtObj.mjOBJ_SKIN: model.skin_bonebodyid[model.skin_boneadr],
            mujoco.mjtObj.mjOBJ_FLEX: model.body_rootid[model.flex_vertbodyid[model.flex_vertadr]],
        }
        segments: NDArray[np.int32] = np.full(objects.shape, -1, np.int32)
        for kind, bodies in body_of.items():
            of_kind = kinds == int(kind)  # an enumerator itself NumPy compares in Python
            segments[of_kind] = bodies[objects[of_kind]]
        return segments

    def _update(self, data: mujoco.MjData, camera: str | mujoco.MjvGLCamera) -> None:
        """Fill the scene with what there is to see through a camera, or from where an eye is."""
        if self._apparatus is not None:
            self._apparatus.show()
        self._options.geomgroup[BEYOND_GROUP] = self._wide or camera not in FIXED_CAMERAS
        if isinstance(camera, str):
            self._renderer.update_scene(data, camera, self._options)
            at_w = data.camera(camera).xpos
        else:
            self._renderer.update_scene(data, scene_option=self._options)
            for drawn in self._renderer.scene.camera:  # one for each eye of a person: both the same
                copy_eye(camera, drawn)
            at_w = camera.pos
        self._take_ceiling_off(data, at_w)
        self._turn_glass(data, at_w)
        self._show_processes()
        for liquid in self._liquids:
            liquid.draw(self._renderer.scene, self._renderer.model)
            with self._renderer._gl_context.as_current():
                liquid.upload(self._renderer.model, self._context)

    def _take_ceiling_off(self, data: mujoco.MjData, eye_w: FloatArray) -> None:
        """Take planes away that are seen from behind: MuJoCo draws them as fog, or as a wall."""
        behind = {
            plane
            for plane in self._planes
            if (eye_w - data.geom_xpos[plane]) @ data.geom_xmat[plane][2::3] < 0.0
        }
        if behind:
            scene = self._renderer.scene
            for geom in scene.geoms[: scene.ngeom]:
                if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM and geom.objid in behind:
                    geom.pos = _FAR

    def _turn_glass(self, data: mujoco.MjData, eye_w: FloatArray) -> None:
        """Turn round walls about their axes, so that what faces the eye is drawn see-through."""
        geoms = self._renderer.scene.geoms
        for wall, axes in self._gleaming.turned(data, eye_w):
            place = self._places.get(wall, 0)
            if not _is_geom(geoms[place], wall):
                indices = range(self._renderer.scene.ngeom)
                place = next((index for index in indices if _is_geom(geoms[index], wall)), -1)
                if place < 0:
                    continue  # out of sight
                self._places[wall] = place
            geoms[place].mat = axes

    def _show_processes(self) -> None:
        """Send the textures that have been painted since the last picture."""
        if self._apparatus is None:
            return
        for texture, times in self._apparatus.paintings.items():
            if self._uploaded.get(texture) != times:
                self._uploaded[texture] = times
                with self._renderer._gl_context.as_current():
                    mujoco.mjr_uploadTexture(self._renderer.model, self._context, texture)
                    sample_one_level(self._context, [texture])

    def close(self) -> None:
        """Give the OpenGL context back."""
        self._renderer.close()


def _is_geom(drawn: mujoco.MjvGeom, geom: int) -> bool:
    """Return whether what is drawn is a geom of the model, by its number."""
    return bool(drawn.objid == geom and drawn.objtype == int(mujoco.mjtObj.mjOBJ_GEOM))


def require_opengl() -> None:
    """Make sure, before hours of playing, that pictures can be drawn.

    Raises:
        NoOpenGLError: If there is no working OpenGL.
    """
    _open(mujoco.MjSpec().compile(), width=16, height=16).close()


@cache
def opengl_renderer_name() -> str:
    """Return what OpenGL calls its device, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.

    Raises:
        NoOpenGLError: If there is no working OpenGL.
    """
    renderer = _open(mujoco.MjSpec().compile(), width=16, height=16)
    from OpenGL import GL

    name: bytes = GL.glGetString(GL.GL_RENDERER)
    renderer.close()
    return name.decode()


def _open(model: mujoco.MjModel, width: int, height: int) -> mujoco.Renderer:
    refused = refused_backend()
    if refused is not None:
        raise NoOpenGLError(f"MUJOCO_GL={refused} is unknown. Choose from: {', '.join(BACKENDS)}")
    try:
        return mujoco.Renderer(model, height=height, width=width)
    except Exception as error:  # every backend raises a type of its own
        raise NoOpenGLError(f"{_CURE}\nThe cause: {error}") from error
