"""Interface of the places where a piece belongs; `in_rooms` and `at_things` implement it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.scenes.generation.spots import Patch
from labutopia_lerobot.scenes.plan import Heading, Placed
from labutopia_lerobot.scenes.space.extent import Extent, extent


class Walls(Protocol):
    """Walls that enclose a room of a plan."""

    @property
    def x(self) -> tuple[float, float]:
        """Least and greatest [m]."""
        ...

    @property
    def y(self) -> tuple[float, float]:
        """Least and greatest [m]."""
        ...

    @property
    def outer(self) -> frozenset[Heading]:
        """Its outer walls, by the way that they face."""
        ...


@dataclass(frozen=True)
class StandingPieces:
    """Pieces that already stand in a room of a plan.

    Attributes:
        pieces: In the order in which they came.
    """

    pieces: tuple[Placed, ...]

    def tops(self, kinds: Sequence[str]) -> Iterator[tuple[Placed, Top]]:
        """Yield what can be stood on, of some kinds."""
        for piece in self.pieces:
            if piece.kind in kinds:
                yield from ((piece, top) for top in extent(piece.kind).tops)

    def of_kind(self, kind: str) -> list[Placed]:
        """Return the pieces of a kind."""
        return [piece for piece in self.pieces if piece.kind == kind]


class Where(Protocol):
    """The kind of place where a piece belongs."""

    @property
    def walkway(self) -> tuple[float, float, float]:
        """Space that other furniture leaves free before it, behind it and beside it [m]."""
        ...

    @property
    def on_floor(self) -> bool:
        """Whether it stands on the floor, and neither hangs nor stands on something."""
        ...

    @property
    def edge(self) -> float:
        """Preference for an edge or a corner over the open, -1 to 1."""
        ...

    @property
    def apart(self) -> float:
        """Preferred distance from what stands on the same ground [m]; 0: in a row."""
        ...

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where in a room a piece of a kind could be, whatever else is there."""
        ...

    def describe(self, kind: Extent) -> str:
        """Write how much room a piece of a kind needs."""
        ...
