"""Tables laid out as the paper's, from rows only."""

import csv
import io
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from labutopia_lerobot.evaluation.found import FoundResult, find_results
from labutopia_lerobot.evaluation.reporting.commands import command, episode_command
from labutopia_lerobot.evaluation.reporting.entry import entries
from labutopia_lerobot.evaluation.reporting.levels import (
    conditional_rates,
    level_tables,
    step_rates,
)
from labutopia_lerobot.evaluation.reporting.outcomes import failure_table, precision_table
from labutopia_lerobot.evaluation.reporting.paper import Printed, paper_results, printed
from labutopia_lerobot.evaluation.reporting.table import (
    FORMATS,
    Rate,
    Table,
    as_csv,
    as_latex,
    as_markdown,
    text,
)
from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.statistics import summarise
from labutopia_lerobot.evaluation.table import summary_table
from labutopia_lerobot.evaluation.uncertainty.median import Median
from labutopia_lerobot.evaluation.uncertainty.proportion import wilson

from .written_rows import every_level, keep, written

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> list[FoundResult]:
    folders = every_level(tmp_path_factory.mktemp("levels"))
    return [result for folder in folders for result in find_results(folder)]


def result(*rows: Row) -> FoundResult:
    return FoundResult(Path("out"), finished=True, rows=rows, provenance={})


def test_each_level_has_its_table_with_the_papers_columns(results: list[FoundResult]) -> None:
    tables = {table.title: table for table in level_tables(entries(results))}
    assert list(tables) == ["Level 1 and level 2", "Level 3", "Size test", "Level 4"]
    assert tables["Level 3"].head[2:] == ("ID", "OOD", "all axes", "paper ID", "paper OOD")
    assert tables["Size test"].head == tables["Level 3"].head
    assert tables["Level 4"].head == ("Task", "Policy", "Played", "SP", *"1234567")
    assert tables["Level 1 and level 2"].head == (
        *("Task", "act", "diffusion", "expert", "paper ACT", "paper DP"),
    )


def test_columns_come_from_the_rows() -> None:
    alone = result(*written("level3/pick", "act", 0.9, split="ood", axes=["light"], n=5))
    (table,) = level_tables(entries([alone]))
    assert table.head == ("Task", "Policy", "OOD light", "paper ID", "paper OOD")


def test_a_line_of_level_4_counts_steps_and_what_came_of_the_one_before() -> None:
    (entry,) = entries([result(*written("level4/clean_beaker", "act", 0.8, play="staged"))])
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
        Printed(percent, 300) for percent in (99.3, 51.9, 43.3, 42.5, 12.3, 10.6, 1.6)
    )
    assert conditional[2] == "A given the one before"


def test_the_papers_numbers_stand_beside_ours() -> None:
    assert printed("level1/stir", "act") == Printed(86.7, 120)
    assert printed("level3/press", "pi0", "OOD") == Printed(89.1, 120)
    assert printed("level3/pick_sizes", "diffusion") == Printed(11.2, 125)
    assert printed("level4/liquid_fusion", "diffusion") == Printed(6.7, 300)
    assert printed("level1/squeeze", "act") is None
    assert len(paper_results()) == 32 + 36 + 8 + 48


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


def test_two_checkpoints_of_one_kind_are_told_apart(tmp_path: Path) -> None:
    folders = [
        keep(tmp_path / name, written("level1/pick", "act", 0.9, n=6, luck=luck))
        for luck, name in enumerate(("early", "late"))
    ]
    found = entries([found for folder in folders for found in find_results(folder)])
    assert [entry.policy for entry in found] == ["act (early)", "act (late)"]


def test_what_is_unusual_about_a_policy_is_told() -> None:
    rows = written("level1/pick", "act", 0.9, n=3, obs="state")
    assert [entry.policy for entry in entries([result(*rows)])] == ["act, state"]


