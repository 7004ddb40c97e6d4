"""`python scripts/compile_kernels.py`: compile what nearly every test needs, once and not in each.

It plays two steps of a task in which liquids mix and react, and draws them.
"""

from labutopia_lerobot.checks.playing import still
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting


def main() -> None:
    """Play and draw."""
    env = LabEnv(Setting("level2/neutralise", cameras=("front",), width=64, height=48))
    env.reset(seed=0)
    for _ in range(2):
        env.step(still(env).act())
    env.close()


if __name__ == "__main__":
    main()
