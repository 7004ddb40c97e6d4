"""Pieces of labware: found by walking the package, built alone, drawn small."""

import importlib
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

import labutopia_lerobot.labware
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer

SIZE = 160
"""Width and height of a picture [pixels]."""

_COLORS = 48
"""Size of the palette: enough for grey glass before a grey wall, at some 4 kB a picture."""

_DETAIL = 3
"""Pictures are drawn this many times larger and shrunk, which smooths their edges."""

_FROM = np.array([-0.78, -0.45, 0.42])
"""Direction of the camera from the piece: before the front of instruments, above."""

_FIELD_OF_VIEW_DEG = 20.0

type Maker = Callable[..., Piece]


def makers() -> Iterator[Maker]:
    """Yield every class and public function of the labware that makes a piece, by module, name."""
    package = labutopia_lerobot.labware
    names = [m.name for m in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")]
    for name in sorted(names):
        for member in vars(importlib.import_module(name)).values():
            own = getattr(member, "__module__", None) == name
            public = not getattr(member, "__name__", "_").startswith("_")
            if own and public and _makes_a_piece(member):
                yield member


def _makes_a_piece(member: Any) -> bool:
    if inspect.isfunction(member):
        member = inspect.signature(member).return_annotation
    whole = inspect.isclass(member) and not inspect.isabstract(member)
    return whole and all(
        hasattr(member, part) for part in ("add_to", "footprint_radius", "movable", "joints")
    )


def needs_only_a_name(maker: Maker) -> bool:
    """Return whether a maker has a default for everything but the name."""
    parameters = list(inspect.signature(maker).parameters.values())
    return all(parameter.default is not parameter.empty for parameter in parameters[1:])


def picture(piece: Piece) -> Image.Image:
    """Return a small picture of a piece that stands alone on a grey floor."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    _add_surroundings(spec)
    piece.add_to(spec, spec.worldbody)
    if spec.flexes:
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    low, high = _bounds(model, data)
    middle, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    model.geom("floor").pos = (0.0, 0.0, low[2] - 0.001)
    camera = model.camera("front")
    distance = radius / np.sin(np.radians(_FIELD_OF_VIEW_DEG / 2))
    camera.pos = middle + distance * _FROM / np.linalg.norm(_FROM)
    mujoco.mj_forward(model, data)
    renderer = ClassicRenderer(model, _DETAIL * SIZE, _DETAIL * SIZE)
    drawn = Image.fromarray(renderer.color(data, "front"))
    renderer.close()
    return drawn.resize((SIZE, SIZE), Image.Resampling.LANCZOS).quantize(_COLORS)


def _add_surroundings(spec: mujoco.MjSpec) -> None:
    """Add floor, sky, light and the camera, which looks the same way whatever there is to see."""
    spec.visual.global_.offwidth = spec.visual.global_.offheight = _DETAIL * SIZE
    spec.visual.quality.shadowsize = 0
    spec.visual.map.znear, spec.visual.map.zfar, spec.stat.extent = 0.01, 20.0, 1.0
    spec.visual.headlight.ambient = spec.visual.headlight.diffuse = [0.4] * 3
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_FLAT,
        rgb1=[0.52, 0.55, 0.58],
        width=16,
        height=96,
    )
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        pos=[0.0, 0.0, -1.0],  # not 0: MuJoCo would not let it be moved from its body's frame
        size=[5.0, 5.0, 0.1],
        rgba=[0.42, 0.45, 0.48, 1.0],
    )
    spec.worldbody.add_light(
        name="key",
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        dir=[-0.45, 0.55, -0.9],
        diffuse=[0.4] * 3,
        castshadow=False,
    )
    back = _FROM / np.linalg.norm(_FROM)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    quat = np.empty(4)
    mujoco.mju_mat2Quat(quat, np.column_stack([right, np.cross(back, right), back]).ravel())
    spec.worldbody.add_camera(name="front", quat=quat, fovy=_FIELD_OF_VIEW_DEG)


def _bounds(
    model: mujoco.MjModel, data: mujoco.MjData
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the least and greatest corner of all that is seen but the floor."""
    points = [data.flexvert_xpos]
    for geom in range(model.ngeom):
        if model.geom_bodyid[geom] and model.geom_group[geom] <= 2:
            centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
            corners = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T * half + centre
            points.append(corners @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
    cloud = np.vstack(points)
    return cloud.min(axis=0), cloud.max(axis=0)
