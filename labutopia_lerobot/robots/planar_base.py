"""A body that slides and turns over the floor by servos of its velocity."""

import mujoco

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.mobile_base import MobileBase

_SLIDE, _HINGE = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
_KINDS = ((_SLIDE, (1, 0, 0)), (_SLIDE, (0, 1, 0)), (_HINGE, (0, 0, 1)))

type Gain = tuple[float, float]
"""Force per error of the velocity [N s/m or N m s/rad], and the largest force [N or N m]."""


def add_planar_base(
    spec: mujoco.MjSpec, parent: mujoco.MjsBody, base: MobileBase, sliding: Gain, turning: Gain
) -> mujoco.MjsBody:
    """Add the body of a base with its three joints and their servos, without mass or shape.

    Args:
        spec: The spec.
        parent: A body in the room's frame.
        base: Its names.
        sliding: Of the servos along x and y of the room.
        turning: Of the servo of the heading.

    Returns:
        The body.
    """
    body = parent.add_body(name=base.body, gravcomp=1)
    gains = (sliding, sliding, turning)
    for element, joint, (kind, axis), gain in zip(
        base.elements, base.joints, _KINDS, gains, strict=True
    ):
        body.add_joint(name=joint, type=kind, axis=axis)
        _add_velocity_servo(spec, element, joint, gain)
    return body


def _add_velocity_servo(spec: mujoco.MjSpec, element: Element, joint: str, gain: Gain) -> None:
    damping, force = gain
    servo = spec.add_actuator(
        name=element.name,
        target=joint,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        forcerange=(-force, force),
        forcelimited=True,
    )
    servo.set_to_velocity(kv=damping)
