"""Meshes of a stage."""

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from labutopia_lerobot.export.carriers import FAR


def add_mesh(stage: Usd.Stage, path: Sdf.Path, model: mujoco.MjModel, mesh: int) -> UsdGeom.Mesh:
    """Add a mesh of a model, with its normals and where its texture lies."""

    def rows(what: str, adr: str, num: str) -> NDArray[Any]:
        start = int(getattr(model, f"mesh_{adr}")[mesh])
        some: NDArray[Any] = getattr(model, f"mesh_{what}")[
            start : start + int(getattr(model, f"mesh_{num}")[mesh])
        ]
        return some

    faces = rows("face", "faceadr", "facenum")
    shape = _polygons(stage, path, rows("vert", "vertadr", "vertnum"), faces)
    normals = rows("normal", "normaladr", "normalnum")
    corners = normals[rows("facenormal", "faceadr", "facenum").ravel()]
    primvars = UsdGeom.PrimvarsAPI(shape)
    kinds, each = Sdf.ValueTypeNames, UsdGeom.Tokens.faceVarying
    primvars.CreatePrimvar("normals", kinds.Normal3fArray, each).Set(
        Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(corners, np.float32))
    )
    if model.mesh_texcoordadr[mesh] >= 0:
        places = rows("texcoord", "texcoordadr", "texcoordnum")
        corners = places[rows("facetexcoord", "faceadr", "facenum").ravel()]
        _lay(shape, corners)
    return shape


def is_textured(model: mujoco.MjModel, geom: int) -> bool:
    """Return whether the material of a geom has a texture."""
    material = int(model.geom_matid[geom])
    role = mujoco.mjtTextureRole.mjTEXROLE_RGB
    return bool(material >= 0 and model.mat_texid[material, role] >= 0)


def add_projected(
    stage: Usd.Stage, path: Sdf.Path, model: mujoco.MjModel, geom: int
) -> UsdGeom.Mesh:
    """Add a plane or a box whose texture is laid on from above, as MuJoCo does."""
    material, half = int(model.geom_matid[geom]), model.geom_size[geom].copy()
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
        half[:2] = np.where(half[:2] > 0, half[:2], FAR)
        half[2] = 0.0
        signs = [(x, y, 0) for x in (-1, 1) for y in (-1, 1)]
        faces = np.array([[0, 2, 3, 1]])
    else:
        signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        faces = np.array(
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        )
    points = np.array(signs) * half
    uniform = bool(model.mat_texuniform[material])
    share = points[:, :2] if uniform else np.array(signs)[:, :2] / 2
    mesh = _polygons(stage, path, points, faces)
    _lay(mesh, (share * model.mat_texrepeat[material])[faces.ravel()])
    return mesh


def add_soft(
    stage: Usd.Stage, path: Sdf.Path, model: mujoco.MjModel, points: NDArray[np.float64], flex: int
) -> UsdGeom.Mesh:
    """Add the surface of something soft, stiff as it is now.

    Args:
        stage: Where to.
        path: Of the new mesh.
        model: What the flex is from.
        points: Of all flexes, in the frame of the prim above, shape (vertices, 3) [m].
        flex: Its number.
    """
    first, count = int(model.flex_vertadr[flex]), int(model.flex_vertnum[flex])
    skin = model.flex_dim[flex] == 3  # of a solid its outside, of a sheet all triangles
    which, what = ("shelldata", "shell") if skin else ("elemdata", "elem")
    start = int(getattr(model, f"flex_{which}adr")[flex])
    rows = 3 * int(getattr(model, f"flex_{what}num")[flex])
    faces = getattr(model, f"flex_{what}")[start : start + rows].reshape(-1, 3)
    mesh = _polygons(stage, path, points[first : first + count], faces)
    red, green, blue, opacity = (float(number) for number in model.flex_rgba[flex])
    mesh.CreateDisplayColorAttr([Gf.Vec3f(red, green, blue)])
    mesh.CreateDisplayOpacityAttr([opacity])
    return mesh


def _polygons(
    stage: Usd.Stage, path: Sdf.Path, points: NDArray[np.floating], faces: NDArray[np.integer]
) -> UsdGeom.Mesh:
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points, np.float32)))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray([faces.shape[1]] * len(faces)))
    flat = np.ascontiguousarray(faces.ravel(), np.int32)
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(flat))
    return mesh


def _lay(mesh: UsdGeom.Mesh, corners: NDArray[np.floating]) -> None:
    """Say where the texture lies at every corner of every face, shape (corners, 2)."""
    st = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying
    )
    st.Set(Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(corners, np.float32)))
