"""Tables laid out as the paper's, from rows only."""

import csv
import io
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting.page import command, episode_command
from labutopia_lerobot.evaluation.reporting.paper import PaperNumber, paper_number, paper_results
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import (
    conditional_rates,
    failure_table,
    level_tables,
    precision_table,
    step_rates,
)
from labutopia_lerobot.evaluation.reporting.run_tables import run_tables
from labutopia_lerobot.evaluation.reporting.table import (
    FORMATS,
    Rate,
    Table,
    TextTable,
    as_csv,
    as_latex,
    as_markdown,
)
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.evaluation.uncertainty.intervals import Median, wilson

from .written_rows import LEVEL_4, every_level, in_drawn_order, keep, written

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> list[LoadedResult]:
    folders = every_level(tmp_path_factory.mktemp("levels"))
    return [result for folder in folders for result in load_results(folder)]


def result(*rows: Row) -> LoadedResult:
    return LoadedResult(Path("out"), finished=True, rows=rows, provenance={})


def test_each_level_has_its_table_with_the_papers_columns(results: list[LoadedResult]) -> None:
    tables = {table.title: table for table in level_tables(report_entries(results))}
    assert list(tables) == [
        *("Level 1 and level 2", "Level 3", "Size test"),
        *("Level 4: clean_beaker", "Level 4: drying_beakers", "Level 4: liquid_fusion"),
    ]
    assert tables["Level 3"].head[2:] == ("ID", "OOD", "all axes", "paper ID", "paper OOD")
    assert tables["Size test"].head == tables["Level 3"].head
    assert tables["Level 4: clean_beaker"].head == (
        *("Policy", "Played", "SP", "1 pick", "2 pour", "3 place", "4 pick", "5 shake"),
        *("6 pour", "7 place"),
    )
    assert tables["Level 1 and level 2"].head == (
        *("Task", "act", "diffusion", "expert", "paper ACT", "paper DP"),
    )


def test_columns_come_from_the_rows() -> None:
    alone = result(*written("level3/pick", "act", 0.9, split="ood", axes=["light"], n=5))
    (table,) = level_tables(report_entries([alone]))
    assert table.head == ("Task", "Policy", "OOD light", "paper ID", "paper OOD")


def test_a_line_of_level_4_counts_steps_and_what_came_of_the_one_before() -> None:
    (entry,) = report_entries([result(*written("level4/clean_beaker", "act", 0.8, play="staged"))])
    done = [
        sum(row.step_times[name] is not None for row in entry.rows)
        for name in entry.rows[0].step_times
    ]
    (table,) = level_tables([entry])
    staged, conditional, paper = table.lines
    assert [rate.count for rate in staged[-7:] if isinstance(rate, Rate)] == done
    expected = list(zip(done, [120, *done], strict=False))
    assert [(rate.count, rate.n) for rate in conditional_rates(entry) if rate] == expected
    assert paper[-7:] == tuple(
        PaperNumber(percent, 300) for percent in (99.3, 51.9, 43.3, 42.5, 12.3, 10.6, 1.6)
    )
    assert conditional[1] == "A given the one before"
    assert paper[1:3] == ("paper ACT", PaperNumber(14.0, 300))


def test_where_the_order_of_steps_is_drawn_the_first_ones_of_each_episode_count() -> None:
    done = [1, 3, 3, 3, 3, 0, 6, 4]
    (entry,) = report_entries([result(*in_drawn_order(done))])
    counts = [rate.count for rate in step_rates(entry)]
    assert counts == [sum(d >= k for d in done) for k in range(1, 7)]
    expected = list(zip(counts, [len(done), *counts], strict=False))
    assert [(rate.count, rate.n) for rate in conditional_rates(entry) if rate] == expected
    (table,) = level_tables([entry])
    assert table.head[3:] == tuple("123456")
    assert "the first k of each episode's own" in table.note


def test_what_was_played_under_two_conditions_never_shares_a_number() -> None:
    rows = written("level2/pour_liquid", "act", 0.9, n=4)
    for column, value in {
        "liquid": "off",
        "particles": 100,
        "robot": "iiwa",
        "room": "organic_7",
        "obs": "state",
        "split": "ood",
        "axes": ["light"],
        "step": "pour",
        "play": "staged",
        "after": "pick",
    }.items():
        others = [replace(row, **{column: value}) for row in rows]
        found = report_entries([result(*rows, *others)])
        assert [len(entry.rows) for entry in found] == [4, 4], column
        cells = [
            cell
            for table in level_tables(found)
            for line in table.lines
            for cell in line
            if isinstance(cell, Rate)
        ]
        assert all(cell.n <= 4 for cell in cells), column


