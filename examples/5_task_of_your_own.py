"""A task of your own: `tasks/level1/raise_cylinder.py`, played by its expert through Gymnasium.

The same folder is an option of every program: `labutopia-view level1/raise_cylinder
--tasks-dir examples/tasks`; `labutopia-check examples/tasks` checks what must hold of every task.
"""

import argparse
from pathlib import Path

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting

TASKS = Path(__file__).parent / "tasks"


def main() -> None:
    """Play some seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=3)
    given = parser.parse_args()
    env = LabEnv(Setting("level1/raise_cylinder", obs="state", tasks_dir=str(TASKS)))
    for seed in range(given.episodes):
        env.reset(seed=seed)
        expert = env.expert()
        expert.start()
        over = False
        while not over:
            _, _, terminated, truncated, info = env.step(expert.act())
            over = terminated or truncated
        print(f"{env.task} Seed {seed}: {info['outcome']}")


if __name__ == "__main__":
    main()
