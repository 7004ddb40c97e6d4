"""Walls as boxes around their openings, and what one sees of them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.labware.parts.shell import Shell, joined
from labutopia_lerobot.scenes.plan import WALL_THICKNESS, Opening, Plan
from labutopia_lerobot.world import FloatArray

OUTER = 0.24
"""Thickness of the four walls around [m]: one brick of 240 mm (DIN 4172)."""

type Span = tuple[float, float]
type Box = tuple[Span, Span, Span]
"""Intervals along x, y and z [m], room frame."""


@dataclass(frozen=True)
class Masonry:
    """A straight wall, with its openings.

    Attributes:
        along: The axis that it runs along: 0 for x, 1 for y.
        length: From where to where on that [m].
        across: From where to where on the other axis [m].
        height: [m].
        inside: Which of its two sides one sees: -1 the lower, 1 the upper, 0 both.
        openings: In it, by where they are along it.
    """

    along: int
    length: Span
    across: Span
    height: float
    inside: int
    openings: tuple[Opening, ...]

    def boxes(self) -> Iterator[Box]:
        """Yield what of it is solid."""
        start, end = self.length
        for hole in self.openings:
            low, high = self.hole(hole)
            yield self._box((start, low), (0.0, self.height))
            top = hole.sill + hole.height
            for z in ((0.0, hole.sill), (top, self.height)):
                if z[1] - z[0] > 1e-6:
                    yield self._box((low, high), z)
            start = high
        yield self._box((start, end), (0.0, self.height))

    def hole(self, opening: Opening) -> Span:
        """Return from where to where an opening is, along the wall [m]."""
        middle = (opening.x, opening.y)[self.along]
        return middle - opening.width / 2, middle + opening.width / 2

    def faces(self) -> Iterator[FloatArray]:
        """Yield what one sees from inside: corners of rectangles, counterclockwise, (4, 3)."""
        for box in self.boxes():
            span, z = box[self.along], box[2]
            for side in (-1, 1) if self.inside == 0 else (self.inside,):
                yield self._upright(span, self.across[side > 0], z, side)
            if z[0] == 0.0 and z[1] == self.height:  # its ends, in openings and in the room
                for end, way in zip(span, (-1, 1), strict=True):
                    if self.inside == 0 or end not in self.length:
                        yield self._end(end, way, z)
            elif z[0] == 0.0:
                yield self._level(span, z[1], 1)
            else:
                yield self._level(span, z[0], -1)

    def caps(self) -> Iterator[FloatArray]:
        """Yield its upper ends, as `faces`: what a section shows that is seen from above."""
        yield self._level(self.length, self.height, 1)

    def skirting(self, height: float, out: float) -> Iterator[FloatArray]:
        """Yield what one sees of the boards along its foot, as `faces`.

        Args:
            height: Of the boards [m].
            out: How far they stand out [m].
        """
        for box in self.boxes():
            if box[2][0] == 0.0:
                for side in (-1, 1) if self.inside == 0 else (self.inside,):
                    at = self.across[side > 0] + side * out
                    yield self._upright(box[self.along], at, (0.0, height), side)

    def panes(self) -> Iterator[FloatArray]:
        """Yield what of the sky is seen through its windows, as `faces`."""
        for hole in self.openings:
            if hole.kind == "window" and self.inside:
                (low, high), far = self.hole(hole), self.across[self.inside < 0]
                z = hole.sill - 0.05, hole.sill + hole.height + 0.05
                yield self._upright((low - 0.05, high + 0.05), far, z, self.inside)

    def _box(self, span: Span, z: Span) -> Box:
        return (span, self.across, z) if self.along == 0 else (self.across, span, z)

    def _corner(self, along: float, across: float, z: float) -> tuple[float, float, float]:
        return (along, across, z) if self.along == 0 else (across, along, z)

    def _upright(self, span: Span, at: float, z: Span, side: int) -> FloatArray:
        """Return a rectangle that faces along the other axis."""
        corners = [(span[0], z[0]), (span[1], z[0]), (span[1], z[1]), (span[0], z[1])]
        return self._facing([self._corner(a, at, c) for a, c in corners], 1 - self.along, side)

    def _end(self, at: float, way: int, z: Span) -> FloatArray:
        (a, b), (low, high) = self.across, z
        corners = [(a, low), (b, low), (b, high), (a, high)]
        return self._facing([self._corner(at, c, z) for c, z in corners], self.along, way)

    def _level(self, span: Span, z: float, way: int) -> FloatArray:
        (a, b), (c, d) = span, self.across
        corners = [(a, c), (b, c), (b, d), (a, d)]
        return self._facing([self._corner(s, t, z) for s, t in corners], 2, way)

    @staticmethod
    def _facing(corners: list[tuple[float, float, float]], axis: int, way: int) -> FloatArray:
        """Return corners in the order in which their normal points a way along an axis."""
        face = np.array(corners)
        normal = np.cross(face[1] - face[0], face[2] - face[1])
        return face if normal[axis] * way > 0 else face[::-1].copy()


def masonry(plan: Plan) -> list[Masonry]:
    """Return all walls of a plan: the four around it, then those inside."""
    width, depth, height = plan.size
    far = OUTER
    around = [
        (0, (-far, width + far), (-far, 0.0), 1),
        (0, (-far, width + far), (depth, depth + far), -1),
        (1, (0.0, depth), (-far, 0.0), 1),
        (1, (0.0, depth), (width, width + far), -1),
    ]
    inner = []
    for wall in plan.walls:
        along = 0 if wall.start[1] == wall.end[1] else 1
        one, other = sorted((wall.start[along], wall.end[along]))
        middle, half = wall.start[1 - along], WALL_THICKNESS / 2
        inner.append((along, (one, other), (middle - half, middle + half), 0))
    return [
        Masonry(along, length, across, height, inside, _in(plan, along, length, across))
        for along, length, across, inside in (*around, *inner)
    ]


def _in(plan: Plan, along: int, length: Span, across: Span) -> tuple[Opening, ...]:
    """Return the openings of a wall, in order."""
    openings = []
    for opening in plan.openings:
        place, aside = (opening.x, opening.y)[along], (opening.x, opening.y)[1 - along]
        faces_along = opening.heading % 180 == 0  # its normal runs along x
        beside = faces_along == (along == 1) and across[0] - 0.01 <= aside <= across[1] + 0.01
        if beside and length[0] < place < length[1]:
            openings.append(opening)
    return tuple(sorted(openings, key=lambda opening: (opening.x, opening.y)[along]))


def shell_of(faces: Sequence[FloatArray]) -> Shell:
    """Return rectangles as one mesh."""
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    shells = []
    for face in faces:
        normal = np.cross(face[1] - face[0], face[2] - face[1])
        shells.append((face, np.tile(normal / np.linalg.norm(normal), (4, 1)), corners))
    return joined(shells)
