"""The leaderboard: what stands side by side is of one condition, and ranked is what compares."""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path

import pytest

import make_leaderboard
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.reporting.leaderboard import leaderboard_page, leaderboard_tables
from labutopia_lerobot.evaluation.reporting.table import Rate, Table
from labutopia_lerobot.evaluation.result_folder import SCHEMA
from labutopia_lerobot.evaluation.rows import Row, summarise
from labutopia_lerobot.evaluation.submission import PUBLISHED, SubmissionError
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson
from labutopia_lerobot.registry import tasks_of_levels

from .written_rows import written

PICK = written("level1/pick", "act", 0.9, n=100)
LEVEL_2 = tasks_of_levels([2])


def won(task: str, share: int, like: Sequence[Row] = PICK, **columns: object) -> list[Row]:
    """Return 100 rows of a task, as many of which are successes."""
    return [
        replace(row, task=task, success=index < share, **columns)  # type: ignore[arg-type]
        for index, row in enumerate(like)
    ]


def kept(folder: Path, *rows: Row, **config: object) -> dict[str, object]:
    options = {"seed": 100_000, "episodes": 100, "until": None, **PUBLISHED, **config}
    return {
        "schema": SCHEMA,
        "rows": [asdict(row) for row in rows],
        "summary": [
            summary.columns for summary in summarise(rows, sequential=options["until"] is not None)
        ],
        "provenance": {"commit": "0123456789", "config": options},
    }


@pytest.fixture
def board(tmp_path: Path) -> Path:
    """A folder with the expert's rows of level1/pick only."""
    (tmp_path / "submissions").mkdir()
    expert = [replace(row, policy="expert", success=True) for row in PICK]
    (tmp_path / "level1-pick.json").write_text(json.dumps(kept(tmp_path, *expert)))
    return tmp_path


def submit(board: Path, name: str, *rows: Row, **config: object) -> None:
    content = kept(board, *rows, **config) | {"actions": [{}] * len(rows)}
    (board / "submissions" / f"{name}.json").write_text(json.dumps(content))


def lines(table: Table) -> dict[str, dict[str, object]]:
    return {str(line[1]): dict(zip(table.head, line, strict=True)) for line in table.lines}


def section(board: Path, title: str) -> dict[str, dict[str, object]]:
    tables = {table.title: table for table in leaderboard_tables(board)}
    return lines(tables[title])


def test_the_leaderboard_is_up_to_date() -> None:
    assert make_leaderboard.PAGE.read_text() == make_leaderboard.content()


def test_baselines_stand_among_the_entries(board: Path) -> None:
    ours = load_results(board)[0]
    rows = tuple(won("level1/pick", 40, obs="state"))
    baseline = replace(ours, rows=rows)
    submit(board, "someone", *won("level1/pick", 50, obs="state"))
    tables = {table.title: table for table in leaderboard_tables(board, [baseline])}
    entries = lines(tables["Level 1, ID"])
    assert list(entries) == ["scripted expert", "someone (act, state)", "baseline (act, state)"]
    assert entries["baseline (act, state)"]["pick"] == Rate(40, 100, wilson(40, 100))
    coarse = replace(baseline, provenance={"config": {**ours.config, "particles": 300}})
    with pytest.raises(SubmissionError, match="particles=300"):
        leaderboard_tables(board, [coarse])


def test_a_submission_has_a_line_of_its_own(board: Path) -> None:
    submit(board, "someone", *won("level1/pick", 50, obs="state"))
    page = leaderboard_page(board)
    assert "## Level 1, ID" in page
    assert "It cannot show whose they are" in page
    (expert,) = (line for line in page.splitlines() if line.startswith("|  | scripted expert"))
    assert "100/100 100.0 [96, 100]" in expert
    (line,) = (line for line in page.splitlines() if "someone (act, state)" in line)
    assert "50/100 50.0 [40, 60]" in line


