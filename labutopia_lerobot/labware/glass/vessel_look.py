"""How a vessel looks: its two surfaces, its thick edges, the printed scale. Nothing collides."""

from typing import TYPE_CHECKING

import mujoco

from labutopia_lerobot.labware.glass.gleam import CLEAR, coordinates, gleam
from labutopia_lerobot.labware.glass.printing import printing
from labutopia_lerobot.labware.glass.profile import Point
from labutopia_lerobot.labware.parts.mesh import SEGMENTS, Mesh, bead, join, revolve
from labutopia_lerobot.world.model import VISUAL_GROUP

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.vessel import Vessel

_OUTLINE_OPACITY = {"inside": 1.4, "outside": 2.4}
"""How much more opaque clear walls are at their outline than on average."""

_WIDEST_BEAD = 0.002  # a thicker lip is drawn flat, not as a bead [m]


def add_look(spec: mujoco.MjSpec, body: mujoco.MjsBody, vessel: "Vessel") -> None:
    """Add the visual geoms: the two surfaces, the thick edges and the printed scale."""
    outer, inner, of = vessel.profile.outer, vessel.profile.inner, vessel.material
    parts = [
        ("inside", revolve(inner[::-1]), of.wall, 0.6),
        ("bottom", revolve(_bottom(vessel)), of.bottom, 0.1),
        ("outside", revolve(outer), of.wall, of.shine),
        ("edges", join(*_edges(vessel)), of.edge, of.shine),
    ]
    if vessel.graduated:
        parts.append(("scale", printing(vessel), of.ink, 0.0))
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


def _bottom(vessel: "Vessel") -> list[Point]:
    """Return the section of the bottom, from the axis below to the axis above."""
    (foot, heel, *_), thick = vessel.profile.outer, vessel.profile.bottom
    if vessel.profile.open_below:
        return [vessel.profile.inner[0], foot]
    if heel[1] > 2 * thick:  # the outside goes on straight beyond the bottom
        heel = (vessel.profile.outer_radius(thick), thick)
    return [(0.0, 0.0), foot, heel, vessel.profile.inner[0], (0.0, thick)]


def _edges(vessel: "Vessel") -> list[Mesh]:
    """Return the lip and, of what stands, the heel: where light goes along the wall."""
    outer, wall = vessel.profile.outer, vessel.profile.wall
    lip: list[Point] = [outer[-1], vessel.profile.inner[-1]]
    if wall <= _WIDEST_BEAD:
        lip = bead(outer[-1][0] - wall / 2, vessel.height, wall)
    edges = [revolve(lip)]
    if vessel.stands:
        thick = min(wall, 0.7 * vessel.profile.bottom)
        edges.append(revolve(bead(outer[0][0], thick, thick)))
    return edges if vessel.thread is None else [*edges, vessel.thread.ridge(vessel.height)]
