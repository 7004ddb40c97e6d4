"""A peristaltic pump with its hoses."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import mujoco

from labutopia_lerobot.labware.instruments.handling.peristaltic_pump import PeristalticPump
from labutopia_lerobot.labware.parts.conveying import Conveying
from labutopia_lerobot.labware.parts.drive import Pumping
from labutopia_lerobot.labware.parts.form import Form, Rod, towards
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world.model import COLLISION_GROUP

_OUTER, _BORE = 0.008, 0.0025
"""Outside diameter of the hoses, and inside radius [m]: tubing of 5 by 8 mm, a usual size."""
_X, _FRONT, _OVER = -0.104, -0.150, 0.130
"""Where they leave the head, where they run before it, clear of its shoe, and how high they cross
the rims of vessels [m]."""
_SUCTION: tuple[Vector, ...] = (
    (_X, 0.086, 0.030),
    (_FRONT, 0.086, 0.014),
    (_FRONT, 0.125, 0.014),
    (_FRONT, 0.125, _OVER),
    (_FRONT, 0.185, _OVER),
    (_FRONT, 0.185, 0.010),
)
"""From the head to the left, into a vessel that stands there, down to near its floor."""
_DELIVERY: tuple[Vector, ...] = (
    (_X, -0.002, 0.030),
    (_FRONT, -0.002, 0.014),
    (_FRONT, -0.125, 0.014),
    (_FRONT, -0.125, _OVER),
    (_FRONT, -0.185, _OVER),
    (_FRONT, -0.185, 0.095),
)
"""From the head to the right, and down towards a vessel that stands there."""


@dataclass(frozen=True)
class TransferPump(PeristalticPump):
    """A peristaltic pump that draws from a vessel on its left and fills one on its right.

    Its hoses are stiff, full from the start, and no siphon when its shoe is open.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    size = (0.264, 0.378, 0.150)
    mass = 3.7
    source = "the pump's, with hoses of 5 x 8 mm; from memory"
    left_out = "its hoses do not bend, and empty nothing through an open shoe"

    @property
    def draws_at(self) -> str:
        """Name of the frame at the end of its suction hose."""
        return f"{self.name}_inlet"

    @property
    def gives_at(self) -> str:
        """Name of the frame at the end of its delivery hose; z the way that liquid leaves."""
        return f"{self.name}_outlet"

    @property
    def flow(self) -> Pumping:
        """What it delivers."""
        return Conveying(
            f"{self.name}_flow",
            self.drive,
            self.per_turn,
            self.name,
            self.draws_at,
            self.gives_at,
            _BORE,
        )

    def _forms(self) -> list[Form]:
        return [*super()._forms(), *_hose(_SUCTION), *_hose(_DELIVERY)]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        super()._add_parts(spec, body)
        down = towards((0.0, 0.0, -1.0))
        for name, line in ((self.draws_at, _SUCTION), (self.gives_at, _DELIVERY)):
            body.add_site(name=name, pos=line[-1], quat=down, group=COLLISION_GROUP)


def _hose(line: Sequence[Vector]) -> list[Form]:
    return [Rod(a, b, _OUTER, "orange") for a, b in pairwise(line)]
