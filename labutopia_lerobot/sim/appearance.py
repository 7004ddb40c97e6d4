"""Appearance of a compiled room in an episode: finishes, light, the poses of the fixed cameras."""

import mujoco

from labutopia_lerobot.scenario.variation import Variation
from labutopia_lerobot.scenes.finishes import BENCH_FINISHES, WALL_FINISHES, Finish
from labutopia_lerobot.scenes.views import FIXED_CAMERAS


class Appearance:
    """Edits the look of a model; every `show` starts from the look it was compiled with.

    Nothing here touches what moves or collides.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        head = model.vis.headlight
        self._arrays = [
            model.mat_rgba,
            model.mat_specular,
            model.mat_shininess,
            model.mat_texid,
            model.light_diffuse,
            model.light_specular,
            model.cam_pos,
            head.ambient,
            head.diffuse,
            head.specular,
        ]
        self._built = [array.copy() for array in self._arrays]

    def show(self, variation: Variation) -> None:
        """Look as an episode has drawn it; cameras follow with the next forward kinematics."""
        for array, built in zip(self._arrays, self._built, strict=True):
            array[:] = built
        if variation.bench is not None:
            self._paint("bench_top", BENCH_FINISHES[variation.bench])
        if variation.walls is not None:
            self._paint("wall", WALL_FINISHES[variation.walls])
        model, head = self._model, self._model.vis.headlight
        for light in (model.light_diffuse, model.light_specular):
            light[:] *= variation.brightness
        for light in (head.ambient, head.diffuse, head.specular):
            light[:] *= variation.brightness
        if variation.cameras is not None:
            for name in FIXED_CAMERAS:
                model.camera(name).pos += variation.cameras

    def _paint(self, material: str, finish: Finish) -> None:
        painted = self._model.material(material)
        painted.rgba = finish.rgba
        painted.specular, painted.shininess = finish.specular, finish.shininess
        if finish.pattern is not None:
            painted.texid[mujoco.mjtTextureRole.mjTEXROLE_RGB] = self._model.texture(
                finish.pattern
            ).id
