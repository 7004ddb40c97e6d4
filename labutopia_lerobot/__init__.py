"""LabUtopia on MuJoCo and LeRobot: laboratory tasks, their experts, datasets and evaluation."""

from importlib.metadata import version

from labutopia_lerobot.gymnasium_ids import register_tasks
from labutopia_lerobot.sim.opengl import choose_backend

__version__ = version("lerobot_env_labutopia")

choose_backend()
register_tasks()
