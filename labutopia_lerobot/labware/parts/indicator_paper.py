"""Universal indicator paper: a strip that takes the colour of what wets it."""

import math
from dataclasses import dataclass
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.chemistry.colour import Rgb
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

SCALE: dict[int, Rgb] = {
    1: (0.83, 0.16, 0.22),
    3: (0.93, 0.42, 0.22),
    5: (0.95, 0.72, 0.22),
    6: (0.84, 0.80, 0.26),
    7: (0.52, 0.69, 0.26),
    8: (0.24, 0.55, 0.34),
    9: (0.13, 0.45, 0.42),
    10: (0.12, 0.35, 0.50),
    12: (0.20, 0.22, 0.48),
    14: (0.33, 0.15, 0.42),
}
"""pH -> colour, sRGB: red, yellow, green, blue, violet, as on rolls for pH 1 to 14; from memory."""

DRY: Rgb = (0.92, 0.80, 0.42)
"""Of a strip that nothing has wetted: yellow of its dyes."""


@dataclass(frozen=True)
class IndicatorPaper(Process):
    """A strip of indicator paper: it keeps the colour of the last drop that wetted it.

    Its reading is the nearest whole pH, which is what an eye finds on the scale; dashes while it
    is dry. What has no known pH leaves it as it is: liquids without water, and any liquid of a
    scene in which nothing is dissolved.

    Attributes:
        name: What its reading is called, and the geom that is seen of it.
        size: Along x and along y [m].
    """

    name: str
    size: tuple[float, float]

    @property
    @override
    def slots(self) -> tuple[str, ...]:
        return ("wetted", "ph")

    @override
    def start(self, apparatus: Apparatus, rng: np.random.Generator) -> None:
        self.step(apparatus)

    @override
    def step(self, apparatus: Apparatus) -> None:
        if apparatus.liquid is None:
            return
        drop = apparatus.liquid.drop_on(apparatus.site(self.name), self.size)
        if drop is not None and not math.isnan(drop.ph):
            apparatus.memory(self)[:] = 1.0, drop.ph

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        wetted, ph = apparatus.memory(self)
        return Reading(round(np.clip(ph, *_ENDS)) if wetted else math.nan, "pH", 1.0)

    @override
    def show(self, apparatus: Apparatus) -> None:
        wetted, ph = apparatus.memory(self)
        apparatus.model.geom(self.name).rgba = (*(color_of(ph) if wetted else DRY), 1.0)

    def add_to(self, body: mujoco.MjsBody, pos: Vector) -> None:
        """Lay it onto a body, dry.

        Args:
            body: What carries it.
            pos: Its middle, on the surface, in the frame of the body [m].
        """
        add_patch(body, self.name, pos, self.size, DRY)
        body.add_site(name=self.name, pos=pos, group=COLLISION_GROUP)


_ENDS = min(SCALE), max(SCALE)


def color_of(ph: float) -> Rgb:
    """Return the colour of wet paper, sRGB; between the steps of the scale it is mixed."""
    steps = list(SCALE)
    red, green, blue = (
        float(np.interp(ph, steps, channel)) for channel in zip(*SCALE.values(), strict=True)
    )
    return red, green, blue


def add_patch(
    body: mujoco.MjsBody, name: str, pos: Vector, size: tuple[float, float], color: Rgb
) -> None:
    """Lay a thin coloured patch onto a body, which is seen only.

    Args:
        body: What carries it.
        name: Of its geom.
        pos: Its middle, on the surface, in the frame of the body [m].
        size: Along x and along y [m].
        color: Red, green, blue, sRGB from 0 to 1.
    """
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=(0.5 * size[0], 0.5 * size[1], _THICK),
        pos=pos,
        rgba=(*color, 1.0),
        group=VISUAL_GROUP,
        contype=0,
        conaffinity=0,
        mass=0,
    )


_THICK = 0.0003
"""Half of a patch's thickness [m]: enough that no renderer mixes it with what it lies on."""
