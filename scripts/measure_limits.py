"""`python scripts/measure_limits.py`: how near the experts come to what their robot can do.

Prints a table in Markdown: for every task how many of its episodes succeeded, and the greatest
share of each limit that any of them reached at any physics step: speed, acceleration and jerk of
the set-points, speed of the hand, torque of the servos. Experts stay below 90 % of the motion's
and 60 % of the torques'. Without liquid, which moves no joint.
"""

import argparse
import sys
from collections.abc import Iterable

from labutopia_lerobot.checks.motions import motion_and_torque
from labutopia_lerobot.checks.playing import expert, play
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.registry import require_task, task_files
from labutopia_lerobot.setting import Setting

KINDS = ("speed of", "acceleration of", "jerk of", "speed of the hand", "torque")

FIRST_SEED = 100000
"""First seed of the episodes: those of the README's rates."""


@clear_errors
def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tasks", nargs="*", help="default: all")
    parser.add_argument("--episodes", type=int, default=100, help="of every task (default: 100)")
    arguments = parser.parse_args()
    for task in arguments.tasks:
        require_task(task)
    sys.stdout.write("| task | succeeded | speed | acceleration | jerk | hand | torque |\n")
    sys.stdout.write("| --- | --- |" + " ---: |" * len(KINDS) + "\n")
    for task in arguments.tasks or task_files():
        seeds = range(FIRST_SEED, FIRST_SEED + arguments.episodes)
        sys.stdout.write(f"{row(task, seeds)}\n")
        sys.stdout.flush()


def row(task: str, seeds: Iterable[int]) -> str:
    """Return the row of a task's expert."""
    env = LabEnv(Setting(task, obs="state", liquid="off"))
    greatest = dict.fromkeys(KINDS, 0.0)
    succeeded = []
    for seed in seeds:
        motion, torque = motion_and_torque(env, seed)
        for name, share in motion.items():
            kind = name if name in KINDS else f"{name.split()[0]} of"
            greatest[kind] = max(greatest[kind], share)
        greatest["torque"] = max(greatest["torque"], *torque.values())
        succeeded.append(bool(play(env, expert, seed).trace[-1][1]["is_success"]))
    env.close()
    shares = " | ".join(f"{share:.0%}" for share in greatest.values())
    return f"| `{task}` | {sum(succeeded)} of {len(succeeded)} | {shares} |"


if __name__ == "__main__":
    main()
