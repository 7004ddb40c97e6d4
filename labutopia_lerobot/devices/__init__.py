"""Devices for LeRobot's programs for real robots: a `Robot`, and what a person moves it with."""

from labutopia_lerobot.devices.config_lerobot_robot import LabUtopiaRobotConfig
from labutopia_lerobot.devices.config_teleoperator import LabUtopiaTeleoperatorConfig
from labutopia_lerobot.devices.lerobot_robot import LabUtopiaRobot
from labutopia_lerobot.devices.teleoperator import LabUtopiaTeleoperator

__all__ = [  # LeRobot looks here for the device of a config
    "LabUtopiaRobot",
    "LabUtopiaRobotConfig",
    "LabUtopiaTeleoperator",
    "LabUtopiaTeleoperatorConfig",
]
