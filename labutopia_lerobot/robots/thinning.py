"""Thinning out a mesh so that few triangles look like many.

Files from computer-aided design are full of what is never seen, and torn along every seam. So:
weld, drop what cannot be seen from outside, hem the open borders so that they neither shrink nor
gape, let edges collapse, and shade across the edges that are no creases.
"""

from collections.abc import Sequence
from typing import NamedTuple

import fast_simplification
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

type Vertices = NDArray[np.float64]
"""Shape (n, 3) [m]."""

type Faces = NDArray[np.int32]
"""Shape (m, 3)."""

_SEAM = 5e-5
"""Vertices closer than this are one [m]."""

_HEM = 0.002
"""Distance by which the borders are hemmed inwards [m]."""

_PROUD = 0.0008
"""Height by which all parts but the largest stand out [m]: thinned, they would show through."""

_CREASE = np.cos(np.radians(40.0))
"""Faces that meet at less are shaded as one; cosine."""

_UNITS = 1000.0
"""Thinning goes in rounds, of which the first takes errors of 2e-6 square units: in metres it would
begin with 1.5 mm, and take edges in any order."""

_LEAST_SHARE = 0.017
"""Least share of the visible area: a part that has less, a screw or a plug, is left out."""

_SHARE_POWER = 0.7
"""Exponent of the visible area by which triangles go to parts: small ones need more than their
share."""

_VIEWS = 40
_PIXEL = 0.0015
"""Size of a pixel of the pictures that show what can be seen [m]."""
_SAMPLES_PER_PIXEL = 4.0
_BEHIND = 0.0008
"""Depth behind the front of a pixel up to which something still counts as seen [m]."""


class Part(NamedTuple):
    """A piece of a mesh in one tone.

    Attributes:
        vertices: Metres, shape (n, 3).
        faces: Triangles as indices into them, shape (m, 3).
        tone: How bright it is, 0 to 1.
    """

    vertices: Vertices
    faces: Faces
    tone: float


class ThinMesh(NamedTuple):
    """The drawn part of a mesh.

    Attributes:
        vertices: Metres, shape (n, 3).
        normals: Unit vectors at the vertices, shape (n, 3).
        tones: How bright the vertices are, 0 to 1, shape (n,).
        faces: Triangles, shape (m, 3).
    """

    vertices: NDArray[np.float32]
    normals: NDArray[np.float32]
    tones: NDArray[np.float32]
    faces: NDArray[np.int32]


def thin_mesh(parts: Sequence[Part], triangles: int) -> ThinMesh:
    """Return what can be seen of the parts, in about so many triangles."""
    welded = [weld(part.vertices, part.faces) for part in parts]
    offsets = np.cumsum([0, *(len(vertices) for vertices, _ in welded[:-1])])
    vertices = np.concatenate([part for part, _ in welded])
    faces = np.concatenate(
        [part + offset for (_, part), offset in zip(welded, offsets, strict=True)]
    )
    of = np.repeat(np.arange(len(parts)), [len(part) for _, part in welded])
    visible = visible_from_outside(vertices, faces)
    areas = np.bincount(of, weights=_areas(vertices, faces) * visible, minlength=len(parts))
    weights = np.where(areas > _LEAST_SHARE * areas.sum(), areas, 0.0) ** _SHARE_POWER
    made = []
    for number in np.flatnonzero(weights):
        shown, left = weld(vertices, faces[visible & (of == number)])
        if number != areas.argmax():
            shown = shown + _PROUD * vertex_normals(shown, left)
        few = round(triangles * weights[number] / weights.sum())
        made.append(creased(*thinned(*hemmed(shown, left), few)))
    offsets = np.cumsum([0, *(len(shown) for shown, _, _ in made[:-1])])
    tones = [parts[number].tone for number in np.flatnonzero(weights)]
    return ThinMesh(
        np.concatenate([shown for shown, _, _ in made]).astype(np.float32),
        np.concatenate([normals for _, normals, _ in made]).astype(np.float32),
        np.repeat(tones, [len(shown) for shown, _, _ in made]).astype(np.float32),
        np.concatenate([left + start for (*_, left), start in zip(made, offsets, strict=True)]),
    )


def shaded(parts: Sequence[Part]) -> ThinMesh:
    """Return parts with all their triangles, which are few, shaded as those of `thin_mesh` are."""
    made = [creased(*weld(part.vertices, part.faces)) for part in parts]
    counts = [len(vertices) for vertices, _, _ in made]
    starts = np.cumsum([0, *counts[:-1]])
    return ThinMesh(
        np.concatenate([vertices for vertices, _, _ in made]).astype(np.float32),
        np.concatenate([normals for _, normals, _ in made]).astype(np.float32),
        np.repeat([part.tone for part in parts], counts).astype(np.float32),
        np.concatenate([faces + start for (*_, faces), start in zip(made, starts, strict=True)]),
    )


