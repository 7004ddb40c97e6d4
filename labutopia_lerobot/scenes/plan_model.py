"""A plan as a MuJoCo spec: building, furniture, instruments, with all that can be opened."""

import math
from collections.abc import Iterable

import mujoco

from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.scenes.building.doors import add_door, add_window
from labutopia_lerobot.scenes.building.masonry import Masonry, masonry
from labutopia_lerobot.scenes.building.surfaces_model import (
    add_surface_materials,
    add_surfaces,
    add_wall_looks,
    add_wall_solids,
)
from labutopia_lerobot.scenes.laboratory_model import add_lights
from labutopia_lerobot.scenes.plan import Opening, Placed, Plan
from labutopia_lerobot.scenes.space.ware_room import closure_of, made
from labutopia_lerobot.world import ROOM
from labutopia_lerobot.world.model import PHYSICS_HZ, SOLIMP, SOLREF


def build(plan: Plan) -> mujoco.MjSpec:
    """Return a furnished room as a spec (angles in radians), in the room's frame.

    Every piece is a body of its name, free where it is not fixed; floor and walls are the body
    `world.ROOM`, doors and windows the bodies `door_1`, `window_1` and so on.
    """
    spec = mujoco.MjSpec()
    spec.modelname = plan.name
    spec.compiler.degree = False
    spec.default.geom.solref[:] = SOLREF
    spec.default.geom.solimp[:] = SOLIMP
    spec.option.timestep = 1.0 / PHYSICS_HZ
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 30.0
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.stat.extent = 1.0  # so that the clipping planes are in metres
    spec.stat.center = [plan.size[0] / 2, plan.size[1] / 2, 1.0]
    spec.visual.map.znear, spec.visual.map.zfar = 0.02, 60.0
    spec.visual.global_.offwidth, spec.visual.global_.offheight = 1920, 1080
    spec.visual.quality.shadowsize = 0
    add_surface_materials(spec, plan)
    room, walls = spec.worldbody.add_body(name=ROOM), masonry(plan)
    add_surfaces(room, plan)
    add_wall_solids(room, (box for wall in walls for box in wall.boxes()))
    add_wall_looks(spec, room, walls)
    add_openings(spec, plan, walls)
    add_pieces(spec, plan.pieces)
    add_ware(spec, plan)
    add_lights(spec)
    return spec


def add_openings(spec: mujoco.MjSpec, plan: Plan, walls: list[Masonry]) -> None:
    """Add doors and windows."""
    numbers = {"door": 0, "window": 0}
    for opening in plan.openings:
        numbers[opening.kind] += 1
        name = f"{opening.kind}_{numbers[opening.kind]}"
        for wall in walls:
            if opening in wall.openings:
                body = spec.worldbody.add_body(
                    name=name, pos=_front(wall, opening), quat=facing(opening.heading)
                )
                add = add_door if opening.kind == "door" else add_window
                add(spec, body, opening, wall.across[1] - wall.across[0])


def add_pieces(spec: mujoco.MjSpec, pieces: Iterable[Placed]) -> None:
    """Add furniture and instruments."""
    for placed in pieces:
        piece = instrument(placed.kind, placed.name)
        body = piece.add_to(spec, spec.worldbody)
        body.pos = (placed.x, placed.y, placed.height)
        body.quat = facing(placed.heading)
        if piece.movable:
            body.add_freejoint(name=f"{piece.name}_free")


def add_ware(spec: mujoco.MjSpec, plan: Plan) -> None:
    """Add ware, and what closes it; nothing is in it."""
    carriers = {piece.name: piece for piece in plan.pieces}
    for placed in plan.ware:
        quat = facing(carriers[placed.on].heading)
        parts: list[tuple[Vessel | Utensil, float]] = [
            (made(placed.kind, placed.size, placed.name), 0.0)
        ]
        if placed.closed:
            parts.append(closure_of(placed.kind, placed.size, placed.name))
        for piece, up in parts:
            body = piece.add_to(spec, spec.worldbody)
            body.pos, body.quat = (placed.x, placed.y, placed.height + up), quat
            body.add_freejoint(name=f"{body.name}_free")


def facing(heading: float) -> tuple[float, float, float, float]:
    """Return the orientation of what faces -x in its own frame and is to face a heading [deg]."""
    half = math.radians(heading + 180.0) / 2
    return (math.cos(half), 0.0, 0.0, math.sin(half))


def _front(wall: Masonry, opening: Opening) -> tuple[float, float, float]:
    """Return the middle of the lower edge of an opening, on the side that it faces [m]."""
    at = wall.across[opening.heading in (0, 90)]
    if wall.along == 0:
        return opening.x, at, opening.sill
    return at, opening.y, opening.sill
