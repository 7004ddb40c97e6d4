"""Parts of a robot's links and drives: inertia, mesh, collision geometry, servo."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial

import mujoco
import numpy as np

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.mesh_package import RTB_DATA, MeshPackage
from labutopia_lerobot.robots.meshes import (
    PlacedMesh,
    load_assembly,
    load_mesh,
)
from labutopia_lerobot.robots.thinning import ThinMesh
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

type Vector = tuple[float, float, float]
type Inertia = tuple[float, float, float, float, float, float]
type Capsule = tuple[Vector, Vector, float]
"""End points of the axis in the body frame [m] and radius [m]."""

_TONES = 32
"""Width of the texture that tones are looked up in [pixels]."""


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
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    file: str,
    triangles: int,
    material: str,
    package: MeshPackage = RTB_DATA,
) -> None:
    """Add a mesh, thinned out, that is drawn but touches nothing and has no mass.

    Args:
        spec: The spec of the body; bodies with the same file share one mesh.
        body: The body, in whose frame the file is drawn.
        file: As in `load_mesh`.
        triangles: As in `load_mesh`.
        material: Name of a material of the spec.
        package: As in `load_mesh`.
    """
    name = file.rpartition(".")[0].rpartition("/")[-1]
    _add_mesh(spec, body, name, partial(load_mesh, file, triangles, package), material)


def add_assembly(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    name: str,
    placed: Sequence[PlacedMesh],
    material: str,
    package: MeshPackage = RTB_DATA,
) -> None:
    """Add several meshes as one, otherwise like `add_visual_mesh`.

    Args:
        spec: The spec of the body.
        body: The body.
        name: Of the mesh.
        placed: The files, and where they are in the body's frame.
        material: Name of a material of the spec.
        package: As in `load_mesh`.
    """
    _add_mesh(spec, body, name, partial(load_assembly, name, placed, package), material)


def _add_mesh(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    name: str,
    load: Callable[[], ThinMesh],
    material: str,
) -> None:
    """Add a mesh to a body, and to the spec if it has none of this name."""
    if spec.mesh(name) is None:
        mesh = load()
        spec.add_mesh(
            name=name,
            uservert=mesh.vertices.ravel(),
            usernormal=mesh.normals.ravel(),
            # Where a material has tones (see `add_tones`), this is the vertex's place in them.
            usertexcoord=np.repeat((0.5 + (_TONES - 1) * mesh.tones) / _TONES, 2),
            userface=mesh.faces.ravel(),
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


def add_tones(
    spec: mujoco.MjSpec, name: str, *tones: tuple[float, Vector], specular: float, shininess: float
) -> None:
    """Add a material that meshes of several shades are drawn in, one geom for all of them.

    Args:
        spec: The spec.
        name: Of the material and its texture.
        *tones: How bright a part is in the file, rising, and the colour that it gets.
        specular: How strongly it reflects lights, 0 to 1.
        shininess: How small their reflections are, 0 to 1.
    """
    shades, colors = zip(*tones, strict=True)
    levels = np.linspace(0.0, 1.0, _TONES)
    channels = zip(*colors, strict=True)
    row = np.column_stack([np.interp(levels, shades, channel) for channel in channels])
    texture = spec.add_texture(
        name=name, type=mujoco.mjtTexture.mjTEXTURE_2D, nchannel=3, width=_TONES, height=_TONES
    )
    texture.data = np.rint(255 * np.tile(row, (_TONES, 1, 1))).astype(np.uint8).tobytes()
    material = spec.add_material(name=name, specular=specular, shininess=shininess)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name


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
