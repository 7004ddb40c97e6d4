"""A named fact about the world."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import FunctionType

from labutopia_lerobot.world import World


@dataclass(frozen=True)
class Predicate:
    """A yes-or-no question about the present world.

    Attributes:
        name: How the fact appears in `info["facts"]` and in result files; it carries every
            threshold, since judging goes by names.
        holds: The answer for a world.
        off: By how much the world misses what is asked for at its best, unit -> amount (`mm`,
            `deg`, `ml`), whether the fact holds or not; None where nothing is measured. It decides
            nothing: `labutopia-view` shows it of what did not hold, result rows have it.
        because: What makes it hold just now, in words, for who looks at a failure; decides nothing.
    """

    name: str
    holds: Callable[[World], bool]
    off: Callable[[World], Mapping[str, float]] | None = None
    because: Callable[[World], str] | None = None

    def __invert__(self) -> "Predicate":
        """Return the fact that this one does not hold: `~gripped(flask)`."""
        holds = self.holds
        return Predicate(f"not ({self.name})", lambda world: not holds(world))

    def __or__(self, other: "Predicate") -> "Predicate":
        """Return the fact that this one holds, or the other, or both."""
        first, second = self.holds, other.holds
        return Predicate(
            f"{self.name} or {other.name}", lambda world: first(world) or second(world)
        )


def same(first: object, second: object) -> bool:
    """Tell whether two predicates ask the same of the same things.

    Functions made by the same line of code are the same where what they have caught is.
    """
    if first is second:
        return True
    if isinstance(first, Predicate) and isinstance(second, Predicate):
        return first.name == second.name and same(first.holds, second.holds)
    if isinstance(first, FunctionType) and isinstance(second, FunctionType):
        caught = [
            [cell.cell_contents for cell in function.__closure__ or ()] + [function.__defaults__]
            for function in (first, second)
        ]
        return first.__code__ is second.__code__ and all(
            same(a, b) for a, b in zip(*caught, strict=True)
        )
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return type(first) is type(second) and bool(first == second)
