"""The pressed buttons: the electric contacts behind them."""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world import Button, FloatArray


class ButtonContacts:
    """Snap-action contacts: they click in at one travel of a button and out at a lesser one.

    Args:
        model: A model that the buttons have been built into.
        buttons: The buttons.
    """

    def __init__(self, model: mujoco.MjModel, buttons: Sequence[Button]) -> None:
        self._slides = [int(model.joint(button.joint).qposadr[0]) for button in buttons]
        self._in = np.array([button.travel for button in buttons])
        self._out = self._in - [button.differential for button in buttons]

    def update(self, data: mujoco.MjData, closed: FloatArray) -> NDArray[np.bool_]:
        """Return which contacts click in now, shape (buttons,).

        Args:
            data: MuJoCo's state.
            closed: Which contacts are in, 0 or 1, shape (buttons,); brought up to date.
        """
        now = data.qpos[self._slides] >= np.where(closed > 0.0, self._out, self._in)
        clicked: NDArray[np.bool_] = now & (closed == 0.0)
        closed[:] = now
        return clicked
