"""A blackboard on a wall."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Sash

_WIDE, _TALL = 2.400, 1.000
"""Width and height of each of the two boards [m]."""


@dataclass(frozen=True)
class Blackboard(Instrument):
    """Two green boards over each other; the front one is pushed up. Hung with its base at 0.8 m.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.130, 2.520, 2.100)
    mass = 75.0
    source = "two boards of 2400 x 1000 mm on columns, as usual in classrooms; from memory"
    passive = True

    @property
    def board(self) -> Sash:
        """The front one, on counterweights."""
        return Sash(f"{self.name}_board", 1.000)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.board,)

    def _forms(self) -> list[Form]:
        y = _WIDE / 2
        return [
            *(
                Block(
                    (-0.045, 0.065),
                    (s * (y + 0.03) - 0.03, s * (y + 0.03) + 0.03),
                    (0.0, 2.1),
                    "grey",
                )
                for s in (-1, 1)
            ),
            Block((0.020, 0.040), (-y, y), (1.06, 1.06 + _TALL), "chalkboard", 0.0),
            Block((0.015, 0.045), (-y, y), (1.04, 1.06), "light_grey", 0.0),
            Block((0.015, 0.045), (-y, y), (1.06 + _TALL, 1.08 + _TALL), "light_grey", 0.0),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        board = self.board.add_to(spec, body, (-0.010, 0.0, 0.030))
        y = _WIDE / 2 - 0.004
        forms: list[Form] = [
            Block((-0.010, 0.010), (-y, y), (0.015, _TALL), "chalkboard", 0.0),
            Block((-0.015, 0.015), (-y, y), (0.0, 0.020), "light_grey", 0.0),
            Block((-0.015, 0.015), (-y, y), (_TALL, _TALL + 0.015), "light_grey", 0.0),
            Block((-0.055, -0.010), (-0.60, 0.60), (0.0, 0.012), "light_grey"),
            Block((-0.050, -0.038), (-0.20, -0.12), (0.012, 0.024), "white"),
        ]
        assemble(spec, board, self.name, forms, mass=22.0)
