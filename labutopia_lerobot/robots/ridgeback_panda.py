"""The Franka Emika Panda on a Clearpath Ridgeback (paper, "Robots" and "Navigation Details")."""

from dataclasses import replace
from typing import TYPE_CHECKING

from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.robots.ridgeback import RIDGEBACK

if TYPE_CHECKING:
    import mujoco


def _add_to(spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> None:
    from labutopia_lerobot.robots.ridgeback_model import add_ridgeback  # here: it imports mujoco

    PANDA.add_to(spec, add_ridgeback(spec, parent, RIDGEBACK))


_STOWED = (1.574, -1.086, 0.340, -2.733, -1.083, 1.104, -0.614)
"""Hand at (0.12, 0.15, 0.55) m before the arm's base, 20 degrees to the right, pitched as it comes
to vessels; ours: hand, elbow and a beaker in it are within 0.6 m of the middle of the base, the
paper's disc."""

RIDGEBACK_PANDA = replace(
    PANDA, name="ridgeback_panda", add_to=_add_to, base=RIDGEBACK, stowed=_STOWED
)
