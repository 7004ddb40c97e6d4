"""One table of what lies in a folder: finished, unfinished, of other versions."""

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pytest

from labutopia_lerobot.evaluation.found import find_results
from labutopia_lerobot.evaluation.row import UnreadableResultError
from labutopia_lerobot.evaluation.statistics import summarise

from .test_statistics import row

REPORT = Path(__file__).parents[2] / "eval" / "report.py"

ROWS = [
    row(0, "success", ever=True, lifted=2.0),
    row(1, "timeout", ever=False, lifted=None),
    row(2, "success", ever=True, lifted=2.0),
]


def write(folder: Path, *, finished: bool, rows: list[dict]) -> None:
    folder.mkdir(parents=True)
    (folder / "rows.jsonl").write_text("".join(json.dumps(line) + "\n" for line in rows))
    if finished:
        summary = [asdict(line) for line in summarise(ROWS)]
        (folder / "result.json").write_text(json.dumps({"rows": rows, "summary": summary}))


def test_an_unfinished_result_is_shown_as_one(tmp_path: Path) -> None:
    rows = [asdict(line) for line in ROWS]
    write(tmp_path / "a", finished=True, rows=rows)
    write(tmp_path / "b", finished=False, rows=rows[1:])
    with (tmp_path / "b" / "rows.jsonl").open("a") as file:
        file.write('{"task": "level1/pi')
    whole, part = find_results(tmp_path)
    assert (whole.finished, whole.summaries[0].n, whole.summaries[0].successes) == (True, 3, 2)
    assert (part.finished, part.summaries[0].n, part.summaries[0].successes) == (False, 2, 1)
    line = [sys.executable, str(REPORT), str(tmp_path)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "2/3" in done.stdout
    assert "1/2" in done.stdout
    assert f"Unfinished: {tmp_path / 'b'}, 2 episodes so far" in done.stdout


def test_columns_of_a_later_version_are_left_aside(tmp_path: Path) -> None:
    write(tmp_path / "a", finished=False, rows=[asdict(ROWS[0]) | {"mood": "fine"}])
    write(tmp_path / "b", finished=True, rows=[])
    result = json.loads((tmp_path / "b" / "result.json").read_text())
    result["summary"][0]["mood"] = "fine"
    (tmp_path / "b" / "result.json").write_text(json.dumps(result))
    assert [found.summaries[0].n for found in find_results(tmp_path)] == [1, 3]


def test_rows_of_an_earlier_version_are_read(tmp_path: Path) -> None:
    later = ("prelude_failures", "expert_failure", "cause", "device", "renderer")
    write(
        tmp_path / "a",
        finished=False,
        rows=[{k: v for k, v in asdict(ROWS[0]).items() if k not in later}],
    )
    (found,) = find_results(tmp_path)
    assert found.summaries[0].n == 1


def test_what_is_no_result_is_told(tmp_path: Path) -> None:
    with pytest.raises(UnreadableResultError, match=r"python eval/run\.py"):
        find_results(tmp_path)
    write(tmp_path / "a", finished=False, rows=[{"task": "level1/pick"}])
    with pytest.raises(UnreadableResultError, match="lacks the columns split"):
        find_results(tmp_path)
