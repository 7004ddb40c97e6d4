"""Where a thing stands when an episode begins."""

from dataclasses import dataclass

from labutopia_lerobot.world import BENCH, Dock


@dataclass(frozen=True)
class Placement:
    """Place of a thing.

    Attributes:
        x: Of its origin [m], world frame.
        y: Of its origin [m], world frame.
        yaw: About the vertical [rad].
        height: Of its origin above the bench top [m].
        swaps: Bodies of the thing, each with the body whose place in it it takes.
        bench: On which bench.
        dock: From where a base reaches into it, if it was placed before that.
    """

    x: float
    y: float
    yaw: float
    height: float = 0.0
    swaps: tuple[tuple[str, str], ...] = ()
    bench: str = BENCH
    dock: Dock | None = None