def test_the_papers_numbers_stand_beside_ours() -> None:
    assert paper_number("level1/stir", "act") == PaperNumber(86.7, 120)
    assert paper_number("level3/press", "pi0", "OOD") == PaperNumber(89.1, 120)
    assert paper_number("level3/pick_sizes", "diffusion") == PaperNumber(11.2, 125)
    assert paper_number("level4/liquid_fusion", "diffusion") == PaperNumber(6.7, 300)
    assert paper_number("level1/squeeze", "act") is None


def test_what_the_paper_prints_twice_or_of_no_action_stands_beside_nothing() -> None:
    for policy, third in (("act", 46.7), ("diffusion", 8.3)):
        fusion = [
            paper_number("level4/liquid_fusion", policy, "ID", "staged", k) for k in range(3, 8)
        ]
        assert fusion == [PaperNumber(third, 300), None, None, None, None]
        drying = [paper_number("level4/drying_beakers", policy, "ID", "staged", k) for k in (6, 7)]
        assert drying[0] is not None
        assert drying[1] is None
    assert len(paper_results()) == 32 + 36 + 8 + 48 - 10
    rows = [row for task in LEVEL_4 for row in written(task, "act", 0.9, n=5)]
    note = level_tables(report_entries([result(*rows)]))[-1].note
    assert "A4 to A7 of liquid_fusion, which repeat clean_beaker's" in note
    assert "any push of the arm over 2 N" in note


def test_the_file_of_the_papers_numbers_has_every_one_as_printed() -> None:
    with (ROOT / "eval" / "paper_results.csv").open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) == 32 + 36 + 8 + 48
    assert sum(bool(row["note"]) for row in rows) == 10
    (copied,) = (row for row in rows if row["note"] and row["percent"] == "42.5")
    assert (copied["task"], copied["step"]) == ("level4/liquid_fusion", "4")


def test_the_numbers_of_episodes_are_those_that_the_fractions_imply() -> None:
    with (ROOT / "eval" / "paper_results.csv").open(newline="") as lines:
        for line in csv.DictReader(lines):
            n, percent = int(line["inferred_n"]), line["percent"]
            printable = {
                text
                for count in range(n + 1)
                for text in (f"{100 * count / n:.1f}", f"{int(1000 * count / n + 1e-9) / 10:.1f}")
            }
            assert (percent in printable) == (line["fraction_of_n"] == "yes"), line


def test_two_checkpoints_of_one_kind_are_distinguished(tmp_path: Path) -> None:
    folders = [
        keep(tmp_path / name, written("level1/pick", "act", 0.9, n=6, luck=luck))
        for luck, name in enumerate(("early", "late"))
    ]
    found = report_entries([found for folder in folders for found in load_results(folder)])
    assert [entry.label for entry in found] == ["act (early)", "act (late)"]


def test_what_is_unusual_about_a_policy_is_reported() -> None:
    rows = written("level1/pick", "act", 0.9, n=3, obs="state")
    assert [entry.label for entry in report_entries([result(*rows)])] == ["act, state"]


def test_who_saw_filaments_pictures_is_never_in_one_line_with_who_saw_others() -> None:
    classic = written("level1/pick", "act", 0.9, n=3)
    filament = [replace(row, seed=row.seed + 9, renderer="Filament on llvmpipe") for row in classic]
    reported = {
        entry.label: len(entry.rows) for entry in report_entries([result(*classic, *filament)])
    }
    assert reported == {"act": 3, "act, renderer=filament": 3}


TABLE = Table(
    "A & B",
    ("Task", "act", "paper_ACT", "mm off place"),
    (
        (
            "level1/pick",
            Rate(8, 10, wilson(8, 10)),
            PaperNumber(75.0, 120),
            Median(1.5, (1.0, 2.0), 8),
        ),
        ("level1/pour", None, None, Median(2.0, None, 3)),
    ),
    "100 % of it",
)


def test_a_table_in_csv_has_every_number_by_itself() -> None:
    first, second = csv.DictReader(io.StringIO(as_csv(TABLE)))
    assert (first["act count"], first["act n"], first["act %"]) == ("8", "10", "80.00")
    assert (first["paper_ACT %"], first["paper_ACT inferred n"]) == ("75.0", "120")
    assert (first["mm off place median"], first["mm off place high"]) == ("1.5", "2.0")
    assert (second["act n"], second["mm off place low"]) == ("", "")


def test_in_csv_a_number_of_the_paper_stands_below_the_heads_of_ours() -> None:
    rate = Rate(8, 10, wilson(8, 10))
    table = Table("Steps", ("SP", "1 pick"), ((rate, rate), (PaperNumber(75.0, 120), "none")), "")
    heads, ours, paper = csv.reader(io.StringIO(as_csv(table)))
    assert len(heads) == len(ours) == len(paper) == 10
    assert paper == ["", "120", "75.0", "", "", "none", "", "", "", ""]


