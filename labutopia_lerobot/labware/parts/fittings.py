"""Fittings of many instruments: feet, open boxes, plates with a hole."""

from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Span


def feet(depth: float, width: float, height: float, look: str = "rubber") -> list[Form]:
    """Return four round feet under the corners of a base [m]."""
    x, y = 0.42 * depth, 0.40 * width
    corners = [(i * x, j * y) for i in (-1, 1) for j in (-1, 1)]
    across = min(0.03, 0.2 * width)
    return [Rod((x, y, 0), (x, y, height), across, look, segments=16) for x, y in corners]


def tub(
    x: Span,
    y: Span,
    z: Span,
    wall: float,
    look: str,
    inside: str | None = None,
    edge: float = 0.002,
) -> list[Form]:
    """Return four walls and a floor, open above: a bath, a bin, a sink.

    Args:
        x: Outer sides, from where to where [m].
        y: See x.
        z: See x.
        wall: Thickness of walls and floor [m].
        look: Finish outside.
        inside: Finish of the floor; as outside if not said.
        edge: Radius of the edges [m].
    """
    (a, b), (c, d), low = x, y, z[0]
    return [
        Block((a, a + wall), y, z, look, edge),
        Block((b - wall, b), y, z, look, edge),
        Block((a + wall / 2, b - wall / 2), (c, c + wall), z, look, edge),
        Block((a + wall / 2, b - wall / 2), (d - wall, d), z, look, edge),
        Block(
            (a + wall / 2, b - wall / 2),
            (c + wall / 2, d - wall / 2),
            (low, low + wall),
            inside or look,
            0.0,
        ),
    ]


def framed(
    x: Span, y: Span, z: Span, hole: tuple[Span, Span], look: str, edge: float = 0.002
) -> list[Form]:
    """Return a plate with a rectangular hole: a work top with a basin.

    Args:
        x: Outer sides, from where to where [m].
        y: See x.
        z: See x.
        hole: Sides of the hole along x and y [m].
        look: Finish.
        edge: Radius of the edges [m].
    """
    (near, far), (right, left) = hole
    return [
        Block((x[0], near), y, z, look, edge),
        Block((far, x[1]), y, z, look, edge),
        Block((near, far), (y[0], right), z, look, edge),
        Block((near, far), (left, y[1]), z, look, edge),
    ]
