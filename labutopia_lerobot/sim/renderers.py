"""Renderers of pictures: one protocol, two implementations."""

from collections.abc import Sequence
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.setting import FILAMENT
from labutopia_lerobot.sim import classic_renderer, filament_renderer
from labutopia_lerobot.sim.contact_shadows import ContactShadows
from labutopia_lerobot.sim.supersampling import Sample


class Renderer(Protocol):
    """Draws a model through its named cameras."""

    def color(self, data: mujoco.MjData, camera: str | mujoco.MjvGLCamera) -> NDArray[np.uint8]:
        """Return what a camera, or an eye anywhere, sees, shape (height, width, 3)."""
        ...

    def exposure(
        self, data: mujoco.MjData, eye: mujoco.MjvGLCamera, sample: Sample
    ) -> NDArray[np.float32]:
        """Return one of many exposures that a picture of a film is the mean of.

        Args:
            data: Where everything is.
            eye: Where from; whatever is there is drawn.
            sample: Which of them.

        Returns:
            Linear light, 0 to 1, shape (height, width, 3).
        """
        ...

    def depth(self, data: mujoco.MjData, camera: str) -> NDArray[np.float32]:
        """Return the distance along the optical axis [m], shape (height, width)."""
        ...

    def segmentation(self, data: mujoco.MjData, camera: str) -> NDArray[np.int32]:
        """Return the body id of every pixel, shape (height, width); -1 where there is none."""
        ...

    def close(self) -> None:
        """Give what it holds back."""
        ...


def open_renderer(
    kind: str,
    model: mujoco.MjModel,
    width: int,
    height: int,
    liquids: Sequence[LiquidDrawing] = (),
    apparatus: Apparatus | None = None,
    shadows: ContactShadows | None = None,
) -> Renderer:
    """Return a renderer of a kind, one of `setting.RENDERERS`; the model is compiled for it.

    Filament has shade of its own where things stand, and leaves `shadows` out.

    Raises:
        NoFilamentError: If it is Filament, and there is no Vulkan.
        NoOpenGLError: If it is the classic one, and there is no working OpenGL.
    """
    if kind == FILAMENT:
        return filament_renderer.FilamentRenderer(model, width, height, liquids, apparatus)
    return classic_renderer.ClassicRenderer(model, width, height, liquids, apparatus, shadows)


def require_renderer(kind: str) -> None:
    """Make sure, before hours of playing, that a kind of renderer can draw.

    Raises:
        NoFilamentError: If it is Filament, and there is no Vulkan.
        NoOpenGLError: If it is the classic one, and there is no working OpenGL.
    """
    if kind == FILAMENT:
        filament_renderer.require_filament()
    else:
        classic_renderer.require_opengl()


def renderer_name(kind: str) -> str:
    """Return what draws, as rows and datasets record it: no two kinds have the same name.

    Raises:
        NoFilamentError: If it is Filament, and there is no Vulkan.
        NoOpenGLError: If it is the classic one, and there is no working OpenGL.
    """
    if kind == FILAMENT:
        return filament_renderer.filament_renderer_name()
    return classic_renderer.opengl_renderer_name()
