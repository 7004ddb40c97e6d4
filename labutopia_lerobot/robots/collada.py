"""Reading the triangles and the shades of a COLLADA file, as far as robots' files go.

COLLADA 1.4.1 specification (Khronos, 2008): `triangles` are indices into sources, several to a
corner; a `node` of the scene has a matrix and says which effect colours its geometry.
"""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.robots.thinning import Part

_NAMESPACE = {"c": "http://www.collada.org/2005/11/COLLADASchema"}


def read_collada(path: Path) -> list[Part]:
    """Return what is in the scene of a file, in its frame and as bright as its effects."""
    root = ElementTree.parse(path).getroot()
    geometries = {
        geometry.get("id"): geometry for geometry in root.iterfind(".//c:geometry", _NAMESPACE)
    }
    parts = []
    for node in root.iterfind(".//c:visual_scene/c:node", _NAMESPACE):
        instance = node.find("c:instance_geometry", _NAMESPACE)
        if instance is None:
            continue
        vertices, faces = _triangles(geometries[instance.get("url", "")[1:]])
        matrix = node.find("c:matrix", _NAMESPACE)
        if matrix is not None:
            placed = np.array(_text(matrix).split(), float).reshape(4, 4)
            vertices = vertices @ placed[:3, :3].T + placed[:3, 3]
        material = instance.find(".//c:instance_material", _NAMESPACE)
        target = "" if material is None else material.get("target", "")[1:]
        parts.append(Part(vertices, faces, _brightness(root, target)))
    return parts


def _triangles(geometry: ElementTree.Element) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    positions = geometry.find(".//c:input[@semantic='POSITION']", _NAMESPACE)
    triangles = geometry.find(".//c:triangles", _NAMESPACE)
    assert positions is not None  # the files of rtb-data have all of these
    assert triangles is not None
    source = positions.get("source", "")[1:]
    array = geometry.find(f".//c:source[@id='{source}']/c:float_array", _NAMESPACE)
    corners = triangles.find("c:p", _NAMESPACE)
    assert array is not None
    assert corners is not None
    inputs = triangles.findall("c:input", _NAMESPACE)
    stride = 1 + max(int(entry.get("offset", 0)) for entry in inputs)
    vertex = next(entry for entry in inputs if entry.get("semantic") == "VERTEX")
    indices = np.array(_text(corners).split(), np.int32).reshape(-1, stride)
    faces = indices[:, int(vertex.get("offset", 0))].reshape(-1, 3)
    return np.array(_text(array).split(), float).reshape(-1, 3), faces


def _brightness(root: ElementTree.Element, material: str) -> float:
    """Return the mean of the diffuse colour of a material; 1 where it has none."""
    effect = root.find(f".//c:material[@id='{material}']/c:instance_effect", _NAMESPACE)
    name = "" if effect is None else effect.get("url", "")[1:]
    color = root.find(f".//c:effect[@id='{name}']//c:diffuse/c:color", _NAMESPACE)
    return 1.0 if color is None else sum(map(float, _text(color).split()[:3])) / 3


def _text(element: ElementTree.Element) -> str:
    return element.text or ""
