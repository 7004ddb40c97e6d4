"""What LeRobot's programs for real robots drive: the environment as a `Robot`."""

from labutopia_lerobot.devices.config_robot import LabUtopiaRobotConfig
from labutopia_lerobot.devices.robot import LabUtopiaRobot

__all__ = ["LabUtopiaRobot", "LabUtopiaRobotConfig"]  # LeRobot looks here for the robot of a config