def test_who_saw_filaments_pictures_is_never_in_one_line_with_who_saw_others() -> None:
    classic = written("level1/pick", "act", 0.9, n=3)
    filament = [replace(row, seed=row.seed + 9, renderer="Filament on llvmpipe") for row in classic]
    told = {entry.policy: len(entry.rows) for entry in entries([result(*classic, *filament)])}
    assert told == {"act": 3, "act, renderer=filament": 3}


TABLE = Table(
    "A & B",
    ("Task", "act", "paper_ACT", "mm off place"),
    (
        ("level1/pick", Rate(8, 10, wilson(8, 10)), Printed(75.0, 120), Median(1.5, (1.0, 2.0), 8)),
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


def test_a_table_in_markdown_has_a_line_per_line() -> None:
    lines = as_markdown(TABLE).splitlines()
    assert "| level1/pick | 8/10 80.0 [49, 94] | 75.0 | 1.5 [1, 2] |" in lines
    assert "| level1/pour | - | - | 2 |" in lines


def test_a_table_in_latex_is_escaped() -> None:
    told = as_latex(TABLE)
    assert r"\caption{A \& B. 100 \% of it}" in told
    assert r"paper\_ACT" in told
    assert told.count(r"\\") == 3


def test_every_table_can_be_written_in_every_format(results: list[FoundResult]) -> None:
    found = entries(results)
    for table in (*level_tables(found), failure_table(found), precision_table(found)):
        assert all(FORMATS[name](table) for name in FORMATS)


def test_in_a_terminal_of_80_columns_nothing_is_cut_off(results: list[FoundResult]) -> None:
    lines = io.StringIO()
    console = Console(file=lines, width=80)
    for table in level_tables(entries(results)):
        console.print(FORMATS["text"](table))
    shown = lines.getvalue()
    assert "…" not in shown
    assert "level4/clean_beaker, act" in shown
    entry = next(e for e in entries(results) if e.level == 4)
    for rate in step_rates(entry):
        assert all(word in shown for word in text(rate).split())


def test_a_task_without_liquid_counts_in_the_mean_of_a_level_played_without_it() -> None:
    filled = written("level4/clean_beaker", "expert", 1.0, n=4)
    filled = written("level4/clean_beaker", "expert", 1.0, n=4)
    emptied = [replace(row, liquid="off") for row in filled]
    dry = replace(filled[0], task="level4/drying_beakers", liquid=None)
    rows = [*emptied, dry, replace(dry, seed=1, success=False)]
    lines = io.StringIO()
    Console(file=lines, width=100).print(summary_table(summarise(rows), level_means=True))
    means = [line.split() for line in lines.getvalue().splitlines() if "level4, mean" in line]
    assert [line[:6] for line in means] == [["expert,", "liquid=off", "level4,", "mean", "75", "%"]]


def test_every_failure_is_counted_once(results: list[FoundResult]) -> None:
    found = entries(results)
    failed = sum(not row.success for entry in found for row in entry.rows)
    counted = [line[-1] for line in failure_table(found).lines]
    assert sum(rate.count for rate in counted if isinstance(rate, Rate)) == failed


def test_precision_is_told_for_successes_and_for_all() -> None:
    act = written("level2/pour_liquid", "act", 0.7, n=40)
    expert = written("level2/pour_liquid", "expert", 1.0, n=40)
    table = precision_table(entries([result(*act, *expert)]))
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


def test_the_command_of_an_entry_plays_its_rows(tmp_path: Path) -> None:
    rows = written("level3/pick", "act", 0.9, n=7, split="ood", axes=["all"], seed=100_010)
    folder = keep(tmp_path / "out", rows, particles=200, videos=0, robot="panda")
    (entry,) = entries(find_results(folder))
    assert command(entry) == (
        "python eval/run.py task=level3/pick policy=act split=ood 'axes=[all]' obs=pixels "
        "seed=100010 episodes=7 particles=200"
    )
    assert "seed=100012 episodes=1" in episode_command(entry, entry.rows[2])
