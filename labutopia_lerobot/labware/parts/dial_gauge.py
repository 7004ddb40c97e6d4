"""Dial gauges: a needle that a process turns."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.form import Form, Rod
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world.model import VISUAL_GROUP

_SWEEP = math.radians(270.0)
"""From the lowest to the highest mark, clockwise, evenly about the top (EN 837-1; from memory)."""
_MARKS = 7
_NEEDLE = (0.75, 0.05, 0.0004)
"""Length and width of a needle in parts of the radius, and its thickness [m]."""


@dataclass(frozen=True)
class DialGauge(Process):
    """A round gauge that faces -x of what carries it; it shows a reading and remembers nothing.

    Attributes:
        name: Of the geom of its needle.
        of: What it shows.
        highest: Reading at its last mark.
        radius: Of its face [m].
        center: Middle of its face in the frame of what carries it [m].
        lowest: Reading at its first mark.
    """

    name: str
    of: Process
    highest: float
    radius: float
    center: Vector
    lowest: float = 0.0

    @property
    @override
    def displayed(self) -> tuple[str, ...]:
        return (self.of.name,)

    def angle(self, value: float) -> float:
        """Return where a needle stands for a reading, clockwise from the top [rad]."""
        share = (value - self.lowest) / (self.highest - self.lowest)
        return (min(max(share, 0.0), 1.0) - 0.5) * _SWEEP

    @override
    def show(self, apparatus: Apparatus) -> None:
        model, data = apparatus.model, apparatus.data
        geom = model.geom(self.name)
        carrier = data.body(int(geom.bodyid[0]))
        reading = self.of.reading(apparatus)
        angle = self.angle(self.lowest if reading is None else reading.value)
        _, y, z = self._on_face(angle, _NEEDLE[0] / 2)
        turn, to = carrier.xmat.reshape(3, 3), np.array([self.center[0] - 0.001, y, z])
        along = np.array([0.0, -math.sin(angle), math.cos(angle)])
        ahead = np.array([1.0, 0.0, 0.0])
        data.geom_xpos[int(geom.id)] = carrier.xpos + turn @ to
        frame = np.column_stack([ahead, np.cross(along, ahead), along])
        data.geom_xmat[int(geom.id)] = (turn @ frame).ravel()

    def forms(self) -> tuple[Form, ...]:
        """Return its face, a rim and the marks, in the frame of what carries it."""
        x, y, z = self.center
        marks = [(n / (_MARKS - 1) - 0.5) * _SWEEP for n in range(_MARKS)]
        wide, front = 0.09 * self.radius, x - 0.0006
        return (
            Rod((x - 0.0006, y, z), (x, y, z), 2 * self.radius, "white", touch=False),
            *(
                Rod(
                    (front, *self._on_face(mark, 0.72)[1:]),
                    (front, *self._on_face(mark, 0.92)[1:]),
                    wide,
                    "black",
                    touch=False,
                    segments=4,
                )
                for mark in marks
            ),
        )

    def add_to(self, body: mujoco.MjsBody, material: str) -> None:
        """Build its needle onto what carries it, at its first mark.

        Args:
            body: What carries it.
            material: Of the needle.
        """
        long, wide, thick = _NEEDLE
        half = (thick / 2, wide * self.radius / 2, long * self.radius / 2)
        body.add_geom(
            name=self.name,
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=half,
            pos=self.center,
            material=material,
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )

    def _on_face(self, angle: float, out: float) -> Vector:
        """Return a point of the face, `out` radii from its middle; y is to the left."""
        x, y, z = self.center
        far = out * self.radius
        return (x, y - far * math.sin(angle), z + far * math.cos(angle))
