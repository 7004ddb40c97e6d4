"""Finishes of the surfaces of a room."""

from dataclasses import dataclass

type Color = tuple[float, float, float, float]


@dataclass(frozen=True)
class Finish:
    """The look of a surface.

    Attributes:
        rgba: Its colour.
        specular: How bright its highlights are, 0 to 1.
        shininess: How sharp they are, 0 to 1.
        pattern: Which of `textures.PATTERNS` it has, or None.
    """

    rgba: Color
    specular: float = 0.25
    shininess: float = 0.3
    pattern: str | None = None


def _plastic(red: float, green: float, blue: float) -> Finish:
    return Finish((red, green, blue, 1.0), pattern="speckled")


BENCH_FINISHES = {
    "dark blue plastic": _plastic(0.11, 0.18, 0.40),
    "wood": Finish((0.74, 0.53, 0.32, 1.0), specular=0.08, shininess=0.1, pattern="grained"),
    "dark green plastic": _plastic(0.11, 0.31, 0.20),
    "white plastic": _plastic(0.96, 0.96, 0.94),
    "black plastic": _plastic(0.075, 0.075, 0.085),
    "light blue plastic": _plastic(0.53, 0.71, 0.86),
    "stainless steel": Finish(
        (0.62, 0.64, 0.66, 1.0), specular=0.3, shininess=0.6, pattern="brushed"
    ),
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

FLOOR_FINISHES = {
    "grey vinyl": Finish((0.69, 0.71, 0.73, 1.0), 0.1, 0.1),
    "blue vinyl": Finish((0.52, 0.62, 0.72, 1.0), 0.1, 0.1),
    "green vinyl": Finish((0.58, 0.68, 0.60, 1.0), 0.1, 0.1),
    "beige vinyl": Finish((0.78, 0.73, 0.62, 1.0), 0.1, 0.1),
    "white tiles": Finish((0.86, 0.87, 0.87, 1.0), 0.3, 0.4),
    "grey tiles": Finish((0.58, 0.59, 0.60, 1.0), 0.3, 0.4),
    "grey epoxy": Finish((0.62, 0.64, 0.65, 1.0), 0.4, 0.5),
}
"""Floors of laboratories; ours."""
