"""Visual meshes of others, thinned out for fast rendering and kept in the user's cache."""

import hashlib
import logging
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from labutopia_lerobot.kernel import user_cache
from labutopia_lerobot.robots.collada import read_collada
from labutopia_lerobot.robots.mesh_package import RTB_DATA, MeshPackage
from labutopia_lerobot.robots.thinning import Part, ThinMesh, shaded, thin_mesh

logger = logging.getLogger(__name__)

_MADE_BY = 2
"""Version of the way that meshes are made; what another has left in the cache is not taken."""


class PlacedMesh(NamedTuple):
    """A file of an assembly, and where it is in its frame.

    Attributes:
        name: Path in the package.
        pos: Of the file's origin [m].
        rpy: Turns about the fixed axes x, y and z, one after the other [rad], as URDF has them.
        tone: How bright it is drawn, 0 to 1.
    """

    name: str
    pos: tuple[float, float, float]
    rpy: tuple[float, float, float]
    tone: float


def load_mesh(name: str, triangles: int, package: MeshPackage = RTB_DATA) -> ThinMesh:
    """Load a mesh and thin it out.

    Thinning takes about a second a mesh, so the result is cached. A cache that cannot be written is
    reported as a warning and costs only that time.

    Args:
        name: Path in the package, STL or COLLADA.
        triangles: How many triangles to keep, about.
        package: That has it.

    Returns:
        The mesh, in the frame of the file; an STL is white.

    Raises:
        FileNotFoundError: If the package has no such mesh.
        NoMeshesError: If it is not installed.
    """
    stem = name.replace("/", "-")
    made = f"{stem}-{package.version}-{triangles}-{_MADE_BY}"
    return _cached(made, lambda: thin_mesh(_read(name, package), triangles))


def load_assembly(
    name: str, placed: Sequence[PlacedMesh], package: MeshPackage = RTB_DATA
) -> ThinMesh:
    """Load several meshes that have few triangles as one, cached likewise.

    Args:
        name: What it is called in the cache.
        placed: The files, and where they are.
        package: That has them.

    Raises:
        FileNotFoundError: If the package lacks one of them.
        NoMeshesError: If it is not installed.
    """
    digest = hashlib.sha256(repr(placed).encode()).hexdigest()[:8]
    made = f"{name}-{package.version}-{digest}-{_MADE_BY}"
    return _cached(made, lambda: shaded([*_assembled(placed, package)]))


def _assembled(placed: Sequence[PlacedMesh], package: MeshPackage) -> Iterator[Part]:
    for name, pos, rpy, tone in placed:
        turn = Rotation.from_euler("xyz", rpy).as_matrix()
        for part in _read(name, package):
            yield Part(part.vertices @ turn.T + pos, part.faces, tone)


def _cached(name: str, make: Callable[[], ThinMesh]) -> ThinMesh:
    """Return a mesh from the cache, or make it."""
    cached = user_cache() / f"{name}.npz"
    if cached.is_file():
        with np.load(cached) as arrays:
            return ThinMesh(**arrays)
    mesh = make()
    try:
        _write_atomically(cached, mesh)
    except OSError as error:
        logger.warning("The mesh cache %s cannot be written (%s); going on without.", cached, error)
    return mesh


def _read(name: str, package: MeshPackage) -> list[Part]:
    path = package.path(name)
    if path.suffix == ".dae":
        return read_collada(path)
    mesh = trimesh.load_mesh(path)
    return [Part(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int32), 1.0)]


def _write_atomically(path: Path, mesh: ThinMesh) -> None:
    """Write beside the target and rename, so that a parallel worker never reads half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
        try:
            np.savez(file, **mesh._asdict())
            file.close()
            os.replace(file.name, path)
        except OSError:
            Path(file.name).unlink(missing_ok=True)
            raise
