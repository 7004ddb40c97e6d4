"""Pictures by Filament, MuJoCo's physically based renderer: colours only.

It needs Vulkan; Mesa's software implementation will do. Every picture of a moment has the same
bits, whatever was drawn before.
"""

import ctypes
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.scenes.laboratory_model import KEY_LAMP
from labutopia_lerobot.scenes.views import FIXED_CAMERAS, WIDEST_PICTURE
from labutopia_lerobot.sim.eye import eye_of_camera, turned_by_pixels
from labutopia_lerobot.sim.filament_light import HEADLIGHT_LUX, balanced, developed
from labutopia_lerobot.sim.filament_shadows import WideLamp
from labutopia_lerobot.sim.filament_surfaces import FilamentLiquid, FilamentPaintings, thin_out
from labutopia_lerobot.sim.gleaming_walls import GleamingWalls
from labutopia_lerobot.sim.supersampling import Sample
from labutopia_lerobot.sim.vulkan import vulkan_device
from labutopia_lerobot.world.model import BEYOND_GROUP

if TYPE_CHECKING:
    from mujoco import mjrf

_CURE = (
    "renderer=filament needs Vulkan. On a headless Linux machine type\n"
    "  apt-get install libvulkan1 mesa-vulkan-drivers\n"
    "or choose renderer=classic, which needs OpenGL"
)
_SCENE, _FILM = "scene", "film"
_C = ctypes.CDLL(None)
"""The C library of this process."""


class NoFilamentError(UserError, RuntimeError):
    """No working Filament, or what it cannot draw; the message says the cure."""


