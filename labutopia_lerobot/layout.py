"""Where things stand at the start of an episode."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from labutopia_lerobot.world import Thing

if TYPE_CHECKING:
    import mujoco

CLEARANCE = 0.01
"""Least gap between two things at the start [m]."""

_TRIES = 1000


@dataclass(frozen=True)
class Switch:
    """A push-button that toggles a lamp each time it passes its travel.

    Attributes:
        name: What the world calls it.
        button: Slide of the button; positive is in.
        travel: Where it clicks [m].
        lamp: Geom that is lit while it is on.
        lit: Colour of the lit lamp.
    """

    name: str
    button: str
    travel: float
    lamp: str
    lit: tuple[float, float, float, float] = (1.0, 0.35, 0.1, 1.0)


class Piece(Thing, Protocol):
    """A thing that can be put into a scene."""

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        ...

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its hinges and slides, as in the model; their positions are its state."""
        ...

    @property
    def switches(self) -> "tuple[Switch, ...]":
        """Its electric switches."""
        ...

    @property
    def movable(self) -> bool:
        """Whether it stands free (a vessel) or is fixed to the bench (an instrument)."""
        ...

    def add_to(self, spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> "mujoco.MjsBody":
        """Build its root body, of its name, into a spec: origin at the centre of its base, z up."""
        ...


@dataclass(frozen=True)
class Placement:
    """A spot on the bench: x, y [m] in the world, yaw [rad] about the vertical."""

    x: float
    y: float
    yaw: float


@dataclass(frozen=True)
class OnBench:
    """Uniform over a rectangle of the bench top.

    Attributes:
        x: Least and greatest x of the thing's origin [m], world frame.
        y: Least and greatest y of the thing's origin [m], world frame.
        yaw: Least and greatest yaw [rad].
    """

    x: tuple[float, float]
    y: tuple[float, float]
    yaw: tuple[float, float] = (-math.pi, math.pi)

    def sample(self, rng: np.random.Generator) -> Placement:
        """Draw one placement."""
        return Placement(rng.uniform(*self.x), rng.uniform(*self.y), rng.uniform(*self.yaw))


def sample_layout(
    start: Mapping[Piece, OnBench], rng: np.random.Generator
) -> dict[Piece, Placement]:
    """Draw a placement for every thing so that no two are nearer than `CLEARANCE`.

    Raises:
        ValueError: If no such layout is found, naming the things and their regions.
    """
    for _ in range(_TRIES):
        layout = {piece: region.sample(rng) for piece, region in start.items()}
        if not _overlapping(layout):
            return layout
    regions = "; ".join(f"{piece.name}: {region}" for piece, region in start.items())
    raise ValueError(
        f"No layout without overlaps in {_TRIES} tries. Widen or part the regions of: {regions}"
    )


def _overlapping(layout: Mapping[Piece, Placement]) -> bool:
    placed = list(layout.items())
    return any(
        math.hypot(a.x - b.x, a.y - b.y)
        < first.footprint_radius + second.footprint_radius + CLEARANCE
        for i, (first, a) in enumerate(placed)
        for second, b in placed[i + 1 :]
    )