def test_complete_entries_are_ranked_by_their_mean_and_others_are_not(board: Path) -> None:
    good = [row for task in LEVEL_2 for row in won(task, 90)]
    better = [row for task in LEVEL_2 for row in won(task, 95)]
    submit(board, "good", *good)
    submit(board, "better", *better)
    submit(board, "lucky", *won(LEVEL_2[0], 100))
    found = section(board, "Level 2, ID")
    assert [(name, line["rank"], line["mean"]) for name, line in found.items()] == [
        ("better (act)", "1", "95.0 %"),
        ("good (act)", "2", "90.0 %"),
        ("lucky (act)", "", None),
    ]
    assert list(found["good (act)"])[3:-1] == [task.partition("/")[2] for task in LEVEL_2]


def test_entries_with_the_same_mean_have_the_same_rank(board: Path) -> None:
    for name, share in (("a", 90), ("b", 90), ("c", 80)):
        submit(board, name, *(row for task in LEVEL_2 for row in won(task, share)))
    found = section(board, "Level 2, ID")
    assert [line["rank"] for line in found.values()] == ["1", "1", "3"]


def test_conditions_never_share_a_cell_or_a_mean(board: Path) -> None:
    played = {
        "Level 2, ID": {},
        "Level 2, OOD": {"split": "ood"},
        "Level 2, OOD light": {"split": "ood", "axes": ["light"]},
        "Level 2, OOD light+wall": {"split": "ood", "axes": ["wall", "light"]},
        "Level 2, all axes": {"split": "ood", "axes": ["all"]},
        "Level 2, ID wall": {"axes": ["wall"]},
        "Level 2, ID, staged": {"play": "staged"},
        "Level 2, ID, single steps": {"step": "pick"},
    }
    rows = [
        row
        for share, columns in enumerate(played.values())
        for task in LEVEL_2
        for row in won(task, 10 * share, **columns)
    ]
    submit(board, "all", *rows)
    tables = {table.title: table for table in leaderboard_tables(board)}
    assert tables.keys() == played.keys() | {"Level 1, ID"}
    for share, title in enumerate(played):
        (line,) = lines(tables[title]).values()
        assert line["mean"] == f"{10 * share:.1f} %"
        assert {cell.count for cell in line.values() if isinstance(cell, Rate)} == {10 * share}


def test_steps_of_one_task_are_columns_of_their_own(board: Path) -> None:
    rows = won("level2/pour_liquid", 100) + won("level2/pour_liquid", 0, step="pick")
    submit(board, "a", *rows, *won("level2/pour_liquid", 50, step="pour"))
    whole = section(board, "Level 2, ID")["a (act)"]["pour_liquid"]
    steps = section(board, "Level 2, ID, single steps")["a (act)"]
    counts = [steps[name].count for name in ("pour_liquid pick", "pour_liquid pour")]  # type: ignore[attr-defined]
    assert isinstance(whole, Rate)
    assert (whole.count, counts) == (100, [0, 50])


def test_a_run_that_stopped_by_itself_shows_its_sequence_and_is_ranked_if_it_knows_enough(
    board: Path,
) -> None:
    few = [row for task in LEVEL_2 for row in won(task, 9, PICK[:9])]
    like = written("level1/pick", "act", 0.9, n=400)
    many = [row for task in LEVEL_2 for row in won(task, 360, like)]
    submit(board, "few", *few, until=0.2)
    submit(board, "many", *many, until=0.05)
    found = section(board, "Level 2, ID")
    assert [(name, line["rank"]) for name, line in found.items()] == [
        ("many (act)", "1"),
        ("few (act)", ""),
    ]
    (cell,) = {line["pour_liquid"] for name, line in found.items() if name == "few (act)"}
    (summary,) = summarise(won("level2/pour_liquid", 9, PICK[:9]), sequential=True)
    low, _ = summary.anytime95
    assert cell == f"9/9 100.0 [{100 * low:.0f}, 100] until"


def test_what_was_not_played_as_published_is_on_no_board(board: Path) -> None:
    submit(board, "lucky", *won("level1/pick", 100)[5:])
    with pytest.raises(SubmissionError, match=r"lucky\.json.* each once and in order"):
        leaderboard_page(board)
