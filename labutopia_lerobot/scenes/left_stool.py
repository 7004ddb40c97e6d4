"""A stool that somebody has left standing in the way."""

from dataclasses import dataclass
from typing import ClassVar

from labutopia_lerobot.labware.instruments.support.stool import Stool


@dataclass(frozen=True)
class LeftStool(Stool):
    """A stool on the floor, which no map shows.

    It stands fast: who touches it has run into it.

    Attributes:
        walks: It stands where it was left.
    """

    movable = False
    walks: ClassVar[bool] = False
    height: ClassVar[float] = Stool.size[2]