class FilamentRenderer:
    """Draws a model through its named cameras.

    Args:
        model: What to draw; compiled without skins of liquids.
        width: Width of every picture [pixels].
        height: Height of every picture [pixels].
        liquids: The liquids in the model; pictures show the surfaces that they have extracted last.
        apparatus: Processes of the model; pictures show what they show.

    Raises:
        NoFilamentError: If there is no Vulkan.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        width: int,
        height: int,
        liquids: Sequence[LiquidDrawing] = (),
        apparatus: Apparatus | None = None,
    ) -> None:
        context = _new_context()
        from mujoco.rendering.filament.renderer import Renderer, View  # here: it needs the context

        self._model, self._view = model, View
        self._renderer = Renderer(context)
        self._things = _Things(context, model, self._renderer.scene(_SCENE))
        self._walls = GleamingWalls(model).geoms
        self._wide = width > WIDEST_PICTURE * height
        self._film = np.empty((height, width, 3), np.uint8)
        self._renderer.target(_FILM, self._film)
        self._liquids = [FilamentLiquid(context, self._things.scene, each) for each in liquids]
        self._apparatus = apparatus
        self._painted = FilamentPaintings(context, model)

    def color(self, data: mujoco.MjData, camera: str | mujoco.MjvGLCamera) -> NDArray[np.uint8]:
        """Return what a camera, or an eye anywhere, sees, shape (height, width, 3)."""
        self._update(data, self._wide or camera not in FIXED_CAMERAS)
        named = isinstance(camera, str)
        self._expose(eye_of_camera(self._model, data, camera) if named else camera)
        return developed(self._film)

    def exposure(
        self, data: mujoco.MjData, eye: mujoco.MjvGLCamera, sample: Sample
    ) -> NDArray[np.float32]:
        """Return what an eye sees while the brighter lamp casts shadows (see `Renderer`)."""
        self._update(data, beyond=True)
        with self._lamp.casting(sample):
            self._expose(turned_by_pixels(eye, sample.right, sample.up, len(self._film)))
        return balanced(self._film)

    @cached_property
    def _lamp(self) -> WideLamp:
        light, shown = self._things.light(KEY_LAMP), self._things.of_geom
        return WideLamp(self._model, KEY_LAMP, light, shown, self._walls)

    def _update(self, data: mujoco.MjData, beyond: bool) -> None:
        """Fill the scene with what there is to see."""
        if self._apparatus is not None:
            self._apparatus.show()
        self._things.update(data, beyond)
        for liquid in self._liquids:
            liquid.update()
        for wall in self._walls:
            thin_out(self._model, wall, self._things.of_geom(wall))
        if self._apparatus is not None:
            self._painted.update(self._apparatus.paintings, self._things.of_geom)

    def _expose(self, eye: mujoco.MjvGLCamera) -> None:
        """Draw the scene into the film."""
        view = self._view(
            scene=_SCENE,
            target=_FILM,
            camera=eye,
            post_processing=False,
            headlight=True,
            headlight_intensity=HEADLIGHT_LUX * float(self._model.vis.headlight.diffuse.mean()),
        )
        self._renderer.render([view])

    def depth(self, data: mujoco.MjData, camera: str) -> NDArray[np.float32]:
        """Refuse: see `NoFilamentError`."""
        raise NoFilamentError("renderer=filament draws no depth: choose renderer=classic")

    def segmentation(self, data: mujoco.MjData, camera: str) -> NDArray[np.int32]:
        """Refuse: see `NoFilamentError`."""
        raise NoFilamentError("renderer=filament draws no segmentation: choose renderer=classic")

    def close(self) -> None:
        """Give the context back, and what is in it."""
        for liquid in self._liquids:
            liquid.close()
        self._liquids = []
        self.__dict__.pop("_lamp", None)
        del self._painted, self._things, self._renderer


class _Things:
    """Lights and geoms of a model in a scene of Filament's."""

    def __init__(self, context: "mjrf.Context", model: mujoco.MjModel, scene: "mjrf.Scene") -> None:
        from mujoco import mjrf

        self.scene, self._model = scene, model
        scene.configure_from_model(model)
        self._resources = mjrf.ModelResources(context, model)
        self._lights = mjrf.ModelLights(scene, self._resources)
        self._renderables = mjrf.ModelRenderables(scene, self._resources)
        self._shown = mujoco.MjvOption()
        self._shown.geomgroup[3:] = 0  # collision geometry and planner hulls stay unseen
        self._shown.sitegroup[:] = 0

    def update(self, data: mujoco.MjData, beyond: bool) -> None:
        """Put everything where it is, with the colours that it has now.

        Args:
            data: Where it is.
            beyond: Whether to show what no fixed camera sees.
        """
        self._shown.geomgroup[BEYOND_GROUP] = beyond
        self._renderables.set_options(self._shown)
        self._lights.update(data)
        self._renderables.update(data)

    def light(self, name: str) -> "mjrf.Light":
        """Return a lamp of the model by its name."""
        light = self._lights.get_light(self._model.light(name).id)
        assert light is not None  # every lamp of a model has one
        return light

    def of_geom(self, geom: int) -> "mjrf.Renderable":
        """Return what shows a geom."""
        return self._renderables.get_renderable(mujoco.mjtObj.mjOBJ_GEOM, geom)


def require_filament() -> None:
    """Make sure, before hours of playing, that Filament can draw.

    Raises:
        NoFilamentError: If there is no Vulkan.
    """
    if vulkan_device() is None:
        raise NoFilamentError(_CURE)


def filament_renderer_name() -> str:
    """Return what draws, such as `Filament on llvmpipe (LLVM 15.0.6, 256 bits)`.

    Raises:
        NoFilamentError: If there is no Vulkan.
    """
    require_filament()
    return f"Filament on {vulkan_device()}"


def _new_context() -> "mjrf.Context":
    """Return a context, some 70 MB. It draws one scene: in MuJoCo 4.0.0 a second one raises."""
    require_filament()
    import mujoco.studio.window  # noqa: F401  # registers Filament's materials
    from mujoco import mjrf

    with _without_greetings():
        vulkan = mjrf.GraphicsApi.GRAPHICS_API_VULKAN
        return mjrf.Context(mjrf.ContextConfig(graphics_api=vulkan))


@contextmanager
def _without_greetings() -> Iterator[None]:
    """Keep what a library says on the standard output from it: programs print JSON there."""
    sys.stdout.flush()
    kept = os.dup(1)
    with open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        _C.fflush(None)  # it would come when the program ends, where the output is no terminal
        os.dup2(kept, 1)
        os.close(kept)
