"""The documentation shows the expert's rows, and no others."""

import json
from pathlib import Path

import pytest

import expert_rows
from expert_rows import OtherRowsError
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.registry import is_beyond_paper, task_files
from make_docs import failure_table, metres, start_table, task_table

CHANGED_SINCE = {
    "level2/pour_liquid",
    "level3/pour_liquid",
    "level3/pour_sizes",
    "level4/clean_beaker",
}
"""Tasks of levels 1 to 4 that the expert plays otherwise since the last sweep of all of them."""

CONFIG = {"episodes": 3, "seed": 100_000, "robot": "default", "room": "laboratory"}


PLACES = ("total", "poured", "retained", "spilled", "clinging", "in_flight")


def row(task: str, seed: int, **columns: object) -> dict:
    reported = {
        "task": task,
        "split": "id",
        "axes": [],
        "drawn": {},
        "play": "single",
        "obs": "state",
        "policy": "expert",
        "seed": seed,
        "success": True,
        "ever_success": True,
        "outcome": "success",
        "steps": 150,
        "liquid": None,
        **dict.fromkeys(f"ml_{place}" for place in PLACES),
        "clipped_actions": 0,
        "nonfinite_actions": 0,
        "seconds": 5.0,
        "substeps": {"gripped": 1.0},
        "step_times": {},
        "facts": {"x": True},
        "history": {"x": {"first": 0.0, "last": 5.0, "times": 1}},
        "setup_failures": 1,
    }
    return reported | columns


def result(folder: Path, rows: list[dict], **options: object) -> Path:
    folder.mkdir(parents=True)
    content = {"rows": rows, "summary": [], "provenance": {"config": CONFIG | options}}
    (folder / "result.json").write_text(json.dumps(content))
    return folder


def rows_of(task: str) -> list[dict]:
    return [row(task, 100_000 + index) for index in range(3)]


@pytest.fixture
def kept(tmp_path) -> Path:
    """The rows of every task."""
    rows = [line for task in task_files() for line in rows_of(task)]
    expert_rows.keep(result(tmp_path / "out", rows, out="/home/me"), tmp_path / "kept")
    return tmp_path / "kept"


def test_rows_are_kept_with_their_origin_and_read_again(kept):
    found = expert_rows.read(kept)
    assert list(found) == list(task_files())
    assert [line.seed for line in found["level1/pick"]] == [100_000, 100_001, 100_002]
    content = json.loads((kept / "level1-pick.json").read_text())
    assert content["provenance"]["config"] == CONFIG
    assert "history" not in content["rows"][0]
    assert any(
        line.startswith("| `level1/pick` | Pick up")
        for line in task_table(found, {}, dict.fromkeys(found, "0000000"))
    )
    assert "| `level1/pick` | 3 | success 3 |  |  | 3 |" in failure_table(found)


def test_rows_of_shifted_axes_are_kept_beside_and_shown_where_a_task_has_axes(kept, tmp_path):
    rows = [line | {"split": "ood"} for line in rows_of("level3/pick")]
    (file,) = expert_rows.keep(result(tmp_path / "shifted", rows), kept)
    assert file == kept / "level3-pick-ood.json"
    shifted = expert_rows.read(kept, "ood")
    assert list(shifted) == ["level3/pick"]
    found = expert_rows.read(kept)
    assert {line.split for line in found["level3/pick"]} == {"id"}
    lines = task_table(found, shifted, dict.fromkeys(found, "0000000"))
    cells = {line.split(" | ")[0]: line.split(" | ")[4] for line in lines if "`" in line}
    assert cells["| `level3/pick`"] == "3/3"
    assert cells["| `level3/pour_liquid`"] == "not measured"
    assert cells["| `level1/pick`"] == "-"


@pytest.mark.parametrize(
    ("columns", "reported"),
    [
        ({"policy": "random"}, "policy=random"),
        ({"split": "train"}, "split=train"),
        ({"liquid": "off"}, "liquid=off"),
        ({"axes": ["light"]}, "axes="),
    ],
)
def test_rows_that_are_not_the_expert_as_published_are_refused(kept, tmp_path, columns, reported):
    rows = rows_of("level1/pick")
    other = result(tmp_path / "other", [*rows[:2], rows[2] | columns])
    with pytest.raises(OtherRowsError, match=reported):
        expert_rows.keep(other, kept)
    file = kept / "level1-pick.json"
    content = json.loads(file.read_text())
    content["rows"][1] |= columns
    file.write_text(json.dumps(content))
    with pytest.raises(OtherRowsError, match=reported):
        expert_rows.read(kept)


def test_another_robot_is_refused(tmp_path):
    other = result(tmp_path / "other", rows_of("level1/pick"), robot="iiwa")
    with pytest.raises(OtherRowsError, match="robot=iiwa"):
        expert_rows.keep(other, tmp_path / "kept")


@pytest.mark.parametrize("rows", [rows_of("level1/pick")[:2], rows_of("level1/pick")[:1] * 3])
def test_a_missing_or_repeated_row_is_refused(tmp_path, rows):
    with pytest.raises(OtherRowsError, match="does not hold every row of level1/pick once"):
        expert_rows.keep(result(tmp_path / "other", rows), tmp_path / "kept")


def test_a_missing_task_is_refused_by_name(kept):
    (kept / "level1-shake.json").unlink()
    with pytest.raises(OtherRowsError, match=r"lacks the expert's rows of level1/shake\."):
        expert_rows.read(kept)


def test_an_unfinished_result_is_refused(tmp_path):
    with pytest.raises(OtherRowsError, match=r"result\.json cannot be read"):
        expert_rows.keep(tmp_path, tmp_path / "kept")


def test_kept_rows_of_a_split_of_the_papers_tasks_are_of_one_build_driving_ones_and_others():
    builds: dict[tuple[str, str], set[str]] = {}
    for result in load_results(expert_rows.RESULTS):
        if not is_beyond_paper(task := result.rows[0].task):
            reported = {name: result.provenance[name] for name in ("sources", "versions")}
            level = task if task in CHANGED_SINCE else "levels 1 to 4"
            sweep = "level 5" if task.startswith("level5/") else level, result.rows[0].split
            builds.setdefault(sweep, set()).add(json.dumps(reported, sort_keys=True))
    assert {of for of, _ in builds} == {"levels 1 to 4", "level 5", *CHANGED_SINCE}
    assert {sweep: len(each) for sweep, each in builds.items() if len(each) > 1} == {}


@pytest.mark.parametrize(
    ("length", "text"), [(0.075, "0.075"), (-0.075, "-0.075"), (0.21, "0.21"), (0.3, "0.30")]
)
def test_lengths_have_the_digits_that_they_need(length, text):
    assert metres(length) == text


def test_the_table_of_starts_shows_the_whole_range():
    assert (
        "| `level1/pick` | flask | 0.21 to 0.36 | -0.075 to 0.075 | -180 to 180 |" in start_table()
    )
