"""What LeRobot imports when it looks for plugins: registers our environment, robot and policy."""

import labutopia_lerobot.behaviour_cloning
import labutopia_lerobot.devices
import labutopia_lerobot.lerobot_plugin

__all__ = ["labutopia_lerobot"]
