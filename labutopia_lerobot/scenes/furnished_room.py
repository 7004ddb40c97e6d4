"""A plan as the room of a task: its first work place is where the laboratory's bench is."""

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.room import Room
from labutopia_lerobot.scenes.views import View

if TYPE_CHECKING:
    import mujoco

    from labutopia_lerobot.robots.mobile_base import MobileBase
    from labutopia_lerobot.scenes.ground import Ground


def furnished_room(plan: Plan) -> Room:
    """Return the room of a plan that has a work place.

    Bench, robot and cameras are where they are in the laboratory, so that a task is the same in
    every room; the room is moved around them.
    """
    return Room(
        name=plan.name,
        builder=partial(_build, plan),
        bench=LABORATORY.bench,
        robot_stand=LABORATORY.robot_stand,
        decorator=partial(_decorate, plan),
        furniture=partial(_furniture, plan),
        solidifier=partial(_make_solid, plan),
        mapper=partial(_map, plan),
        surveyor=partial(_survey, plan),
        remover=partial(_without, plan),
    )


def _without(plan: Plan, names: frozenset[str]) -> Room:
    """Return the room of a plan that is built without some pieces and what stands on them."""
    pieces = tuple(piece for piece in plan.pieces if not {piece.name, piece.on} & names)
    ware = tuple(ware for ware in plan.ware if ware.on in {piece.name for piece in pieces})
    rest = furnished_room(replace(plan, pieces=pieces, ware=ware))
    return replace(rest, mapper=partial(_map, plan), surveyor=partial(_survey, plan))


def _build(plan: Plan, room: Room, view: View) -> "mujoco.MjSpec":
    from labutopia_lerobot.scenes.furnished_room_model import work_place  # here: mujoco

    return work_place(plan, room, view)


def _decorate(plan: Plan, spec: "mujoco.MjSpec", view: View) -> None:
    from labutopia_lerobot.scenes.furnished_room_model import decorate  # here: mujoco

    decorate(plan, spec, view)


def _make_solid(plan: Plan, spec: "mujoco.MjSpec") -> None:
    from labutopia_lerobot.scenes.furnished_room_model import make_solid  # here: mujoco

    make_solid(plan, spec)


def _map(plan: Plan) -> Occupancy:
    from labutopia_lerobot.scenes.room_map import map_around  # here: mujoco

    return map_around(plan, plan.work_places[0])


def _survey(plan: Plan, base: "MobileBase") -> "Ground":
    from labutopia_lerobot.scenes.survey import surveyed  # here: mujoco

    return surveyed(plan, base)


def _furniture(plan: Plan) -> tuple[Piece, ...]:
    from labutopia_lerobot.scenes.within_reach import real_pieces  # here: mujoco

    return tuple(real.piece for real in real_pieces(plan))
