"""LabUtopia on the Hub: what `make_env("<owner>/<name>", trust_remote_code=True)` of LeRobot calls.

The simulator is the distribution `lerobot_env_labutopia`, which has to be installed: LeRobot
fetches this file alone, and does not install what `requirements.txt` lists.
"""

from dataclasses import fields
from typing import Any

TASK = "level1"
"""Tasks that are made when none is chosen: every task of the first level."""


def make_env(n_envs: int = 1, use_async_envs: bool = False, cfg: Any = None) -> Any:
    """Return level -> task name -> vector environment, for LeRobot.

    Args:
        n_envs: Environments in each vector environment.
        use_async_envs: Whether each of them has a process of its own.
        cfg: LeRobot's configuration, or None; of its fields those count that
            `--env.type=labutopia` has too.
    """
    from lerobot.envs import make_env_config

    import lerobot_env_labutopia  # noqa: F401  (registers the type)
    from labutopia_lerobot.setting import Setting

    given = {option.name: getattr(cfg, option.name, None) for option in fields(Setting)}
    chosen = {name: value for name, value in given.items() if value is not None}
    return make_env_config("labutopia", **({"task": TASK} | chosen)).create_envs(
        n_envs, use_async_envs
    )
