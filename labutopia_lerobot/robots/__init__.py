"""Robots: names, limits and postures as data; kinematics and servos as MuJoCo specs, on demand."""

from labutopia_lerobot.robots.iiwa import IIWA
from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.robots.robot import Element, ParallelGripper, Robot, UnknownRobotError

ROBOTS = {robot.name: robot for robot in (PANDA, IIWA)}
"""Every robot by its name."""

DEFAULT_ROBOT = PANDA.name
"""The robot of the paper's levels 1 to 4."""


def load_robot(name: str) -> Robot:
    """Return the robot of a name.

    Raises:
        UnknownRobotError: If there is none; the message lists the choices.
    """
    if name not in ROBOTS:
        raise UnknownRobotError(f"robot={name!r} is unknown. Choose from: {', '.join(ROBOTS)}")
    return ROBOTS[name]


__all__ = [
    "DEFAULT_ROBOT",
    "IIWA",
    "PANDA",
    "ROBOTS",
    "Element",
    "ParallelGripper",
    "Robot",
    "UnknownRobotError",
    "load_robot",
]
