"""MuJoCo's window onto a simulation, with its liquid."""

import os
import sys
import time
from types import TracebackType
from typing import Self

import mujoco.viewer

from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.world import CONTROL_HZ


def has_display() -> bool:
    """Return whether a window can be opened here."""
    return sys.platform != "linux" or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )


class Viewer:
    """A window that looks at the bench; a context manager that closes it.

    Args:
        simulation: What to look at.
        height: Height of the bench top [m], world frame.
    """

    def __init__(self, simulation: Simulation, height: float) -> None:
        self.simulation = simulation
        self._window = mujoco.viewer.launch_passive(
            simulation.scene.model, simulation.data, show_left_ui=False, show_right_ui=False
        )
        camera = self._window.cam
        camera.lookat[:] = (0.2, 0.0, height + 0.15)
        camera.distance, camera.azimuth, camera.elevation = 1.3, 150.0, -20.0
        self._shown = time.monotonic()

    @property
    def is_open(self) -> bool:
        """Whether nobody has closed the window."""
        return bool(self._window.is_running())

    def show(self) -> None:
        """Show the present moment, one control period after the one before."""
        with self._window.lock():
            self.simulation.draw_particles(self._window.user_scn)
        self._window.sync()
        time.sleep(max(0.0, 1.0 / CONTROL_HZ - (time.monotonic() - self._shown)))
        self._shown = time.monotonic()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._window.close()
