"""Robots: names, limits and postures as data; kinematics and servos as MuJoCo specs, on demand."""

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.fetch import FETCH, FETCH_DIFFERENTIAL
from labutopia_lerobot.robots.iiwa import IIWA
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.robots.ridgeback_panda import RIDGEBACK_PANDA
from labutopia_lerobot.robots.robot import ParallelGripper, Robot, UnknownRobotError

ROBOTS = {robot.name: robot for robot in (PANDA, IIWA, RIDGEBACK_PANDA, FETCH, FETCH_DIFFERENTIAL)}
"""Every robot by its name."""


def load_robot(name: str) -> Robot:
    """Return the robot of a name.

    Raises:
        UnknownRobotError: If there is none; the message lists the choices.
    """
    if name not in ROBOTS:
        raise UnknownRobotError(f"robot={name!r} is unknown. Choose from: {', '.join(ROBOTS)}")
    return ROBOTS[name]


__all__ = [
    "FETCH",
    "FETCH_DIFFERENTIAL",
    "IIWA",
    "PANDA",
    "RIDGEBACK_PANDA",
    "ROBOTS",
    "Element",
    "MobileBase",
    "ParallelGripper",
    "Robot",
    "UnknownRobotError",
    "load_robot",
]
