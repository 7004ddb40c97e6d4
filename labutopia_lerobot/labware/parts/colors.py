"""Colours of plastic and glaze by name, by which an instruction may distinguish things."""

type Color = tuple[float, float, float, float]
"""Red, green, blue, alpha; 0 to 1."""

COLORS: dict[str, Color] = {
    "red": (0.80, 0.08, 0.07, 1.0),
    "green": (0.10, 0.55, 0.20, 1.0),
    "blue": (0.08, 0.25, 0.70, 1.0),
    "yellow": (0.93, 0.74, 0.08, 1.0),
}
"""The four of the original's buttons."""
