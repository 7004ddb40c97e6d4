"""A plan is a small readable file; what is wrong in one is reported by its place."""

import json
import re
from dataclasses import replace

import pytest

from labutopia_lerobot.scenes.plans import (
    PlanError,
    UnknownPlanError,
    find_plan,
    load_plan,
    plan_from,
    plan_names,
    read_plan,
    text_of,
)
from small_room import ROOM


def said(**changes: object) -> str:
    """Return the room as a file with some keys changed; None takes one away."""
    values = json.loads(text_of(ROOM)) | changes
    return json.dumps({key: value for key, value in values.items() if value is not None})


def test_what_is_written_is_read_as_it_was():
    assert plan_from(text_of(ROOM), "small") == ROOM


def test_the_same_plan_is_the_same_bytes():
    jittered = replace(ROOM, size=(7.0 + 1e-9, 6.0, 3.0 - 1e-9))
    assert text_of(jittered) == text_of(ROOM)


def test_a_piece_is_a_line():
    lines = text_of(ROOM).splitlines()
    assert sum('"kind"' in line for line in lines) == len(ROOM.pieces) + len(ROOM.openings)


PIECE = {"kind": "stool", "name": "seat", "x": 1.0, "y": 1.0, "heading": 0}


WARE = {
    "kind": "beaker_low",
    "size": "250 ml",
    "name": "beaker",
    "x": 0.5,
    "y": 2.6,
    "height": 0.9,
    "on": "wall_bench_1",
}


@pytest.mark.parametrize(
    ("changes", "reported"),
    [
        ({"colour": "red"}, "unknown key 'colour'. Keys: name, family"),
        ({"size": None}, "'size' is missing"),
        ({"size": [7.0, 6.0]}, "size: [7.0, 6.0] should be 3 numbers in brackets"),
        ({"seed": "one"}, 'seed: "one" should be a whole number'),
        ({"floor": "lava"}, "floor 'lava' is unknown. Choose: grey vinyl"),
        ({"wall": "lava"}, "wall 'lava' is unknown. Choose: white"),
        ({"pieces": [PIECE | {"kind": "stol"}]}, "Unknown instrument 'stol'. Did you mean 'stool'"),
        ({"pieces": [PIECE | {"heading": 45}]}, "pieces[0].heading: 45 should be one of [0, 90"),
        ({"pieces": [PIECE | {"x": "left"}]}, 'pieces[0].x: "left" should be a number'),
        ({"pieces": [PIECE | {"on": "desk"}]}, "'seat' stands on 'desk', which is no piece before"),
        ({"pieces": [PIECE, PIECE]}, "pieces[1]: the name 'seat' is taken"),
        ({"pieces": [PIECE]}, "'work_bench_1' is no work bench of this room"),
        ({"ware": [WARE | {"kind": "beakr"}]}, "ware[0]: Unknown ware 'beakr'. Did you mean"),
        ({"ware": [WARE | {"size": "3 ml"}]}, "ware[0]: No beaker_low of size '3 ml'; sizes: 5 ml"),
        ({"ware": [WARE | {"closed": True}]}, "ware[0]: beaker_low comes without a closure"),
        ({"ware": [WARE | {"contents": "mud"}]}, "ware[0]: substance 'mud' is unknown"),
        ({"ware": [WARE | {"level": 2.0}]}, "ware[0]: a level of 2; what a vessel holds has"),
        ({"ware": [WARE | {"on": "desk"}]}, "'beaker' stands on 'desk', which is no piece"),
        ({"ware": [WARE, WARE]}, "ware[1]: the name 'beaker' is taken"),
        ({"openings": []}, "the first of openings must be the door"),
    ],
)
def test_what_is_wrong_in_a_file_is_named(changes, reported):
    with pytest.raises(PlanError, match=rf"room\.json.*{re.escape(reported)}"):
        plan_from(said(**changes), "room.json")


def test_what_is_no_file_or_no_json_is_reported(tmp_path):
    with pytest.raises(PlanError, match=r"none\.json cannot be read"):
        read_plan(tmp_path / "none.json")
    (tmp_path / "broken.json").write_text("{")
    with pytest.raises(PlanError, match=r"broken\.json cannot be read: it is no JSON"):
        read_plan(tmp_path / "broken.json")


def test_a_room_is_found_by_its_name_or_its_file(tmp_path):
    name = plan_names()[0]
    file = tmp_path / "mine.json"
    file.write_text(text_of(load_plan(name)))
    assert find_plan(str(file)) == find_plan(name)
    with pytest.raises(UnknownPlanError, match=f"Did you mean '{name[:-1]}"):
        find_plan(name[:-1])
