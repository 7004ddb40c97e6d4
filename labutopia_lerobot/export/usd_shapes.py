"""Shapes of a stage: MuJoCo's geoms as USD's own shapes."""

import mujoco
import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom

from labutopia_lerobot.export.carriers import FAR
from labutopia_lerobot.export.usd_meshes import add_mesh, add_projected, is_textured

_GEOM = mujoco.mjtGeom


def add_shape(stage: Usd.Stage, path: Sdf.Path, model: mujoco.MjModel, geom: int) -> UsdGeom.Gprim:
    """Add a geom in the frame of its body.

    Planes and boxes with a texture are meshes: no other shape says where it lies on them.

    Raises:
        NotImplementedError: If USD has no such shape.
    """
    kind, size = _GEOM(int(model.geom_type[geom])), [float(s) for s in model.geom_size[geom]]
    scale = None
    if kind == _GEOM.mjGEOM_MESH:
        shape = add_mesh(stage, path, model, int(model.geom_dataid[geom]))
    elif kind in (_GEOM.mjGEOM_PLANE, _GEOM.mjGEOM_BOX) and is_textured(model, geom):
        shape = add_projected(stage, path, model, geom)
    elif kind == _GEOM.mjGEOM_PLANE:
        shape = UsdGeom.Plane.Define(stage, path)
        shape.CreateWidthAttr(2.0 * (size[0] or FAR))
        shape.CreateLengthAttr(2.0 * (size[1] or FAR))
        shape.CreateAxisAttr(UsdGeom.Tokens.z)
    elif kind == _GEOM.mjGEOM_SPHERE:
        shape = UsdGeom.Sphere.Define(stage, path)
        shape.CreateRadiusAttr(size[0])
    elif kind == _GEOM.mjGEOM_ELLIPSOID:
        shape = UsdGeom.Sphere.Define(stage, path)
        shape.CreateRadiusAttr(1.0)
        scale = size
    elif kind in (_GEOM.mjGEOM_CAPSULE, _GEOM.mjGEOM_CYLINDER):
        round_ends = kind == _GEOM.mjGEOM_CAPSULE
        shape = (UsdGeom.Capsule if round_ends else UsdGeom.Cylinder).Define(stage, path)
        shape.CreateRadiusAttr(size[0])
        shape.CreateHeightAttr(2.0 * size[1])
        shape.CreateAxisAttr(UsdGeom.Tokens.z)
    elif kind == _GEOM.mjGEOM_BOX:
        shape = UsdGeom.Cube.Define(stage, path)
        shape.CreateSizeAttr(2.0)
        scale = size
    else:
        raise NotImplementedError(f"{model.geom(geom).name}: USD has no {kind.name}")
    place(shape, model.geom_pos[geom], model.geom_quat[geom])
    if scale is not None:
        shape.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*scale))
    bound(shape)
    return shape


def place(
    xform: UsdGeom.Xformable, position: NDArray[np.float64], quat: NDArray[np.float64]
) -> None:
    """Put a prim somewhere in the frame of the prim above.

    Args:
        xform: What to place.
        position: Shape (3,) [m].
        quat: Scalar-first, shape (4,).
    """
    xform.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*map(float, position)))
    xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Quatd(*map(float, quat)))


def bound(shape: UsdGeom.Boundable) -> None:
    """Write down how large a shape is, along its own axes."""
    now = Usd.TimeCode.Default()
    shape.CreateExtentAttr(UsdGeom.Boundable.ComputeExtentFromPlugins(shape, now))
