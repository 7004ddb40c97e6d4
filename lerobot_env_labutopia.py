"""What LeRobot imports when it looks for plugins: registers our environment, robot and policy.

Its trainings read our recordings of states from memory.

A mistake that shows only in play, such as one in a user's own predicate, ends LeRobot's programs in
one message, as it ends ours.
"""

import sys

import labutopia_lerobot.behaviour_cloning
import labutopia_lerobot.devices
import labutopia_lerobot.lerobot_plugin
from labutopia_lerobot.cli.clear_errors import show_clearly
from labutopia_lerobot.datasets.frames_in_memory import keep_frames_in_memory

__all__ = ["labutopia_lerobot"]

keep_frames_in_memory()
sys.excepthook = show_clearly
