"""A push-button that switches a lamp."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Switch:
    """A push-button that toggles a lamp each time it clicks in.

    Attributes:
        name: What the world calls it.
        button: Name of the button.
        lamp: Geom that is lit while it is on.
        lit: Colour of the lit lamp.
    """

    name: str
    button: str
    lamp: str
    lit: tuple[float, float, float, float] = (1.0, 0.35, 0.1, 1.0)
