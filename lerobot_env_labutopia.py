"""What LeRobot imports when it looks for plugins: registers `--env.type=labutopia`."""

import labutopia_lerobot.lerobot_plugin

__all__ = ["labutopia_lerobot"]
