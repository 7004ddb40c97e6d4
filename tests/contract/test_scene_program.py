"""`labutopia-scene`: what a user types, what it answers."""

import hashlib
import json

import mujoco
import numpy as np
import pytest
from PIL import Image

from labutopia_lerobot.cli.scene import main
from labutopia_lerobot.labware.instrument_catalogue import catalogue
from labutopia_lerobot.scenes.families import families
from labutopia_lerobot.scenes.plans import plan_names, text_of
from small_room import ROOM
from typed_commands import typed


@pytest.fixture
def scene(monkeypatch, capsys):
    """Type a command; returns its exit status, output and errors."""
    return typed("labutopia-scene", main, monkeypatch, capsys)


def test_list_is_json_of_four_sorted_lists(scene):
    status, out, _ = scene("list", "--json")
    found = json.loads(out)
    assert status == 0
    assert list(found) == ["instruments", "glassware", "families", "rooms"]
    assert all(len(names) == len(set(names)) for names in found.values())
    assert all(found[what] == sorted(found[what]) for what in ("instruments", "families"))
    for what, first, then in [
        ("rooms", "physics_9", "physics_10"),
        ("glassware", "beaker_low 5 ml", "beaker_low 10 ml"),
    ]:
        assert found[what].index(first) == found[what].index(then) - 1
    assert set(found["instruments"]) == set(catalogue())
    assert set(found["families"]) == set(families())
    assert set(found["rooms"]) == set(plan_names())
    assert "beaker_low 250 ml" in found["glassware"]


def test_the_list_for_people_has_short_lines_sizes_by_kind_and_rooms_by_family(scene):
    status, out, _ = scene("list")
    assert status == 0
    assert max(len(line) for line in out.splitlines()) <= 100
    assert "  beaker_conical: 100 ml, 250 ml, 500 ml\n" in out
    assert "  organic_0, organic_1," in out


def test_the_folder_of_a_map_is_no_file(scene, tmp_path):
    status, _, err = scene("occupancy", "organic_7", "--out", str(tmp_path / "map.png"))
    assert status == 2
    assert "map.png is to be a folder" in err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_generate_writes_specification_mjcf_and_picture_the_same_bytes_twice(scene, tmp_path):
    for folder in ("one", "two"):
        words = ("--family", "weighing_room", "--seed", "4", "--out", str(tmp_path / folder))
        assert scene("generate", *words)[0] == 0
    files = [file for file in sorted((tmp_path / "one").rglob("*")) if file.is_file()]
    assert {file.name for file in files} >= {
        f"weighing_room_4.{end}" for end in ("json", "xml", "png")
    }
    for file in files:
        assert (
            file.read_bytes()
            == (tmp_path / "two" / file.relative_to(tmp_path / "one")).read_bytes()
        )
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "one" / "weighing_room_4.xml"))
    assert model.body("work_bench_1").id > 0
    picture = np.asarray(Image.open(tmp_path / "one" / "weighing_room_4.png"))
    assert picture.std() > 20
    assert scene("check", str(tmp_path / "one" / "weighing_room_4.json"))[0] == 0


def test_check_names_the_faults_of_a_file_and_fails(scene, tmp_path):
    text = text_of(ROOM).replace('"x": 3.0, "y": 0.335', '"x": 0.6, "y": 3.2')
    (tmp_path / "bad.json").write_text(text)
    status, out, _ = scene("check", str(tmp_path / "bad.json"), plan_names()[0])
    assert status == 1
    assert "wall_bench_1 and refrigerator_1 overlap" in out
    assert f"{plan_names()[0]} is proven" in out
    assert "1 of 2 rooms have faults" in out


def test_occupancy_writes_data_and_a_picture(scene, tmp_path):
    (tmp_path / "small.json").write_text(text_of(ROOM))
    for resolution, shape in (("0.05", (120, 140)), ("0.5", (12, 14))):
        words = (str(tmp_path / "small.json"), "--resolution", resolution, "--out", str(tmp_path))
        assert scene("occupancy", *words)[0] == 0
        written = np.load(tmp_path / f"small_{resolution}.npz")
        assert written["cells"].shape == shape
        assert tuple(written["origin"]) == (0.0, 0.0)
        assert float(written["resolution"]) == float(resolution)
        plan = (tmp_path / "small.json").read_bytes()
        assert str(written["plan_sha256"]) == hashlib.sha256(plan).hexdigest()
        picture = np.asarray(Image.open(tmp_path / f"small_{resolution}.png"))
        assert ((picture[::-1] == 0) == (written["cells"] == 1)).all()


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("generate", "--family", "organik", "--out", "x"), "Did you mean 'organic'?"),
        (("check", "organic"), "Room 'organic' is unknown. Did you mean"),
        (("check", "none.json"), "none.json cannot be read"),
        (("occupancy", "none.json", "--out", "x"), "none.json cannot be read"),
        (("occupancy", "x", "--resolution", "0", "--out", "x"), "0.01 to 2 m"),
        (("generate", "--family", "organic", "--seed", "-1", "--out", "x"), "is no seed"),
        (
            ("generate", "--family", "organic", "--size", "3", "3", "--out", "x"),
            "no place for work_bench",
        ),
    ],
)
def test_a_mistake_is_reported_in_one_message(scene, words, reported):
    status, _, err = scene(*words)
    assert status == 2
    assert reported in err
    assert "Traceback" not in err
