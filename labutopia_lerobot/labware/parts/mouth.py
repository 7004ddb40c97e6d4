"""Where one reaches into an instrument."""

from dataclasses import dataclass

from labutopia_lerobot.labware.parts.solid import Vector


@dataclass(frozen=True)
class Mouth:
    """The opening of an oven or a cupboard, the basin of a sink; see `world.Doorway`.

    Attributes:
        frame: Name of the frame that it refers to, whose x axis points inwards.
        at: Its middle in that frame [m].
        ahead: Least and greatest distance of it before the base of an arm that reaches in [m]. A
            range of 0.04 m picks one of the distances of `scenes.docks`.
    """

    frame: str
    at: Vector
    ahead: tuple[float, float]
