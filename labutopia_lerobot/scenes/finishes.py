"""How surfaces of a room can look."""

from dataclasses import dataclass

type Color = tuple[float, float, float, float]


@dataclass(frozen=True)
class Finish:
    """The look of a surface.

    Attributes:
        rgba: Its colour.
        specular: How bright its highlights are, 0 to 1.
        shininess: How sharp they are, 0 to 1.
    """

    rgba: Color
    specular: float = 0.25
    shininess: float = 0.3


BENCH_FINISHES = {
    "dark blue plastic": Finish((0.10, 0.16, 0.36, 1.0)),
    "wood": Finish((0.62, 0.44, 0.26, 1.0), specular=0.08, shininess=0.1),
    "dark green plastic": Finish((0.10, 0.28, 0.18, 1.0)),
    "white plastic": Finish((0.88, 0.88, 0.86, 1.0)),
    "black plastic": Finish((0.06, 0.06, 0.07, 1.0)),
    "light blue plastic": Finish((0.52, 0.70, 0.84, 1.0)),
    "stainless steel": Finish((0.52, 0.54, 0.56, 1.0), specular=0.3, shininess=0.6),
}
"""The seven bench tops of the original's level 3, in its order."""

WALL_FINISHES = {
    "white": Finish((0.90, 0.91, 0.92, 1.0), 0.1, 0.1),
    "cream": Finish((0.92, 0.88, 0.78, 1.0), 0.1, 0.1),
    "light grey": Finish((0.72, 0.74, 0.76, 1.0), 0.1, 0.1),
    "pale blue": Finish((0.74, 0.82, 0.90, 1.0), 0.1, 0.1),
    "pale green": Finish((0.76, 0.87, 0.78, 1.0), 0.1, 0.1),
    "terracotta": Finish((0.72, 0.46, 0.36, 1.0), 0.1, 0.1),
}
"""Paints of laboratory walls; ours."""