def test_a_table_in_markdown_has_a_line_per_line() -> None:
    lines = as_markdown(TABLE).splitlines()
    assert "| level1/pick | 8/10 80.0 [49, 94] | 75.0 | 1.5 [1, 2] |" in lines
    assert "| level1/pour | - | - | 2 |" in lines


def test_a_table_in_latex_is_escaped() -> None:
    reported = as_latex(TABLE)
    assert r"\caption{A \& B. 100 \% of it}" in reported
    assert r"paper\_ACT" in reported
    assert reported.count(r"\\") == 3


def test_every_table_can_be_written_in_every_format(results: list[LoadedResult]) -> None:
    found = report_entries(results)
    for table in (*level_tables(found), failure_table(found), precision_table(found)):
        assert all(FORMATS[name](table) for name in FORMATS)


def shown(tables: Sequence[Table], width: int = 80) -> list[str]:
    """Return tables as a terminal of this width shows them."""
    lines = io.StringIO()
    console = Console(file=lines, width=width)
    for table in tables:
        console.print(TextTable(table))
    return lines.getvalue().splitlines()


def ran(rows: Sequence[Row], width: int = 80) -> list[str]:
    """Return what a run prints that has played these rows."""
    return shown(run_tables(report_entries([result(*rows)]), level_means=True), width)


@pytest.mark.parametrize("width", [80, 100, 160])
def test_in_a_terminal_every_word_and_number_is_whole(
    results: list[LoadedResult], width: int
) -> None:
    found = report_entries(results)
    for table in (*level_tables(found), failure_table(found), precision_table(found)):
        lines = shown([table], width)
        assert max(map(len, lines)) <= width
        words = " ".join(lines).split()
        for name in table.head:
            assert set(name.split()) <= set(words), (table.title, name)
        reported = Counter(words)
        rates = [cell for line in table.lines for cell in line if isinstance(cell, Rate)]
        counts = Counter(f"{rate.count}/{rate.n}" for rate in rates)
        assert all(reported[word] >= count for word, count in counts.items())


@pytest.mark.parametrize("width", [80, 100, 160])
@pytest.mark.parametrize("policy", ["act", "expert"])
@pytest.mark.parametrize("plays", [("single",), ("single", "staged")])
def test_level_4_prints_sp_and_every_step_by_its_name_on_one_screen(
    width: int, policy: str, plays: tuple[str, ...]
) -> None:
    rows = [
        replace(row, liquid=None if "drying" in task else "off")
        for task in LEVEL_4
        for play in plays
        for row in written(task, policy, 0.93, n=100, play=play, luck=len(play))
    ]
    lines = ran(rows, width)
    assert len(lines) < 30  # and one more says where the result is
    assert max(map(len, lines)) <= width
    assert lines[0] == f"{policy}, ID, liquid=off"
    blocks = [i for i, line in enumerate(lines) if re.match(r"[a-z_]+: \d+/100 \[", line)]
    for entry, start in zip(report_entries([result(*rows)])[:: len(plays)], blocks, strict=True):
        head = " ".join(lines[start + 1 : start + 3]).split()
        names = [name.split("_") for name in entry.rows[0].step_times]
        assert head[0] == "SP"
        assert all({number, name} <= set(head) for number, name in names)
        (line,) = (line for line in lines[start : start + 5] if line.startswith("S "))
        rates = [f"{rate.percent:.1f}" for rate in step_rates(entry)]
        assert line.split()[1:] == [f"{100 * entry.summary.rate:.1f}", *rates]
        assert any(each.startswith("A ") for each in lines[start : start + 6]) == (len(plays) > 1)
        assert any(each.startswith("paper ACT") for each in lines[start:]) == (policy == "act")
    note = " ".join(lines[blocks[-1] :])
    assert ("play=both" in note) == (len(plays) == 1)
    assert "points wide" in note


def test_a_run_with_a_policy_per_step_only_has_no_column_of_the_whole_task() -> None:
    lines = ran(written("level4/clean_beaker", "expert", 0.9, n=9, play="staged"))
    assert lines[2].startswith("clean_beaker: staged ")
    assert lines[3].split()[:2] == ["1", "pick"]
    assert lines[4].startswith("A ")


