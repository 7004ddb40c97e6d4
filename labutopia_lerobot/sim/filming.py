"""Pictures of an episode for people: smooth, from a camera of the task or from a nearer one."""

from functools import reduce

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.setting import CAMERAS
from labutopia_lerobot.sim.beauty_camera import beauty_camera
from labutopia_lerobot.sim.eye import eye_at, eye_of_camera
from labutopia_lerobot.sim.linear_light import graded, picture_of
from labutopia_lerobot.sim.supersampling import samples
from labutopia_lerobot.sim.workcell import Workcell

BEAUTY = "beauty"
FILM_CAMERAS = (BEAUTY, *CAMERAS)
"""Cameras that can film: the one of `sim.beauty_camera`, and those that policies see through."""


class FilmCamera:
    """A camera that films the episode in play.

    Args:
        cell: The work cell, at the beginning of an episode.
        camera: One of `FILM_CAMERAS`.
        aspect: Width over height of the picture.
        exposures: Of how many a picture is the mean; edges and shadows are the smoother.
    """

    def __init__(self, cell: Workcell, camera: str, aspect: float, exposures: int) -> None:
        self._cell, self._camera, self._samples = cell, camera, samples(exposures)
        self._pose = None
        if camera == BEAUTY:
            simulation = cell.simulation
            front = cell.task.view.front
            self._pose = beauty_camera(simulation.scene, simulation.data, front, aspect)

    def picture(self) -> NDArray[np.uint8]:
        """Return what is seen now, shape (height, width, 3)."""
        simulation, renderer = self._cell.simulation, self._cell.renderer
        model, data = simulation.scene.model, simulation.data
        simulation.draw_liquid()
        if self._pose is not None:
            eye = eye_at(model, self._pose)
        else:
            eye = eye_of_camera(model, data, self._camera)
        light = reduce(np.add, (renderer.exposure(data, eye, each) for each in self._samples))
        return picture_of(graded(light / np.float32(len(self._samples))))
