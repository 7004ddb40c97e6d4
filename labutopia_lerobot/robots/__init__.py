"""Robots: kinematics, limits, actuators and the cameras they carry, as MuJoCo specs."""

from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.robots.robot import Robot

__all__ = ["PANDA", "Robot"]
