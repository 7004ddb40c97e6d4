"""Where a piece belongs, in general; `in_rooms` and `at_things` say where there is."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Protocol

from labutopia_lerobot.scenes.generation.spots import Patch
from labutopia_lerobot.scenes.space.extent import Extent

if TYPE_CHECKING:
    from labutopia_lerobot.scenes.generation.footprint import Region
    from labutopia_lerobot.scenes.generation.sketch import Sketch


class Where(Protocol):
    """Where a piece belongs."""

    @property
    def walkway(self) -> tuple[float, float, float]:
        """How far other furniture keeps away before it, behind it and beside it [m]."""
        ...

    @property
    def on_floor(self) -> bool:
        """Whether it stands on the floor, and neither hangs nor stands on something."""
        ...

    @property
    def edge(self) -> float:
        """How much better it stands near an edge or a corner than in the open, -1 to 1."""
        ...

    @property
    def apart(self) -> float:
        """How far it had better be from what stands on the same ground [m]; 0: in a row."""
        ...

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where in a region a piece of a kind could be, whatever else is there."""
        ...

    def spelt(self, kind: Extent) -> str:
        """Write how much room a piece of a kind needs."""
        ...
