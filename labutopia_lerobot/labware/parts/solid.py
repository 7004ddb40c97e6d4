"""Rigid parts of instruments: the same primitive for the eye, for contacts and for the planner."""

import mujoco

from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, VISUAL_GROUP

type Vector = tuple[float, float, float]
type Quaternion = tuple[float, float, float, float]

BOX = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER
MESH = mujoco.mjtGeom.mjGEOM_MESH

UNTURNED: Quaternion = (1.0, 0.0, 0.0, 0.0)


def add_part(
    body: mujoco.MjsBody,
    name: str,
    size: Vector,
    pos: Vector,
    material: str,
    *,
    mass: float = 0.0,
    shape: mujoco.mjtGeom = BOX,
    quat: Quaternion = UNTURNED,
) -> None:
    """Add a solid part: `<name>` to be seen and weighed, `<name>_contact` and `<name>_hull`.

    Args:
        body: What it is part of.
        name: Prefix of the three geoms.
        size: Half sizes of a box, or radius and half length of a cylinder [m].
        pos: Its centre in the body's frame [m].
        material: Name of a material of the spec.
        mass: Its mass [kg].
        shape: Box or cylinder.
        quat: Its orientation in the body's frame, scalar-first.
    """
    add_look(body, name, size, pos, material, mass=mass, shape=shape, quat=quat)
    for suffix, group, collides in (("contact", COLLISION_GROUP, 1), ("hull", HULL_GROUP, 0)):
        body.add_geom(
            name=f"{name}_{suffix}",
            type=shape,
            size=size,
            pos=pos,
            quat=quat,
            group=group,
            contype=collides,
            conaffinity=collides,
            mass=0,
        )


def add_look(
    body: mujoco.MjsBody,
    name: str,
    size: Vector,
    pos: Vector,
    material: str,
    *,
    mass: float = 0.0,
    shape: mujoco.mjtGeom = BOX,
    quat: Quaternion = UNTURNED,
) -> None:
    """Add a part that is seen and weighed, but that nothing can touch; see `add_part`."""
    body.add_geom(
        name=name,
        type=shape,
        size=size,
        pos=pos,
        quat=quat,
        material=material,
        group=VISUAL_GROUP,
        contype=0,
        conaffinity=0,
        mass=mass,
    )


def add_feet(
    body: mujoco.MjsBody,
    name: str,
    base: tuple[float, float],
    height: float,
    material: str,
    *,
    above: float = 0.0,
) -> None:
    """Add four round feet to be seen, `<name>_foot_0` to `_3`, near the corners of a base.

    Args:
        body: What stands on them.
        name: Prefix of the geoms.
        base: Half depth and half width of the base, whose centre is the body's origin [m].
        height: From what they stand on to the base [m].
        material: Name of a material of the spec.
        above: How high they stand above the body's origin [m].
    """
    x, y = base
    for foot, (side, end) in enumerate(((-1, -1), (-1, 1), (1, -1), (1, 1))):
        pos = (side * 0.85 * x, end * 0.85 * y, above + height / 2)
        size = (0.02, height / 2, 0.0)
        add_look(body, f"{name}_foot_{foot}", size, pos, material, shape=CYLINDER)
