"""Visual meshes from `rtb-data`, thinned out for fast rendering and kept in the user's cache."""

import logging
import os
import tempfile
from importlib.metadata import version
from importlib.resources import as_file, files
from pathlib import Path

import fast_simplification
import numpy as np
import trimesh
from numpy.typing import NDArray

logger = logging.getLogger(__name__)

type Mesh = tuple[NDArray[np.float32], NDArray[np.int32]]
"""Vertices [m], (n, 3), and triangles as indices into them, (m, 3)."""


def load_mesh(name: str, triangles: int) -> Mesh:
    """Load a mesh of `rtb-data` and thin it out.

    Thinning takes about 50 ms a mesh, so the result is cached. A cache that cannot be written is
    reported as a warning and costs only that time.

    Args:
        name: Path in `rtbdata`, for example `meshes/FRANKA-EMIKA/Panda/link0.stl`.
        triangles: How many triangles to keep, about.

    Returns:
        Vertices in the frame of the file and triangles.

    Raises:
        FileNotFoundError: If `rtb-data` has no such mesh.
    """
    stem = name.removesuffix(".stl").replace("/", "-")
    cached = _cache_folder() / f"{stem}-{version('rtb-data')}-{triangles}.npz"
    if cached.is_file():
        with np.load(cached) as arrays:
            return arrays["vertices"], arrays["faces"]
    vertices, faces = _simplify(name, triangles)
    try:
        _write_atomically(cached, vertices, faces)
    except OSError as error:
        logger.warning("The mesh cache %s cannot be written (%s); going on without.", cached, error)
    return vertices, faces


def _cache_folder() -> Path:
    """Follow the XDG base directory specification."""
    root = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(root) / "labutopia_lerobot"


def _simplify(name: str, triangles: int) -> Mesh:
    with as_file(files("rtbdata") / name) as path:
        if not path.is_file():
            raise FileNotFoundError(f"rtb-data {version('rtb-data')} has no mesh {name!r}.")
        # Merging the corners of the STL's separate triangles lets them share edges to collapse.
        mesh = trimesh.load_mesh(path)
    vertices, faces = fast_simplification.simplify(
        np.asarray(mesh.vertices, np.float32),
        np.asarray(mesh.faces, np.int32),
        target_count=min(triangles, len(mesh.faces)),
    )
    return np.asarray(vertices, np.float32), np.asarray(faces, np.int32)


def _write_atomically(path: Path, vertices: NDArray[np.float32], faces: NDArray[np.int32]) -> None:
    """Write beside the target and rename, so that a parallel worker never reads half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
        try:
            np.savez(file, vertices=vertices, faces=faces)
            file.close()
            os.replace(file.name, path)
        except OSError:
            Path(file.name).unlink(missing_ok=True)
            raise
