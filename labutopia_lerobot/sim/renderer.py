"""Pictures of a simulation: colour, metric depth, segmentation."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError

_CURE = (
    "No picture without OpenGL. On a headless Linux machine type\n"
    "  apt-get install libegl1 libgl1 libgl1-mesa-dri\n"
    "and set MUJOCO_GL=egl (or osmesa, with libosmesa6); observations of `state` need no OpenGL."
)


class NoOpenGLError(UserError, RuntimeError):
    """No working OpenGL; the message says how to get one."""


class Renderer:
    """Draws a model through its named cameras; owns an OpenGL context.

    Args:
        model: What to draw.
        width: Width of every picture [pixels].
        height: Height of every picture [pixels].

    Raises:
        NoOpenGLError: If no OpenGL context can be had.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        try:
            self._renderer = mujoco.Renderer(model, height=height, width=width)
        except Exception as error:  # every backend raises a type of its own
            raise NoOpenGLError(f"{_CURE}\nThe cause: {error}") from error
        self._options = mujoco.MjvOption()
        self._options.geomgroup[3:] = 0  # collision geometry and planner hulls stay unseen
        self._options.sitegroup[:] = 0

    def color(self, data: mujoco.MjData, camera: str) -> NDArray[np.uint8]:
        """Return what the camera sees, shape (height, width, 3)."""
        self._renderer.update_scene(data, camera, self._options)
        picture: NDArray[np.uint8] = self._renderer.render()
        return picture

    def depth(self, data: mujoco.MjData, camera: str) -> NDArray[np.float32]:
        """Return the distance along the optical axis [m], shape (height, width)."""
        self._renderer.enable_depth_rendering()
        try:
            self._renderer.update_scene(data, camera, self._options)
            picture: NDArray[np.float32] = self._renderer.render()
        finally:
            self._renderer.disable_depth_rendering()
        return picture

    def segmentation(self, data: mujoco.MjData, camera: str) -> NDArray[np.int32]:
        """Return the body id of every pixel, shape (height, width); -1 where there is none."""
        self._renderer.enable_segmentation_rendering()
        try:
            self._renderer.update_scene(data, camera, self._options)
            geoms = self._renderer.render()[..., 0].astype(np.int32)
        finally:
            self._renderer.disable_segmentation_rendering()
        bodies = np.append(self._renderer.model.geom_bodyid, -1).astype(np.int32)
        segments: NDArray[np.int32] = bodies[geoms]
        return segments

    def close(self) -> None:
        """Give the OpenGL context back."""
        self._renderer.close()


def opengl_renderer_name(renderer: Renderer) -> str:
    """Return what OpenGL calls its device, such as `llvmpipe (LLVM 15.0.6, 256 bits)`."""
    del renderer  # its context must be current, which constructing it made so
    from OpenGL import GL

    name: bytes = GL.glGetString(GL.GL_RENDERER)
    return name.decode()
