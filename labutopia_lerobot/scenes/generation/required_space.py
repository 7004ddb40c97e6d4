"""The space that a piece requires in a room that is being planned, walkways included."""

from dataclasses import dataclass
from functools import cache, cached_property

from labutopia_lerobot.scenes.generation.family import Need
from labutopia_lerobot.scenes.plan import Heading, Placed, WorkPlace
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_work_place
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.world import FloatArray

WORK_BENCH = "work_bench"
"""Kind of the bench that a robot stands at."""
_BEFORE_BENCH = 0.2
"""Distance of the robot's base from the edge of the bench [m], as in the room of levels 1 to 4."""
_KNEE = 0.7
"""Walkways are free of what is between the floor and this [m]; what hangs higher is no matter."""
_FURNITURE = 0.6
"""Height above which what stands on the floor for good keeps out of walkways [m]."""


@dataclass(frozen=True, eq=False)
class RequiredSpace:
    """Boxes of a piece [m].

    Attributes:
        solids: What it takes.
        frees: What must be free of others' solids.
        walkway: Floor to keep free of other furniture.
        is_furniture: Whether it keeps out of walkways.
    """

    solids: Boxes
    frees: Boxes
    walkway: Boxes
    is_furniture: bool

    @cached_property
    def outline(self) -> Boxes:
        """The box around its solids."""
        return self.solids.hull

    @cached_property
    def hull(self) -> Boxes:
        """The box around all of them."""
        return joined(self.solids, self.frees, self.walkway).hull

    def moved(self, by: FloatArray) -> "RequiredSpace":
        """Return it elsewhere, shape (3,) [m]."""
        parts = (self.solids.moved(by), self.frees.moved(by), self.walkway.moved(by))
        return RequiredSpace(*parts, self.is_furniture)

    def conflicts(self, other: "RequiredSpace") -> bool:
        """Return whether two pieces cannot stand where they do."""
        return (
            self.solids.meet(other.solids)
            or self.solids.meet(other.frees)
            or self.frees.meet(other.solids)
            or (other.is_furniture and self.walkway.meet(other.solids))
            or (self.is_furniture and self.solids.meet(other.walkway))
        )


@cache
def required_space(need: Need, heading: Heading) -> RequiredSpace:
    """Return what a piece takes at the origin, when its front faces a way."""
    kind = extent(need.kind)
    before, behind, beside = need.where.walkway
    low, high = kind.hull.low[0], kind.hull.high[0]
    walkway = boxes()
    if before or behind or beside:
        across = (low[1] - beside, high[1] + beside)
        walkway = boxes(((low[0] - before, high[0] + behind), across, (0.05, _KNEE)))
    frees = joined(boxes(), *(swing.room for swing in kind.swings)).placed(heading)
    if need.kind == WORK_BENCH:
        place = work_place(Placed(need.kind, "", 0.0, 0.0, heading), 1)
        frees = joined(frees, *(c.room for c in claims_of_work_place(place, float(high[2]))))
    stays = need.where.on_floor and not kind.movable and high[2] > _FURNITURE
    return RequiredSpace(kind.solids.placed(heading), frees, walkway.placed(heading), stays)


def work_place(bench: Placed, number: int) -> WorkPlace:
    """Return where the robot of a work bench stands."""
    out = extent(bench.kind).hull.low[0, 0] - _BEFORE_BENCH
    way = boxes(((out, out), (0.0, 0.0), (0.0, 0.0))).placed(bench.heading).low[0]
    x, y = round(bench.x + float(way[0]), 3), round(bench.y + float(way[1]), 3)
    facing: Heading = (bench.heading + 180) % 360  # type: ignore[assignment]
    return WorkPlace(f"work_place_{number}", bench.name, x, y, facing)
