"""Rigid bodies as other programs know them: things that move as one."""

import mujoco

FAR = 50.0
"""Half of the sides of a plane without end, once it is written [m]."""

_STILL = 0
"""The world: it carries all that never moves."""


def carriers(model: mujoco.MjModel) -> list[int]:
    """Return the body that each body moves with: itself, one above it, or the world.

    A body with several joints is a point of something soft, which is exported as if it were stiff.
    """
    moves_with = [_STILL]
    for body in range(1, model.nbody):
        own_joint = model.body_jntnum[body] == 1
        moves_with.append(body if own_joint else moves_with[model.body_parentid[body]])
    return moves_with


def is_joint(model: mujoco.MjModel, joint: int) -> bool:
    """Return whether a joint is a hinge or a slide that is the only one of its body."""
    kinds = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    alone = model.body_jntnum[model.jnt_bodyid[joint]] == 1
    return bool(model.jnt_type[joint] in kinds and alone)


def is_drawn(model: mujoco.MjModel, geom: int) -> bool:
    """Return whether a geom is there to be seen: MuJoCo shows groups 0 to 2."""
    return bool(model.geom_group[geom] <= 2)


def touches(model: mujoco.MjModel, geom: int) -> bool:
    """Return whether a geom can touch anything."""
    return bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
