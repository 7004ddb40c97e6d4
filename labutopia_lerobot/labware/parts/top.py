"""A level surface of a piece of furniture that instruments stand on."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Top:
    """A rectangle on which nothing is fixed, in the frame of the piece, whose front faces -x.

    Attributes:
        height: Above the floor [m].
        x: Least and greatest x [m].
        y: Least and greatest y [m].
        behind: Whether one works at it from behind the piece (+x), not from its front.
    """

    height: float
    x: tuple[float, float]
    y: tuple[float, float]
    behind: bool = False