def weld(vertices: Vertices, faces: Faces) -> tuple[Vertices, Faces]:
    """Make one of vertices at the same place; drop triangles without area, and what is unused."""
    _, first, same = np.unique(
        np.round(vertices / _SEAM).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    faces = same.ravel()[faces].astype(np.int32)
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    _, once = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    used, place = np.unique(faces[np.sort(once)], return_inverse=True)
    return vertices[first][used], place.reshape(-1, 3).astype(np.int32)


def visible_from_outside(vertices: Vertices, faces: Faces) -> NDArray[np.bool_]:
    """Return which faces can be seen from anywhere outside, shape (m,).

    Points are strewn over the faces and painted, in parallel projection, along directions that are
    spread evenly over the sphere (Fibonacci's lattice).
    """
    rng = np.random.default_rng(0)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    count = np.ceil(_areas(vertices, faces) / _PIXEL**2 * _SAMPLES_PER_PIXEL).astype(int) + 1
    of = np.repeat(np.arange(len(faces)), count)
    u, v = rng.random((2, len(of)))
    over = u + v > 1
    u[over], v[over] = 1 - u[over], 1 - v[over]
    points = corners[of, 0] + u[:, None] * (corners[of, 1] - corners[of, 0])
    points += v[:, None] * (corners[of, 2] - corners[of, 0])
    index = np.arange(_VIEWS) + 0.5
    up = 1 - 2 * index / _VIEWS
    around = np.pi * (1 + np.sqrt(5)) * index
    flat = np.sqrt(1 - up**2)
    visible = np.zeros(len(faces), bool)
    for direction in np.column_stack([flat * np.cos(around), flat * np.sin(around), up]):
        axes = Rotation.align_vectors([[0, 0, 1]], [direction])[0].as_matrix()
        x, y, depth = axes @ points.T
        column, row = ((along - along.min()) // _PIXEL for along in (x, y))
        pixel = (column * (row.max() + 1) + row).astype(int)
        front = np.full(pixel.max() + 1, -np.inf)
        np.maximum.at(front, pixel, depth)
        near = depth > front[pixel] - _BEHIND
        visible[of[near & (normals[of] @ direction > 0)]] = True
    return visible


def hemmed(vertices: Vertices, faces: Faces) -> tuple[Vertices, Faces]:
    """Fold open borders inwards: a border then is an edge like any other, which thinning keeps."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, same, count = np.unique(
        np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    border = edges[count[same.ravel()] == 1]
    if not len(border):
        return vertices, faces
    normals = vertex_normals(vertices, faces)
    rim, place = np.unique(border, return_inverse=True)
    place = place.reshape(border.shape) + len(vertices)
    folded = vertices[rim] - _HEM * normals[rim]
    (a, b), (c, d) = border.T, place.T
    hem = np.concatenate([np.column_stack([b, a, c]), np.column_stack([b, c, d])])
    return np.concatenate([vertices, folded]), np.concatenate([faces, hem]).astype(np.int32)


def thinned(vertices: Vertices, faces: Faces, triangles: int) -> tuple[Vertices, Faces]:
    """Collapse edges until about so many triangles are left."""
    if len(faces) <= triangles:
        return vertices, faces
    few, left = fast_simplification.simplify(
        (_UNITS * vertices).astype(np.float32), faces, target_count=triangles
    )
    return weld(few.astype(float) / _UNITS, left)


def creased(
    vertices: Vertices, faces: Faces
) -> tuple[Vertices, NDArray[np.float64], NDArray[np.int32]]:
    """Return vertices with normals, several at a place where faces meet in a crease, and faces.

    A corner's normal is the mean of the normals of the faces around it that are not turned away
    from its own by more than the crease, weighted by their angles there.
    """
    corners = vertices[faces]
    angles = np.empty((len(faces), 3))
    unit = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit /= np.maximum(np.linalg.norm(unit, axis=1, keepdims=True), 1e-15)
    for k in range(3):
        one = corners[:, (k + 1) % 3] - corners[:, k]
        two = corners[:, (k + 2) % 3] - corners[:, k]
        size = np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1)
        angles[:, k] = np.arccos(np.clip((one * two).sum(axis=1) / np.maximum(size, 1e-15), -1, 1))
    around: list[list[tuple[int, int]]] = [[] for _ in vertices]
    for face, triple in enumerate(faces):
        for k, vertex in enumerate(triple):
            around[vertex].append((face, k))
    normals = np.empty((len(faces), 3, 3))
    for face, triple in enumerate(faces):
        for k, vertex in enumerate(triple):
            near, at = map(np.array, zip(*around[vertex], strict=True))
            alike = unit[near] @ unit[face] > _CREASE
            total = (angles[near, at][alike, None] * unit[near][alike]).sum(axis=0)
            normals[face, k] = total / max(np.linalg.norm(total), 1e-15)
    keys = np.column_stack([faces.ravel(), np.round(normals.reshape(-1, 3) * 1e3).astype(int)])
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return (
        vertices[faces.ravel()[first]],
        normals.reshape(-1, 3)[first],
        place.reshape(faces.shape).astype(np.int32),
    )


def vertex_normals(vertices: Vertices, faces: Faces) -> NDArray[np.float64]:
    """Return the mean normal of the faces around every vertex, shape (n, 3)."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    normals = np.zeros_like(vertices)
    np.add.at(normals, faces.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    lengths: NDArray[np.float64] = np.linalg.norm(normals, axis=1, keepdims=True)
    unit: NDArray[np.float64] = normals / np.maximum(lengths, 1e-15)
    return unit


def _areas(vertices: Vertices, faces: Faces) -> NDArray[np.float64]:
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    areas: NDArray[np.float64] = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return areas
