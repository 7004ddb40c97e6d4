"""What lies in a folder: finished, unfinished, of other versions; and the program that shows it."""

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pytest

from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.rows import UnreadableResultError

from .test_statistics import row

ROOT = Path(__file__).parents[2]
REPORT = ROOT / "eval" / "report.py"

ROWS = [
    row(0, "success", ever=True, lifted=2.0),
    row(1, "timeout", ever=False, lifted=None),
    row(2, "success", ever=True, lifted=2.0),
]


def write(folder: Path, *, finished: bool, rows: list[dict]) -> None:
    folder.mkdir(parents=True)
    (folder / "rows.jsonl").write_text("".join(json.dumps(line) + "\n" for line in rows))
    if finished:
        (folder / "result.json").write_text(json.dumps({"rows": rows, "summary": []}))


def test_an_unfinished_result_is_shown_as_one(tmp_path: Path) -> None:
    rows = [asdict(line) for line in ROWS]
    write(tmp_path / "a", finished=True, rows=rows)
    write(tmp_path / "b", finished=False, rows=rows[1:])
    with (tmp_path / "b" / "rows.jsonl").open("a") as file:
        file.write('{"task": "level1/pi')
    whole, part = load_results(tmp_path)
    assert (whole.finished, whole.summaries[0].n, whole.summaries[0].successes) == (True, 3, 2)
    assert (part.finished, part.summaries[0].n, part.summaries[0].successes) == (False, 2, 1)
    line = [sys.executable, str(REPORT), str(tmp_path)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "2/3" in done.stdout
    assert "1/2" in done.stdout
    assert "act, state (a)" in done.stdout
    assert f"Unfinished: {tmp_path / 'b'}, 2 episodes so far" in done.stderr
    assert f"Wrote {tmp_path / 'report.html'}" in done.stderr
    assert (tmp_path / "report.html").read_text().startswith("<!doctype html>")


@pytest.mark.slow
def test_an_evaluation_without_a_finished_episode_is_reported_in_one_line(tmp_path: Path) -> None:
    write(tmp_path / "a", finished=False, rows=[])
    line = [sys.executable, str(REPORT), str(tmp_path)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    (reported,) = done.stderr.splitlines()
    assert f"No episode is finished yet in {tmp_path / 'a'}." in reported
    assert not (tmp_path / "report.html").exists()
    write(tmp_path / "b", finished=True, rows=[asdict(line) for line in ROWS])
    done = subprocess.run(line, capture_output=True, text=True, check=True)
    assert f"Unfinished: {tmp_path / 'a'}, 0 episodes so far" in done.stderr


def test_columns_of_a_later_version_are_left_aside(tmp_path: Path) -> None:
    rows = [asdict(line) | {"mood": "fine"} for line in ROWS]
    write(tmp_path / "a", finished=False, rows=rows[:1])
    write(tmp_path / "b", finished=True, rows=rows)
    assert [found.summaries[0].n for found in load_results(tmp_path)] == [1, 3]


def test_rows_of_an_earlier_version_are_read(tmp_path: Path) -> None:
    later = ("setup_failures", "expert_failure", "cause", "device", "renderer", "step_times")
    old = {k: v for k, v in asdict(ROWS[0]).items() if k not in later}
    write(tmp_path / "a", finished=False, rows=[old])
    (found,) = load_results(tmp_path)
    assert found.summaries[0].n == 1


def test_the_rows_that_the_repository_keeps_are_results() -> None:
    found = load_results(ROOT / "eval" / "results")
    assert "level1/pick" in {result.rows[0].task for result in found}
    (one,) = load_results(ROOT / "eval" / "results" / "level1-pick.json")
    assert one.provenance["config"]["seed"] == one.rows[0].seed


def test_what_is_no_result_is_reported(tmp_path: Path) -> None:
    with pytest.raises(UnreadableResultError, match=r"python eval/run\.py"):
        load_results(tmp_path)
    write(tmp_path / "a", finished=False, rows=[{"task": "level1/pick"}])
    with pytest.raises(UnreadableResultError, match="lacks the columns split"):
        load_results(tmp_path)
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(UnreadableResultError, match="no `rows`"):
        load_results(tmp_path / "other.json")
