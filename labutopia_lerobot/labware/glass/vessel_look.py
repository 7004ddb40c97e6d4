"""Look of a vessel: its two surfaces, its thick edges, what is printed on it. Nothing collides.

The printing, scale, numbers and label, is one mesh just off the surface. Seen from 0.25 m in a
picture of 256 pixels a millimetre is a pixel high: numbers are 8 to 10 mm high, and only walls of
58 mm and more have room for them: beakers from 150 ml on.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from labutopia_lerobot.labware.glass.gleam import CLEAR, coordinates, gleam
from labutopia_lerobot.labware.glass.material import Material
from labutopia_lerobot.labware.glass.profile import Point, Profile
from labutopia_lerobot.labware.glass.thread import Thread
from labutopia_lerobot.labware.parts.mesh import SEGMENTS, Mesh, bead, join, revolve
from labutopia_lerobot.world.model import VISUAL_GROUP

_OUTLINE_OPACITY = {"inside": 1.4, "outside": 2.4}
"""Ratio of the opacity of clear walls at their outline to the average."""

_WIDEST_BEAD = 0.002  # a thicker lip is drawn flat, not as a bead [m]

_STEPS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 25, 50, 100, 200, 500, 1000, 2000)
"""Steps of scales [ml]: the smallest with fewer than ten graduations is taken."""


_TALL, _THICK = 0.008, 0.0015
"""Least height of a number and thickness of its strokes [m]; ours."""
_LEAST = 0.029
"""Radius below which numbers would go around a corner [m]."""
_SEGMENTS = {
    # strokes that are printed, of: above, upper left and right, middle, lower ones, below
    "0": "1110111",
    "1": "0010010",
    "2": "1011101",
    "3": "1011011",
    "4": "0111010",
    "5": "1101011",
    "6": "1101111",
    "7": "1010010",
    "8": "1111111",
    "9": "1111011",
}
_STROKES = (
    # azimuth, to the right, and height of the ends, in widths and heights of a digit
    ((-0.5, 1.0), (0.5, 1.0)),
    ((-0.5, 0.5), (-0.5, 1.0)),
    ((0.5, 0.5), (0.5, 1.0)),
    ((0.5, 0.5), (-0.5, 0.5)),
    ((-0.5, 0.0), (-0.5, 0.5)),
    ((0.5, 0.0), (0.5, 0.5)),
    ((0.5, 0.0), (-0.5, 0.0)),
)


@dataclass(frozen=True)
class VesselLook:
    """The visible parts of a vessel.

    Attributes:
        name: Name of the body; prefix of the names of what is drawn.
        profile: The wall's half cross-section.
        material: What it is made of.
        stands: Whether it stands by itself: on a heel that is drawn.
        graduated: Whether anything is printed on it.
        numbered: Whether its graduations have numbers.
        one_mark: Volume that the only graduation, a ring, marks [m^3]; None for a scale.
        thread: On the outside of its neck.
    """

    name: str
    profile: Profile
    material: Material
    stands: bool
    graduated: bool
    numbered: bool
    one_mark: float | None
    thread: Thread | None


def add_look(spec: mujoco.MjSpec, body: mujoco.MjsBody, vessel: VesselLook) -> None:
    """Add the visual geoms: the two surfaces, the thick edges and the printed scale."""
    outer, inner, of = vessel.profile.outer, vessel.profile.inner, vessel.material
    parts = [
        ("inside", revolve(inner[::-1]), of.wall, 0.6),
        ("bottom", revolve(_bottom(vessel)), of.bottom, 0.1),
        ("outside", revolve(outer), of.wall, of.shine),
        ("edges", join(*_edges(vessel)), of.edge, of.shine),
    ]
    if vessel.graduated:
        parts.append(("scale", _printing(vessel), of.ink, 0.0))
    clear = of.wall[3] < CLEAR
    for part, (vertices, faces), rgba, specular in parts:
        name = f"{vessel.name}_{part}"
        material = spec.add_material(name=name, rgba=rgba, specular=specular, shininess=0.9)
        mesh = spec.add_mesh(
            name=name,
            uservert=vertices.ravel(),
            userface=faces.ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        if clear and rgba == of.wall:
            outline = _OUTLINE_OPACITY[part] * rgba[3]
            mesh.usertexcoord = coordinates(SEGMENTS, len(vertices) // (SEGMENTS + 1)).ravel()
            material.rgba = (*rgba[:3], outline)
            material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = gleam(spec)
        body.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=name,
            material=name,
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )


def _bottom(vessel: VesselLook) -> list[Point]:
    """Return the section of the bottom, from the axis below to the axis above."""
    (foot, heel, *_), thick = vessel.profile.outer, vessel.profile.bottom
    if vessel.profile.open_below:
        return [vessel.profile.inner[0], foot]
    if heel[1] > 2 * thick:  # the outside goes on straight beyond the bottom
        heel = (vessel.profile.outer_radius(thick), thick)
    return [(0.0, 0.0), foot, heel, vessel.profile.inner[0], (0.0, thick)]


def _edges(vessel: VesselLook) -> list[Mesh]:
    """Return the lip and, of what stands, the heel: where light goes along the wall."""
    outer, wall = vessel.profile.outer, vessel.profile.wall
    lip: list[Point] = [outer[-1], vessel.profile.inner[-1]]
    if wall <= _WIDEST_BEAD:
        lip = bead(outer[-1][0] - wall / 2, vessel.profile.height, wall)
    edges = [revolve(lip)]
    if vessel.stands:
        thick = min(wall, 0.7 * vessel.profile.bottom)
        edges.append(revolve(bead(outer[0][0], thick, thick)))
    return edges if vessel.thread is None else [*edges, vessel.thread.ridge(vessel.profile.height)]


def _printing(vessel: VesselLook) -> Mesh:
    """Return the printing of a vessel: the graduation, and a label at the back."""
    profile = vessel.profile
    if vessel.one_mark is not None:
        strips = [(profile.fill_height(vessel.one_mark), 0.0012, 0.0, 2 * np.pi)]
    else:
        step = next(ml for ml in _STEPS if 1e6 * vessel.profile.capacity < 10 * ml)
        levels = np.arange(step, 0.85 * (1e6 * vessel.profile.capacity), step) * 1e-6
        strips = [(profile.fill_height(float(level)), 0.0012, 0.0, 0.5) for level in levels]
    strips.append((0.3 * vessel.profile.height, 0.16 * vessel.profile.height, np.pi, 0.9))
    patches = []
    for middle, tall, azimuth, wide in strips:
        heights = (middle - tall / 2, middle + tall / 2)
        edge = [(profile.outer_radius(height) + 2e-4, height) for height in heights]
        segments = max(5, round(SEGMENTS * wide / (2 * np.pi)))
        patches.append(revolve(edge, segments, azimuth - wide / 2, wide))
    if vessel.numbered and vessel.one_mark is None:
        patches += _numbers(vessel, step)
    return join(*patches)


def _numbers(vessel: VesselLook, step: float) -> list[Mesh]:
    """Return the numbers beside the graduations, as many as do not touch each other."""
    profile, patches, free = vessel.profile, list[Mesh](), 0.0
    tall = min(max(_TALL, 0.085 * vessel.profile.height), 1.3 * _TALL)
    for level in np.arange(step, 0.85 * (1e6 * vessel.profile.capacity), step):
        middle = profile.fill_height(1e-6 * float(level))
        low, high = middle - tall / 2, middle + tall / 2
        if low > free and high < vessel.profile.height and profile.outer_radius(high) >= _LEAST:
            patches += _number(profile, f"{level:g}", low, tall)
            free = middle + 0.75 * tall
    return patches


def _number(profile: Profile, text: str, low: float, tall: float) -> list[Mesh]:
    """Return a number to the right of the graduations; its lower edge and height in metres."""
    patches = []
    radius = profile.outer_radius(low + tall / 2)
    wide = 0.5 * tall / radius
    for place, digit in enumerate(text):
        start = 0.32 + (0.5 + 1.7 * place) * wide
        for stroke, printed in zip(_STROKES, _SEGMENTS[digit], strict=True):
            if printed == "1":
                (left, bottom), (right, top) = stroke
                around = max(abs(right - left) * wide, _THICK / radius)
                heights = (low + bottom * tall - _THICK / 2, low + top * tall + _THICK / 2)
                edge = [(profile.outer_radius(height) + 2e-4, height) for height in heights]
                middle = start + wide * (left + right) / 2
                patches.append(revolve(edge, 2, middle - around / 2, around))
    return patches
