"""Materials of a stage: one for every finish, as USD's preview surface."""

from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdPhysics, UsdShade

from labutopia_lerobot.export.texture_files import texture_folder, write_texture

_UNTOLD = (0.5, 0.5, 0.5, 1.0)
"""Colour of a geom that has none of its own (MuJoCo, `geom/rgba`)."""


class Looks:
    """The materials of a stage, made when they are first asked for.

    Args:
        stage: Where they are.
        model: What they are from.
        out: The file of the stage; textures go beside it.
    """

    def __init__(self, stage: Usd.Stage, model: mujoco.MjModel, out: Path) -> None:
        self._stage, self._model, self._out = stage, model, out
        self._folder = stage.GetDefaultPrim().GetPath().AppendChild("materials")
        UsdGeom.Scope.Define(stage, self._folder)
        self._frictions: dict[float, UsdShade.Material] = {}

    def dress(self, shape: UsdGeom.Gprim, geom: int) -> None:
        """Give a shape the colour and the material of a geom."""
        material = int(self._model.geom_matid[geom])
        rgba = self._model.geom_rgba[geom]
        if material >= 0 and np.allclose(rgba, _UNTOLD):
            rgba = self._model.mat_rgba[material]
        red, green, blue, opacity = (round(float(number), 6) for number in rgba)
        shape.CreateDisplayColorAttr([Gf.Vec3f(red, green, blue)])
        shape.CreateDisplayOpacityAttr([opacity])
        if material >= 0:
            look = self._look(material, (red, green, blue, opacity))
            UsdShade.MaterialBindingAPI.Apply(shape.GetPrim()).Bind(look)

    def roughen(self, shape: UsdGeom.Gprim, geom: int) -> None:
        """Give a shape the friction of a geom."""
        friction = round(float(self._model.geom_friction[geom, 0]), 6)
        if friction not in self._frictions:
            path = self._folder.AppendChild(Tf.MakeValidIdentifier(f"friction_{friction:g}"))
            material = UsdShade.Material.Define(self._stage, path)
            physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
            physics.CreateStaticFrictionAttr(friction)
            physics.CreateDynamicFrictionAttr(friction)
            self._frictions[friction] = material
        binding = UsdShade.MaterialBindingAPI.Apply(shape.GetPrim())
        binding.Bind(self._frictions[friction], materialPurpose="physics")

    def _look(self, material: int, rgba: tuple[float, float, float, float]) -> UsdShade.Material:
        model = self._model
        name = model.mat(material).name
        if not np.allclose(rgba, model.mat_rgba[material]):
            name += "_" + "_".join(f"{round(255 * number):02x}" for number in rgba)
        path = self._folder.AppendChild(Tf.MakeValidIdentifier(name))
        if self._stage.GetPrimAtPath(path):
            return UsdShade.Material.Get(self._stage, path)
        look = UsdShade.Material.Define(self._stage, path)
        shader = UsdShade.Shader.Define(self._stage, path.AppendChild("surface"))
        shader.CreateIdAttr("UsdPreviewSurface")
        color, kinds = Gf.Vec3f(*rgba[:3]), Sdf.ValueTypeNames
        shader.CreateInput("diffuseColor", kinds.Color3f).Set(color)
        shader.CreateInput("opacity", kinds.Float).Set(rgba[3])
        # MuJoCo's own exporter takes roughness for the opposite of shininess, too.
        shader.CreateInput("roughness", kinds.Float).Set(1.0 - float(model.mat_shininess[material]))
        metallic = max(0.0, float(model.mat_metallic[material]))  # below 0: not said
        shader.CreateInput("metallic", kinds.Float).Set(metallic)
        glow = float(model.mat_emission[material])
        shader.CreateInput("emissiveColor", kinds.Color3f).Set(color * glow)
        texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
        if texture >= 0 and model.tex_type[texture] == mujoco.mjtTexture.mjTEXTURE_2D:
            self._paint(shader, path, texture, glow)
        look.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        return look

    def _paint(self, shader: UsdShade.Shader, path: Sdf.Path, texture: int, glow: float) -> None:
        """Let a shader take its colour from a texture, and what glows, its light."""
        model, kinds = self._model, Sdf.ValueTypeNames
        folder = texture_folder(self._out)
        name = model.tex(texture).name
        file = write_texture(self._out.parent / folder, name, pixels_of(model, texture))
        reader = UsdShade.Shader.Define(self._stage, path.AppendChild("st"))
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", kinds.String).Set("st")
        st = reader.CreateOutput("result", kinds.Float2)
        sampler = UsdShade.Shader.Define(self._stage, path.AppendChild("texture"))
        sampler.CreateIdAttr("UsdUVTexture")
        sampler.CreateInput("file", kinds.Asset).Set(Sdf.AssetPath(f"./{folder}/{file}"))
        sampler.CreateInput("st", kinds.Float2).ConnectToSource(st)
        for axis in ("wrapS", "wrapT"):
            sampler.CreateInput(axis, kinds.Token).Set("repeat")
        if model.tex_nchannel[texture] == 4:
            alpha = sampler.CreateOutput("a", kinds.Float)
            shader.GetInput("opacity").ConnectToSource(alpha)
        rgb = sampler.CreateOutput("rgb", kinds.Float3)
        shader.GetInput("diffuseColor").ConnectToSource(rgb)
        if glow:
            shader.GetInput("emissiveColor").ConnectToSource(rgb)


def pixels_of(model: mujoco.MjModel, texture: int) -> NDArray[np.uint8]:
    """Return a texture, shape (height, width, channels), the lowest row first."""
    shape = [getattr(model, f"tex_{side}")[texture] for side in ("height", "width", "nchannel")]
    start = int(model.tex_adr[texture])
    pixels: NDArray[np.uint8] = model.tex_data[start : start + np.prod(shape)].reshape(shape)
    return pixels
