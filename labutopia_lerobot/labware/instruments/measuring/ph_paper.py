"""Strips of pH paper on a tile."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.indicator_paper import SCALE, IndicatorPaper, add_patch
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.processes import Process

_TOP = 0.006
"""Thickness of the tile [m]."""
_APART = 0.030
"""From strip to strip [m]: a drop wets one only."""


@dataclass(frozen=True)
class PhPaper(Instrument):
    """Four strips of pH paper on a tile: a drop colours the strip that it falls on.

    Behind them is the scale, pH 1 to 14 from left to right.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.090, 0.130, _TOP)
    mass = 0.16
    movable = True
    source = "porcelain tile; strips of 7 mm from a roll, made broader for a drop; from memory"
    left_out = "strips are not torn off: each keeps the last drop on it"

    @property
    def strips(self) -> tuple[IndicatorPaper, ...]:
        """The strips, from left to right."""
        size = (0.050, 0.016)
        return tuple(IndicatorPaper(f"{self.name}_strip_{n}", size) for n in range(1, 5))

    @property
    def works(self) -> tuple[Process, ...]:
        return self.strips

    def _forms(self) -> list[Form]:
        return [Block((-0.045, 0.045), (-0.065, 0.065), (0.0, _TOP), "ceramic", edge=0.002)]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for strip, left in zip(self.strips, (1.5, 0.5, -0.5, -1.5), strict=True):
            strip.add_to(body, (-0.012, left * _APART, _TOP))
        wide = 0.110 / len(SCALE)
        for place, (ph, color) in enumerate(SCALE.items()):
            at = (0.030, 0.055 - (place + 0.5) * wide, _TOP)
            add_patch(body, f"{self.name}_scale_{ph}", at, (0.014, 0.9 * wide), color)
