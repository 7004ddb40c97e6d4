"""LabUtopia on MuJoCo and LeRobot: laboratory tasks, their experts, datasets and evaluation."""

import os
import sys
from importlib.metadata import version

from labutopia_lerobot.gymnasium_ids import register_tasks

__version__ = version("lerobot_env_labutopia")

# MuJoCo picks its OpenGL when it is first imported; without a display only EGL can draw.
if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
    os.environ.setdefault("MUJOCO_GL", "egl")

register_tasks()
