"""docs/results.md and the README say what is measured, and of all else that it is not."""

import json
from pathlib import Path

import pytest

import experiment_rows
import make_results
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.reporting.paper import PaperNumber
from labutopia_lerobot.evaluation.reporting.table import Rate
from labutopia_lerobot.setting import OF_THE_LEVEL, robot_of_level

from .written_rows import keep, written


def test_the_page_of_results_is_up_to_date():
    assert make_results.PAGE.read_text() == make_results.content(), "run scripts/make_results.py"
    assert make_results.README.read_text() == make_results.readme(), "run scripts/make_results.py"


def test_every_cell_of_the_page_is_a_rate_or_says_that_it_is_not_measured():
    table, _, _ = make_results.PAGE.read_text().partition("## Why they fail")
    lines = [line for line in table.splitlines() if line.startswith("| level")]
    cells = [cell.strip() for line in lines for cell in line.split("|")[3:-1]]
    assert cells
    assert all(cell in ("-", "not measured") or "/" in cell for cell in cells)


def test_the_rooms_of_the_expert_are_counted_together():
    table = make_results.elsewhere()
    assert table.head == ("Task", "every axis", "iiwa", "furnished rooms")
    rates = [Rate(count, 10, (0.0, 1.0)) for count in (10, 9, 10)]
    together = make_results._together(rates)
    assert isinstance(together, Rate)
    assert (together.count, together.n) == (29, 30)
    assert make_results._together([]) == "not measured"


def test_results_are_kept_where_the_page_looks_for_them_and_name_no_place_on_this_machine(tmp_path):
    out, place = tmp_path / "out", Path("act/state-100/level1/pick/id")
    rows = written("level1/pick", "act", 0.5, n=20, obs="state")
    keep(out / "eval" / place, rows, weights=f"{out}/train/act")
    (file,) = experiment_rows.keep(out, tmp_path / "kept")
    assert file.parent == tmp_path / "kept" / place
    (kept,) = load_results(file)
    assert [row.success for row in kept.rows] == [row.success for row in rows]
    assert str(tmp_path) not in file.read_text()


def test_an_experiment_without_results_is_refused(tmp_path):
    with pytest.raises(
        experiment_rows.NothingMeasuredError, match="Make one: labutopia-experiment"
    ):
        experiment_rows.keep(tmp_path, tmp_path / "kept")


def test_the_papers_numbers_stand_beside_what_is_measured_here():
    lines = {line[:2]: line[2:] for line in make_results.beside_the_paper().lines}
    ours, theirs, *_ = lines["level1/pick", "id"]
    assert isinstance(ours, Rate)
    assert isinstance(theirs, PaperNumber)
    assert theirs.percent == 75.0  # paper, table of levels 1 and 2
    assert all(any(isinstance(cell, Rate) for cell in line) for line in lines.values())
    assert ("level3/press", "ood") in lines


def test_every_kept_result_is_of_the_evaluation_that_it_stands_for():
    learned = map(make_results.measured, ("results_cpu", "controls", "small_pictures"))
    for kept in (*learned, make_results.measured("other_robots", learned=False)):
        for evaluation, result in kept.results.items():
            assert len(result.rows) == evaluation.episodes, result.place
            shift = evaluation.shift
            assert {(row.split, tuple(row.axes)) for row in result.rows} == {
                (shift.split, shift.axes)
            }, result.place
            steps = {made["step"] for made in result.provenance["checkpoints"].values()}
            assert steps == {evaluation.at or t.steps for t in evaluation.trainings}, result.place
            meant, played = (
                robot_of_level(result.rows[0].task) if robot == OF_THE_LEVEL else robot
                for options in (dict(evaluation.options), result.provenance["config"])
                for robot in [options.get("robot", OF_THE_LEVEL)]
            )
            assert played == meant, result.place


def test_paths_of_an_experiment_are_kept_as_if_it_were_at_the_default_place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rows = written("level1/pick", "act", 0.9, n=3, obs="state", axes=["layout"])
    keep(tmp_path / "out" / "eval" / "act" / "id", rows)
    result = tmp_path / "out" / "eval" / "act" / "id" / "result.json"
    said = json.loads(result.read_text())
    said["provenance"]["config"]["policy"] = {"path": "out/train/act"}
    said["provenance"]["config"]["axes"] = ["layout"]
    result.write_text(json.dumps(said))
    (file,) = experiment_rows.keep(Path("out"), tmp_path / "kept")
    config = json.loads(file.read_text())["provenance"]["config"]
    assert config["axes"] == ["layout"]
    assert config["policy"]["path"] == "outputs/experiments/results_cpu/train/act"
