"""Putting forms onto a body: one mesh for the eye per finish, primitives for hands and planners."""

from collections.abc import Iterable
from typing import Any

import mujoco

from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.form import Form, Primitive
from labutopia_lerobot.labware.parts.shell import Shell, joined, negligible
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, VISUAL_GROUP


def assemble(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, piece: str, forms: Iterable[Form], mass: float = 0.0
) -> None:
    """Make a body look, feel and weigh as forms do; once for every body.

    Geoms: `<body>_<finish>` to be seen, `<body>_<n>_contact` and `<body>_<n>_hull`.

    Args:
        spec: What the body is in.
        body: Still without forms.
        piece: Name of the piece, prefix of its materials.
        forms: In the body's frame.
        mass: Of all of them [kg]; 0 for what is fixed.

    Raises:
        ValueError: If the body is to weigh something and nothing of it can be touched.
    """
    shells: dict[str, list[Shell]] = {}
    primitives: list[Primitive] = []
    for form in forms:
        if not negligible(drawn := form.shell()):
            shells.setdefault(form.look, []).append(drawn)
        primitives += form.primitives() if form.touch else ()
    for look, parts in shells.items():
        _add_look(spec, body, f"{body.name}_{look}", joined(parts), finish(spec, piece, look))
    volume = sum(primitive.volume for primitive in primitives)
    if mass and not volume:
        raise ValueError(f"{body.name} weighs {mass} kg, but nothing of it can be touched")
    for number, primitive in enumerate(primitives):
        share = mass * primitive.volume / volume
        _add_touched(spec, body, f"{body.name}_{number}", primitive, share)


def _add_look(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, mesh: Shell, material: str
) -> None:
    vertices, normals, faces = mesh
    spec.add_mesh(
        name=name,
        uservert=vertices.ravel(),
        usernormal=normals.ravel(),
        userface=faces.ravel(),
        userfacenormal=faces.ravel(),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
    )
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_MESH,
        meshname=name,
        material=material,
        group=VISUAL_GROUP,
        contype=0,
        conaffinity=0,
        mass=0,
    )


def _add_touched(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, primitive: Primitive, mass: float
) -> None:
    """Add what can be touched, and around it what the planner keeps away from."""
    shape, size, pos, quat, _, points = primitive
    where: dict[str, Any] = {"size": size, "pos": pos, "quat": quat}
    if points:
        spec.add_mesh(name=f"{name}_contact", uservert=points)
        where = {"meshname": f"{name}_contact"}
    body.add_geom(name=f"{name}_contact", type=shape, group=COLLISION_GROUP, mass=mass, **where)
    unfelt = {"group": HULL_GROUP, "contype": 0, "conaffinity": 0, "mass": 0}
    body.add_geom(name=f"{name}_hull", type=shape, **where, **unfelt)
