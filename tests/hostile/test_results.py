"""Results and submissions that somebody made to do harm, or that are damaged."""

import json
import os
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from eval.written_rows import written
from hostile.programs import run
from labutopia_lerobot.evaluation.result_folder import SCHEMA
from labutopia_lerobot.evaluation.rows import summarise

type Damage = Callable[[dict[str, Any]], object]

SCRIPT = "<script>alert(1)</script>"


def result(**columns: Any) -> dict[str, Any]:
    """Return a result of three episodes."""
    rows = written("level1/pick", "random", 1.0, n=3)
    return {
        "schema": SCHEMA,
        "rows": [asdict(one) | columns for one in rows],
        "summary": [summary.columns for summary in summarise(rows)],
        "provenance": {"config": {"episodes": 3, "seed": 100_000}, "versions": {}, "sources": "x"},
    }


def column(**columns: Any) -> Damage:
    """Change a column of every row."""
    return lambda content: [one.update(columns) for one in content["rows"]]


def entry(**entries: Any) -> Damage:
    """Change entries of the result."""
    return lambda content: content.update(entries)


DAMAGED: dict[str, Damage] = {
    "rows are a number": entry(rows=5),
    "a row is null": entry(rows=[None]),
    "rows are empty lists": entry(rows=[[]]),
    "provenance is a list": entry(provenance=[]),
    "options are a list": entry(provenance={"config": [1]}),
    "the schema is of tomorrow": entry(schema=SCHEMA + 1),
    "the schema is a word": entry(schema="x"),
    "seconds are words": column(seconds="x"),
    "seconds are a huge number": column(seconds=10**400),
    "substeps are a list": column(substeps=[1]),
    "a substep is a list": column(substeps={"aligned": [1]}),
    "a seed is a word": column(seed="x"),
    "success is a number": column(success=1),
    "axes are a number": column(axes=5),
    "the task is a list": column(task=[]),
    "facts are a word": column(facts="x"),
    "history is a number": column(history=1),
    "an outcome is a list": column(outcome=[]),
}

NO_JSON = {
    "nothing": "",
    "half": "{",
    "nested without end": "[" * 100_000,
    "a list": "[]",
    "a huge number": "1" * 10_000,
}

READING = {
    "report": ("result", "--out", "page/report.html"),
    "compare": ("result", "result"),
    "check-submission": ("result/result.json",),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "result").mkdir()
    return tmp_path / "result"


@pytest.mark.parametrize("damage", DAMAGED.values(), ids=DAMAGED)
@pytest.mark.parametrize(
    "program", ["report", *(pytest.param(n, marks=pytest.mark.slow) for n in list(READING)[1:])]
)
def test_a_damaged_result_is_refused(
    damage: Damage, program: str, folder: Path, tmp_path: Path
) -> None:
    content = result() | {"actions": [{}] * 3}
    damage(content)
    (folder / "result.json").write_text(json.dumps(content))
    assert run(program, *READING[program], folder=tmp_path).refused


@pytest.mark.parametrize("program", READING)
@pytest.mark.parametrize("text", NO_JSON.values(), ids=NO_JSON)
def test_what_is_no_result_is_refused(
    text: str, program: str, folder: Path, tmp_path: Path
) -> None:
    (folder / "result.json").write_text(text)
    assert run(program, *READING[program], folder=tmp_path).refused


@pytest.mark.parametrize("program", READING)
def test_a_pipe_is_no_result(program: str, folder: Path, tmp_path: Path) -> None:
    os.mkfifo(folder / "result.json")
    assert run(program, *READING[program], folder=tmp_path).refused


@pytest.mark.parametrize(
    "columns",
    [
        {"outcome": SCRIPT, "success": False, "cause": SCRIPT},
        {"policy": SCRIPT},
        {"task": SCRIPT},
        {"substeps": {SCRIPT: 0.1}},
        {"room": SCRIPT},
    ],
)
def test_the_page_shows_what_others_wrote_and_does_not_run_it(
    columns: dict[str, Any], folder: Path, tmp_path: Path
) -> None:
    (folder / "result.json").write_text(json.dumps(result(**columns)))
    ended = run("report", *READING["report"], folder=tmp_path)
    assert ended.status == 0, ended
    assert "<script" not in (tmp_path / "page/report.html").read_text()


def test_no_film_from_elsewhere_is_embedded(folder: Path, tmp_path: Path) -> None:
    secret = tmp_path / "private/home.mp4"
    secret.parent.mkdir()
    secret.write_bytes(b"secret film")
    (folder / "videos").mkdir()
    (folder / "videos/level1-pick_id_seed100000_success.mp4").symlink_to(secret)
    leaving = {"outcome": "/../../../private/home", "success": False, "cause": "dropped"}
    for columns in ({}, leaving):
        (folder / "result.json").write_text(json.dumps(result(**columns)))
        ended = run("report", *READING["report"], folder=tmp_path)
        assert ended.status == 0, ended
        assert "c2VjcmV0IGZpbG0" not in (tmp_path / "page/report.html").read_text()


def test_a_page_is_not_written_through_a_link(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.txt"
    other.write_text("mine")
    (tmp_path / "page").mkdir()
    (tmp_path / "page/report.html").symlink_to(other)
    (folder / "result.json").write_text(json.dumps(result()))
    assert run("report", *READING["report"], folder=tmp_path).status == 0
    assert other.read_text() == "mine"


@pytest.mark.parametrize(
    "actions", [{}, {"shape": [1, 8], "zlib": "x"}, {"shape": ["x"], "zlib": ""}, [], 5, None]
)
def test_actions_that_are_none_are_refused(actions: Any, folder: Path, tmp_path: Path) -> None:
    content = result() | {"actions": [actions] * 3}
    (folder / "result.json").write_text(json.dumps(content))
    assert run("check-submission", *READING["check-submission"], folder=tmp_path).refused


@pytest.mark.parametrize("sources", ["[/red]", "\x1b[31m", 5, {"a": 1}])
def test_words_of_a_submission_are_no_markup(sources: Any, folder: Path, tmp_path: Path) -> None:
    content = result() | {"actions": [{}] * 3}
    content["provenance"]["sources"] = sources
    (folder / "result.json").write_text(json.dumps(content))
    ended = run("check-submission", *READING["check-submission"], folder=tmp_path)
    assert ended.refused, ended
    assert "\x1b[31m" not in ended.output
