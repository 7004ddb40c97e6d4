"""Checks that must hold for every task: each takes an environment and raises `CheckFailed`."""

from collections.abc import Callable

from labutopia_lerobot.checks import experts, judging, motions, replaying, scenes
from labutopia_lerobot.checks.require import CheckFailed
from labutopia_lerobot.env import LabEnv

type Check = Callable[[LabEnv], None]
"""Plays in an environment of the task; raises `CheckFailed` if its own name is not true."""

CHECKS: tuple[Check, ...] = (
    *scenes.CHECKS,
    *judging.CHECKS,
    *replaying.CHECKS,
    *experts.CHECKS,
    *motions.CHECKS,
)
"""Every check, the fast ones first."""

__all__ = ["CHECKS", "Check", "CheckFailed"]
