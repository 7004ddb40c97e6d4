"""An OpenUSD file, opened again and summed up."""

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom, UsdPhysics

from labutopia_lerobot.export.summary import Summary, box_corners


def summary_of_stage(out: Path) -> Summary:
    """Return what a stage says."""
    stage = Usd.Stage.Open(str(out))
    prims = list(stage.Traverse())
    masses = [UsdPhysics.MassAPI(prim) for prim in prims if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    shapes = [prim for prim in prims if prim.IsA(UsdGeom.Gprim)]
    purposes = [UsdGeom.Imageable(shape).ComputePurpose() for shape in shapes]
    corners = np.vstack([_corners(shape) for shape in shapes])
    hinges = [UsdPhysics.RevoluteJoint(p) for p in prims if p.IsA(UsdPhysics.RevoluteJoint)]
    slides = [UsdPhysics.PrismaticJoint(p) for p in prims if p.IsA(UsdPhysics.PrismaticJoint)]
    limits = [
        (unit * joint.GetLowerLimitAttr().Get(), unit * joint.GetUpperLimitAttr().Get())
        for joints, unit in ((hinges, math.pi / 180.0), (slides, 1.0))
        for joint in joints
    ]
    return Summary(
        moving=len(masses),
        drawn=purposes.count(UsdGeom.Tokens.default_),
        touched=sum(shape.HasAPI(UsdPhysics.CollisionAPI) for shape in shapes),
        limits=tuple(sorted(limits)),
        masses=tuple(sorted(mass.GetMassAttr().Get() for mass in masses)),
        low=tuple(corners.min(axis=0).tolist()),
        high=tuple(corners.max(axis=0).tolist()),
    )


def _corners(shape: Usd.Prim) -> NDArray[np.float64]:
    """Return the points of a mesh or the corners of the box around a shape, stage's frame."""
    if shape.IsA(UsdGeom.Mesh):
        points = np.array(UsdGeom.Mesh(shape).GetPointsAttr().Get(), float)
    else:
        low, high = np.array(UsdGeom.Boundable(shape).GetExtentAttr().Get(), float)
        points = box_corners(low, high)
    world = np.array(UsdGeom.Xformable(shape).ComputeLocalToWorldTransform(Usd.TimeCode.Default()))
    corners: NDArray[np.float64] = points @ world[:3, :3] + world[3, :3]
    return corners
