"""Physics of a stage: what weighs how much, what turns and slides, what does not touch."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdPhysics
from scipy.spatial.transform import Rotation


def add_mass(prim: Usd.Prim, model: mujoco.MjModel, data: mujoco.MjData, bodies: list[int]) -> None:
    """Make a prim a rigid body with the mass of everything that moves with it.

    Args:
        prim: Of the body that carries the others.
        model: What they are from.
        data: Their poses.
        bodies: The one that carries, then the others.
    """
    UsdPhysics.RigidBodyAPI.Apply(prim)
    masses = model.body_mass[bodies]
    mass = float(masses.sum())
    centre_w = masses @ data.xipos[bodies] / mass
    inertia_w = np.zeros((3, 3))
    for body, part in zip(bodies, masses, strict=True):
        turn, arm = data.ximat[body].reshape(3, 3), data.xipos[body] - centre_w
        inertia_w += turn @ np.diag(model.body_inertia[body]) @ turn.T
        inertia_w += part * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    frame = data.xmat[bodies[0]].reshape(3, 3)
    moments, axes = np.linalg.eigh(frame.T @ inertia_w @ frame)
    axes[:, 2] *= np.linalg.det(axes)
    api = UsdPhysics.MassAPI.Apply(prim)
    api.CreateMassAttr(mass)
    api.CreateCenterOfMassAttr(_vector(frame.T @ (centre_w - data.xpos[bodies[0]])))
    api.CreateDiagonalInertiaAttr(_vector(moments))
    api.CreatePrincipalAxesAttr(_quat(Rotation.from_matrix(axes)))


def add_joint(
    stage: Usd.Stage,
    path: Sdf.Path,
    model: mujoco.MjModel,
    joint: int,
    paths: Mapping[int, Sdf.Path],
    moves_with: Sequence[int],
) -> None:
    """Add a hinge or a slide: 0 is where MuJoCo's joint has its reference, limits are from there.

    Args:
        stage: Where to.
        path: Of the joint.
        model: What it is from.
        joint: Its number.
        paths: Of the bodies.
        moves_with: Carrier of every body.
    """
    body = int(model.jnt_bodyid[joint])
    hinge = bool(model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE)
    kind = UsdPhysics.RevoluteJoint if hinge else UsdPhysics.PrismaticJoint
    made = kind.Define(stage, path)
    made.CreateAxisAttr("Z")
    turn = Rotation.from_quat(model.body_quat[body], scalar_first=True)
    anchor = model.jnt_pos[joint]
    at, above = model.body_pos[body] + turn.apply(anchor), int(model.body_parentid[body])
    while moves_with[above] not in (above, 0):  # up to the body that carries the one above
        outer = Rotation.from_quat(model.body_quat[above], scalar_first=True)
        turn, at = outer * turn, model.body_pos[above] + outer.apply(at)
        above = int(model.body_parentid[above])
    axis = Rotation.align_vectors([model.jnt_axis[joint]], [[0.0, 0.0, 1.0]])[0]
    made.CreateBody0Rel().SetTargets([paths[above]])
    made.CreateLocalPos0Attr(_vector(at))
    made.CreateLocalRot0Attr(_quat(turn * axis))
    made.CreateBody1Rel().SetTargets([paths[body]])
    made.CreateLocalPos1Attr(_vector(anchor))
    made.CreateLocalRot1Attr(_quat(axis))
    unit = np.degrees if hinge else float
    if model.jnt_limited[joint]:
        low, high = model.jnt_range[joint] - model.qpos0[model.jnt_qposadr[joint]]
        made.CreateLowerLimitAttr(float(unit(low)))
        made.CreateUpperLimitAttr(float(unit(high)))
    _add_drive(made.GetPrim(), model, joint, hinge)
    _add_passive(made.GetPrim(), model, joint)


def keep_apart(stage: Usd.Stage, model: mujoco.MjModel, paths: Mapping[int, Sdf.Path]) -> None:
    """Say which bodies do not touch each other."""
    for signature in model.exclude_signature:
        first, second = paths[int(signature) >> 16], paths[int(signature) & 0xFFFF]
        api = UsdPhysics.FilteredPairsAPI.Apply(stage.GetPrimAtPath(first))
        api.CreateFilteredPairsRel().AddTarget(second)


def _add_drive(prim: Usd.Prim, model: mujoco.MjModel, joint: int, hinge: bool) -> None:
    """Add the position servo of a joint, if it has one: gains are per degree or metre."""
    for servo in range(model.nu):
        own = model.actuator_trnid[servo, 0] == joint
        if own and model.actuator_trntype[servo] == mujoco.mjtTrn.mjTRN_JOINT:
            drive = UsdPhysics.DriveAPI.Apply(prim, "angular" if hinge else "linear")
            per = np.pi / 180.0 if hinge else 1.0
            drive.CreateTypeAttr("force")
            drive.CreateStiffnessAttr(float(-model.actuator_biasprm[servo, 1] * per))
            drive.CreateDampingAttr(float(-model.actuator_biasprm[servo, 2] * per))
            if model.actuator_forcelimited[servo]:
                drive.CreateMaxForceAttr(float(model.actuator_forcerange[servo, 1]))


def _add_passive(prim: Usd.Prim, model: mujoco.MjModel, joint: int) -> None:
    """Add what UsdPhysics has no word for, in MuJoCo's schema: MuJoCo and Newton read it."""
    degree = int(model.jnt_dofadr[joint])
    values = {
        "stiffness": model.jnt_stiffness[joint],
        "springref": model.qpos_spring[model.jnt_qposadr[joint]],
        "damping": model.dof_damping[degree],
        "frictionloss": model.dof_frictionloss[degree],
        "armature": model.dof_armature[degree],
    }
    prim.AddAppliedSchema("MjcJointAPI")
    for name, numbers in values.items():
        if value := float(np.ravel(numbers)[0]):
            attribute = prim.CreateAttribute(
                f"mjc:{name}", Sdf.ValueTypeNames.Double, False, Sdf.VariabilityUniform
            )
            attribute.Set(value)


def _vector(numbers: NDArray[np.float64]) -> Gf.Vec3f:
    return Gf.Vec3f(*map(float, numbers))


def _quat(rotation: Rotation) -> Gf.Quatf:
    return Gf.Quatf(*map(float, rotation.as_quat(scalar_first=True)))
