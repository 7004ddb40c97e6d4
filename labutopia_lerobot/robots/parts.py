"""What a robot's links and drives are made of: inertia, mesh, collision geometry, servo."""

from collections.abc import Iterable

import mujoco

from labutopia_lerobot.robots.meshes import load_mesh
from labutopia_lerobot.robots.robot import Element
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

type Vector = tuple[float, float, float]
type Inertia = tuple[float, float, float, float, float, float]
type Capsule = tuple[Vector, Vector, float]
"""End points of the axis in the body frame [m] and radius [m]."""


def set_inertia(body: mujoco.MjsBody, mass: float, centre: Vector, inertia: Inertia) -> None:
    """Give a body its published inertia instead of one derived from its geoms.

    Args:
        body: The body.
        mass: Mass [kg].
        centre: Centre of mass in the body frame [m].
        inertia: xx, yy, zz, xy, xz, yz about the centre of mass in the body frame [kg m^2].
    """
    body.explicitinertial = True
    body.mass = mass
    body.ipos = centre
    body.fullinertia = inertia


def add_visual_mesh(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, file: str, triangles: int, material: str
) -> None:
    """Add a mesh of `rtb-data`, thinned out, that is drawn but touches nothing and has no mass.

    Args:
        spec: The spec of the body; bodies with the same file share one mesh.
        body: The body, in whose frame the file is drawn.
        file: As in `load_mesh`.
        triangles: As in `load_mesh`.
        material: Name of a material of the spec.
    """
    name = file.removesuffix(".stl").rpartition("/")[-1]
    if spec.mesh(name) is None:
        vertices, faces = load_mesh(file, triangles)
        spec.add_mesh(
            name=name,
            uservert=vertices.ravel(),
            userface=faces.ravel(),
            # The files are not watertight, so they have no volume to weigh.
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
    body.add_geom(
        name=f"{body.name}_visual",
        type=mujoco.mjtGeom.mjGEOM_MESH,
        meshname=name,
        material=material,
        mass=0,
        contype=0,
        conaffinity=0,
        group=VISUAL_GROUP,
    )


def add_collision_box(
    body: mujoco.MjsBody, name: str, centre: Vector, half: Vector
) -> mujoco.MjsGeom:
    """Add a box that touches things but is not drawn.

    Args:
        body: The body.
        name: Name of the geom.
        centre: Centre in the body frame [m].
        half: Half lengths along the axes of the body frame [m].

    Returns:
        The geom.
    """
    return body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=centre,
        size=half,
        group=COLLISION_GROUP,
    )


def add_capsules(body: mujoco.MjsBody, capsules: Iterable[Capsule]) -> None:
    """Add capsules that touch things but are not drawn."""
    for index, (start, end, radius) in enumerate(capsules):
        body.add_geom(
            name=f"{body.name}_collision{index}",
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=(*start, *end),
            size=(radius, 0, 0),
            group=COLLISION_GROUP,
        )


def add_joint_servo(
    spec: mujoco.MjSpec, joint: Element, stiffness: float, damping: float, force: float
) -> None:
    """Add the position servo of an arm's joint, of its name (see `add_servo`)."""
    add_servo(
        spec,
        name=joint.name,
        target=joint.name,
        transmission=mujoco.mjtTrn.mjTRN_JOINT,
        control=(joint.lower, joint.upper),
        stiffness=stiffness,
        damping=damping,
        force=force,
    )


def add_servo(
    spec: mujoco.MjSpec,
    name: str,
    target: str,
    transmission: mujoco.mjtTrn,
    control: tuple[float, float],
    stiffness: float,
    damping: float,
    force: float,
) -> None:
    """Add a position servo whose force saturates.

    Args:
        spec: The spec.
        name: Name of the actuator.
        target: Name of the joint or tendon that it drives.
        transmission: Which of the two it is.
        control: Least and greatest target [rad or m].
        stiffness: Force per error [N m/rad or N/m].
        damping: Force per speed [N m s/rad or N s/m].
        force: Largest force [N m or N].
    """
    servo = spec.add_actuator(
        name=name,
        target=target,
        trntype=transmission,
        ctrlrange=control,
        ctrllimited=True,
        forcerange=(-force, force),
        forcelimited=True,
    )
    servo.set_to_position(kp=stiffness, kv=damping)
