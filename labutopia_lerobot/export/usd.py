"""OpenUSD: a stage of a compiled model in a pose. Imports pxr, of the extra `usd`.

`/<name>` holds all; below it `materials`, `joints`, cameras and the bodies (`usd_paths`). Units are
metres, kilograms and degrees, z is up. What is only touched has the purpose `guide`. Hulls of the
planner, lights, tendons and equalities stay behind; what is soft is stiff.
"""

from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Sdf, Tf, Usd, UsdGeom, UsdPhysics
from scipy.spatial.transform import Rotation

from labutopia_lerobot.export.carriers import carriers, is_drawn, is_joint, touches
from labutopia_lerobot.export.usd_looks import Looks
from labutopia_lerobot.export.usd_meshes import add_soft
from labutopia_lerobot.export.usd_paths import free_path, needs_group, parent_path
from labutopia_lerobot.export.usd_physics import add_joint, add_mass, keep_apart
from labutopia_lerobot.export.usd_shapes import add_shape, bound, place

_APERTURE = 24.0
"""Height and width of a camera's film [mm]; only its ratio to the focal length is seen."""


def write_usd(model: mujoco.MjModel, data: mujoco.MjData, name: str, out: Path) -> None:
    """Write a stage.

    Args:
        model: What to write.
        data: Poses of all bodies, as after `mj_forward`.
        name: Of the prim that holds all.
        out: The file, `.usda` or `.usdc`; textures go into `<stem>_textures` beside it.
    """
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    top = UsdGeom.Xform.Define(stage, Sdf.Path("/" + Tf.MakeValidIdentifier(name)))
    stage.SetDefaultPrim(top.GetPrim())
    Usd.ModelAPI(top).SetKind(Kind.Tokens.component)
    looks = Looks(stage, model, out)
    moves_with = carriers(model)
    paths = _add_bodies(stage, model, data, moves_with)
    for geom in range(model.ngeom):
        _add_geom(stage, model, geom, paths, looks)
    for flex in range(model.nflex):
        _add_flex(stage, model, data, flex, paths)
    _add_joints(stage, model, paths, moves_with)
    keep_apart(stage, model, paths)
    for camera in range(model.ncam):
        _add_camera(stage, model, camera, paths)
    stage.GetRootLayer().Export(str(out))


def _add_bodies(
    stage: Usd.Stage, model: mujoco.MjModel, data: mujoco.MjData, moves_with: list[int]
) -> dict[int, Sdf.Path]:
    """Add every body; return where they are, and under 0 where the world is."""
    paths = {0: stage.GetDefaultPrim().GetPath()}
    groups: dict[int, Sdf.Path] = {}
    placed = {paths[0]: (np.zeros(3), Rotation.identity())}
    for body in range(1, model.nbody):
        if model.body_rootid[body] == body and needs_group(model, moves_with, body):
            groups[body] = free_path(stage, paths[0], model.body(body).name)
            UsdGeom.Xform.Define(stage, groups[body])
            placed[groups[body]] = placed[paths[0]]
        parent = parent_path(model, moves_with, paths, groups, body)
        path = free_path(stage, parent, model.body(body).name or f"body_{body}")
        turn = Rotation.from_quat(data.xquat[body], scalar_first=True)
        position_w, turn_w = placed[parent]
        prim = UsdGeom.Xform.Define(stage, path)
        place(
            prim,
            turn_w.inv().apply(data.xpos[body] - position_w),
            (turn_w.inv() * turn).as_quat(scalar_first=True),
        )
        paths[body], placed[path] = path, (data.xpos[body], turn)
        if moves_with[body] == body:
            others = [b for b in range(body + 1, model.nbody) if moves_with[b] == body]
            add_mass(prim.GetPrim(), model, data, [body, *others])
    _mark_articulations(stage, model, moves_with, paths, groups)
    return paths


def _mark_articulations(
    stage: Usd.Stage,
    model: mujoco.MjModel,
    moves_with: list[int],
    paths: dict[int, Sdf.Path],
    groups: dict[int, Sdf.Path],
) -> None:
    """Mark what has a joint on something that moves: an arm, an instrument that stands free."""
    for joint in range(model.njnt):
        body = int(model.jnt_bodyid[joint])
        if is_joint(model, joint) and moves_with[model.body_parentid[body]]:
            tree = int(model.body_rootid[body])
            prim = stage.GetPrimAtPath(groups.get(tree, paths[tree]))
            UsdPhysics.ArticulationRootAPI.Apply(prim)


def _add_geom(
    stage: Usd.Stage, model: mujoco.MjModel, geom: int, paths: dict[int, Sdf.Path], looks: Looks
) -> None:
    drawn, touched = is_drawn(model, geom), touches(model, geom)
    if not drawn and not touched:
        return
    name = model.geom(geom).name or f"geom_{geom}"
    path = free_path(stage, paths[int(model.geom_bodyid[geom])], name)
    shape = add_shape(stage, path, model, geom)
    if drawn:
        looks.dress(shape, geom)
    else:
        shape.CreatePurposeAttr(UsdGeom.Tokens.guide)
    if touched:
        looks.roughen(shape, geom)
        UsdPhysics.CollisionAPI.Apply(shape.GetPrim())
        if shape.GetPrim().IsA(UsdGeom.Mesh):
            api = UsdPhysics.MeshCollisionAPI.Apply(shape.GetPrim())
            api.CreateApproximationAttr(UsdPhysics.Tokens.convexHull)


def _add_flex(
    stage: Usd.Stage,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    flex: int,
    paths: dict[int, Sdf.Path],
) -> None:
    body = int(model.body_rootid[model.flex_vertbodyid[model.flex_vertadr[flex]]])
    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_FLEX, flex)
    path = free_path(stage, paths[body], name or f"soft_{flex}")
    frame: NDArray[np.float64] = data.xmat[body].reshape(3, 3)
    bound(add_soft(stage, path, model, (data.flexvert_xpos - data.xpos[body]) @ frame, flex))


def _add_joints(
    stage: Usd.Stage, model: mujoco.MjModel, paths: dict[int, Sdf.Path], moves_with: list[int]
) -> None:
    joints = [joint for joint in range(model.njnt) if is_joint(model, joint)]
    if joints:
        scope = UsdGeom.Scope.Define(stage, paths[0].AppendChild("joints")).GetPath()
    for joint in joints:
        path = free_path(stage, scope, model.joint(joint).name or f"joint_{joint}")
        add_joint(stage, path, model, joint, paths, moves_with)


def _add_camera(
    stage: Usd.Stage, model: mujoco.MjModel, camera: int, paths: dict[int, Sdf.Path]
) -> None:
    parent = paths[int(model.cam_bodyid[camera])]
    made = UsdGeom.Camera.Define(stage, free_path(stage, parent, model.camera(camera).name))
    place(made, model.cam_pos[camera], model.cam_quat[camera])
    half = np.radians(float(model.cam_fovy[camera])) / 2
    made.CreateFocalLengthAttr(float(_APERTURE / 2 / np.tan(half)))
    made.CreateHorizontalApertureAttr(_APERTURE)
    made.CreateVerticalApertureAttr(_APERTURE)
    near = float(model.vis.map.znear * model.stat.extent)
    made.CreateClippingRangeAttr((near, float(model.vis.map.zfar * model.stat.extent)))