@pytest.mark.parametrize("width", [80, 100, 160])
def test_whatever_was_played_a_line_of_a_task_is_one_line(width: int) -> None:
    rows = [
        replace(row, liquid="off")
        for split, axes in (("id", ()), ("ood", ("all",)))
        for task in ("level2/pour_liquid", "level3/pick", "level3/heat_beaker")
        for row in written(
            task, "a_policy_with_a_long_name", 0.9, n=100, split=split, axes=axes, obs="state"
        )
    ]
    lines = ran(rows, width)
    assert max(map(len, lines)) <= width
    assert lines[0] == "a_policy_with_a_long_name, ID, state, liquid=off"
    assert "a_policy_with_a_long_name, all axes, state, liquid=off" in lines
    for entry in report_entries([result(*rows)]):
        rate = f"{entry.summary.successes}/100"
        (line,) = {line for line in lines if line.startswith(entry.task) and rate in line}
        assert "[" in line
        assert line.split("]")[1].split()[1] == "%"
    assert len(lines) <= 40
    assert sum(line.startswith("Success: the goal held") for line in lines) == 1


def test_a_task_without_liquid_counts_in_the_mean_of_a_level_played_without_it() -> None:
    filled = written("level4/clean_beaker", "expert", 1.0, n=4)
    emptied = [replace(row, liquid="off") for row in filled]
    dry = [
        replace(row, liquid=None, success=row.seed % 2 == 0)
        for row in written("level4/drying_beakers", "expert", 1.0, n=4)
    ]
    lines = ran([*emptied, *dry])
    assert [line for line in lines if line.startswith("expert")] == ["expert, ID, liquid=off"]
    assert "Mean of level 4: single 75.0 %." in " ".join(lines)


def test_every_failure_is_counted_once(results: list[LoadedResult]) -> None:
    found = report_entries(results)
    failed = sum(not row.success for entry in found for row in entry.rows)
    counted = [line[-1] for line in failure_table(found).lines]
    assert sum(rate.count for rate in counted if isinstance(rate, Rate)) == failed


def test_precision_is_reported_for_successes_and_for_all() -> None:
    act = written("level2/pour_liquid", "act", 0.7, n=40)
    expert = written("level2/pour_liquid", "expert", 1.0, n=40)
    table = precision_table(report_entries([result(*act, *expert)]))
    lines = {(line[1], line[3]): dict(zip(table.head, line, strict=True)) for line in table.lines}
    won, everything = lines["act", "successes"], lines["act", "all"]
    for name in ("ml off target", "mm off place", "deg off place", "s over the expert"):
        assert isinstance(won[name], Median)
        assert isinstance(everything[name], Median)
    assert isinstance(won["ml off target"], Median)
    assert won["ml off target"].n == sum(row.success for row in act)
    seconds = everything["s over the expert"]
    pace = {row.seed: row.seconds for row in expert}
    assert isinstance(seconds, Median)
    assert seconds == Median.of([row.seconds - pace[row.seed] for row in act])
    assert lines["expert", "all"]["s over the expert"] is None


def test_how_a_robot_drove_is_reported_where_one_drives() -> None:
    rows = written("level2/pour_liquid", "act", 0.7, n=40)
    standing = precision_table(report_entries([result(*rows)]))
    assert "SPL" not in standing.head
    assert "drives" not in standing.note
    driving = {"m_gap": 0.05, "m_off_dock": 0.012, "deg_off_dock": 0.4}
    driving |= {"m_driven": 6.0, "m_shortest": 5.0}
    drove = [
        replace(r, ml_spilled=0.5, driving={**driving, "spl": 0.9 if r.success else 0.0})
        for r in rows
    ]
    table = precision_table(report_entries([result(*drove)]))
    won, everything = (dict(zip(table.head, line, strict=True)) for line in table.lines)
    assert won["SPL"] == "0.900"
    assert everything["SPL"] == f"{0.9 * sum(row.success for row in rows) / 40:.3f}"
    ways = everything["shortest ways driven"]
    assert isinstance(ways, Median)
    assert ways.value == pytest.approx(1.2)
    assert isinstance(everything["ml spilled on the way"], Median)
    assert not {"shortest ways driven", "ml spilled on the way"} & {*standing.head}
    gap = everything["mm from things"]
    assert isinstance(gap, Median)
    assert (gap.value, gap.n) == (pytest.approx(50.0), 40)


def test_the_command_of_an_entry_plays_its_rows(tmp_path: Path) -> None:
    rows = written("level3/pick", "act", 0.9, n=7, split="ood", axes=["all"], seed=100_010)
    folder = keep(tmp_path / "out", rows, particles=200, videos=0, robot="default")
    (entry,) = report_entries(load_results(folder))
    assert command(entry) == (
        "python eval/run.py task=level3/pick policy=act split=ood 'axes=[all]' obs=pixels "
        "seed=100010 episodes=7 particles=200"
    )
    assert "seed=100012 episodes=1" in episode_command(entry, entry.rows[2])
