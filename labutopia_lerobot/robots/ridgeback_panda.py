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


RIDGEBACK_PANDA = replace(PANDA, name="ridgeback_panda", add_to=_add_to, base=RIDGEBACK)
