"""Every constraint of a room is broken once, and the fault is named."""

from dataclasses import replace

import pytest

from labutopia_lerobot.scenes.plan import Opening, Placed, PlacedWare, Plan, Wall
from labutopia_lerobot.scenes.plans import PlanError
from labutopia_lerobot.scenes.proof import faults, proven
from small_room import ROOM


def with_piece(kind: str, x: float, y: float, heading: int = 0, height: float = 0.0) -> Plan:
    added = Placed(kind, "added", x, y, heading, height=height)  # type: ignore[arg-type]
    return replace(ROOM, pieces=(*ROOM.pieces, added))


def with_moved(name: str, **where: object) -> Plan:
    pieces = (replace(p, **where) if p.name == name else p for p in ROOM.pieces)  # type: ignore[arg-type]
    return replace(ROOM, pieces=tuple(pieces))


def with_ware(*at: tuple[float, float], kind: str = "beaker_low", height: float = 0.9) -> Plan:
    ware = (
        PlacedWare(kind, "250 ml", f"ware_{number}", x, y, height, "wall_bench_1")
        for number, (x, y) in enumerate(at, start=1)
    )
    return replace(ROOM, ware=tuple(ware))


PLANTED = {
    "ware over the edge of a bench": (
        with_ware((0.74, 2.6)),
        "ware_1: it stands on no top and no shelf of wall_bench_1",
    ),
    "ware above a bench": (
        with_ware((0.5, 2.6), height=0.95),
        "ware_1: it stands on no top and no shelf of wall_bench_1",
    ),
    "a round flask without a ring": (
        with_ware((0.5, 2.6), kind="round_bottom_flask"),
        "ware_1: it stands on no top and no shelf of wall_bench_1",
    ),
    "ware in an instrument": (with_ware((0.3, 3.05)), "plate and ware_1 overlap"),
    "ware in other ware": (with_ware((0.5, 2.6), (0.5, 2.65)), "ware_1 and ware_2 overlap"),
    "ware on the floor before a refrigerator": (
        with_ware((3.0, 1.0), height=0.5),
        "refrigerator_1: its lower_door cannot move freely: ware_1 is in its way",
    ),
    "two things in each other": (
        with_piece("tall_cupboard", 0.3, 3.2),
        "wall_bench_1 and added overlap",
    ),
    "a thing in the wall": (with_moved("refrigerator_1", y=0.2), "refrigerator_1: it is not ins"),
    "a seat before a refrigerator": (
        with_piece("stool", 3.0, 1.05),
        "refrigerator_1: its lower_door cannot move freely: added is in its way",
    ),
    "a seat before drawers": (
        with_piece("stool", 1.1, 3.45),
        "wall_bench_1: its chest_drawer_0 cannot move freely: added is in its way",
    ),
    "a door that would open into the wall": (
        with_moved("refrigerator_1", y=5.3),
        "refrigerator_1: its upper_door cannot move freely: the room ends there",
    ),
    "a seat behind the entrance": (with_piece("stool", 1.0, 0.6), "door 1: it cannot open: added"),
    "a cupboard before a window": (
        with_piece("tall_cupboard", 3.5, 5.74, 270),
        "window 1: it is covered: added",
    ),
    "a cupboard before the camera": (
        with_piece("tall_cupboard", 6.3, 3.0, 180),
        "work_place_1: its view is blocked: added",
    ),
    "a seat where the robot stands": (
        with_piece("stool", 4.0, 3.0),
        "work_place_1: its robot cannot stand: added",
    ),
    "a thing over the edge of a bench": (
        with_moved("plate", y=3.74),
        "plate: it does not stand on a top of wall_bench_1",
    ),
    "a thing above a bench": (
        with_moved("plate", height=0.95),
        "plate: it does not stand on a top of wall_bench_1",
    ),
    "a cupboard that hangs in the air": (
        with_piece("wall_cupboard", 2.0, 2.0, 0, 1.5),
        "added: it is 1.5 m above the floor and hangs at no wall",
    ),
    "a wall without a door": (
        replace(ROOM, walls=(Wall((2.2, 0.0), (2.2, 6.0)),)),
        "work_place_1: a robot of 0.6 m from the entrance does not get there",
    ),
    "a thing behind that wall": (
        replace(ROOM, walls=(Wall((2.2, 0.0), (2.2, 6.0)),)),
        "refrigerator_1: a robot of 0.6 m from the entrance does not get within 0.855 m",
    ),
    "a gap of 0.48 m before a bench": (
        replace(ROOM, walls=(Wall((1.3, 1.5), (1.3, 6.0)),)),
        "wall_bench_1: a robot of 0.6 m from the entrance does not get within 0.5 m of its front",
    ),
    "a thing on the bench behind that gap": (
        replace(ROOM, walls=(Wall((1.3, 1.5), (1.3, 6.0)),)),
        "plate: a robot of 0.6 m from the entrance does not get within 0.855 m of its front",
    ),
    "an entrance of 0.5 m": (
        replace(ROOM, walls=(Wall((0.0, 0.9), (2.0, 0.9)), Wall((2.0, 0.0), (2.0, 0.9)))),
        "work_place_1: a robot of 0.6 m from the entrance does not get there",
    ),
    "a door wider than its wall": (
        replace(ROOM, openings=(replace(ROOM.openings[0], width=2.5), ROOM.openings[1])),
        "door (openings[0]): it is wider or higher than its wall",
    ),
}


def test_the_room_without_a_fault_is_proven():
    assert faults(ROOM) == []
    assert proven(ROOM, "small") is ROOM


def test_ware_that_stands_well_is_no_fault():
    assert faults(with_ware((0.5, 2.6), (0.5, 2.8))) == []


@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_fault_is_named(planted):
    plan, reported = PLANTED[planted]
    assert [fault for fault in faults(plan) if fault.startswith(reported)], faults(plan)


def test_what_is_low_may_be_in_the_view():
    assert faults(with_piece("stool", 6.2, 4.5)) == []


def test_a_door_in_an_inside_wall_lets_the_robot_through():
    wall, door = Wall((2.2, 0.0), (2.2, 6.0)), Opening("door", 2.2, 4.0, 0, 1.0, 2.1)
    walled = replace(ROOM, walls=(wall,), openings=(*ROOM.openings, door))
    assert faults(walled) == []
    narrow = replace(walled, openings=(*ROOM.openings, replace(door, width=0.55)))
    assert any("does not get there" in fault for fault in faults(narrow))


def test_a_room_with_faults_is_refused_with_all_of_them():
    plan = replace(with_piece("tall_cupboard", 0.3, 3.2), walls=(Wall((2.2, 0.0), (2.2, 6.0)),))
    with pytest.raises(PlanError, match=r"(?s)small\.json.*overlap.*work_place_1") as raised:
        proven(plan, "small.json")
    assert len(str(raised.value).splitlines()) == 1 + len(faults(plan))
