"""The leaderboard: the expert's kept rows, baselines and submissions, a table per condition."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import fmean

from jinja2 import StrictUndefined, Template

from labutopia_lerobot.evaluation.condition import ID
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting.report_entry import ReportEntry, report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import success
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table, as_markdown, text
from labutopia_lerobot.evaluation.result_folder import SCHEMA
from labutopia_lerobot.evaluation.submission import (
    FEWEST_EPISODES,
    FIRST_SEED,
    read,
    require_published,
)
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson
from labutopia_lerobot.registry import is_beyond_paper, task_files

_TEMPLATE = Path(__file__).parent / "templates" / "leaderboard.md.j2"

SUBMISSIONS = "submissions"
"""Folder of submissions, below that of the expert's rows."""

REFERENCE = "scripted expert"
"""Policy name of the kept rows. It is no entry: the expert looks at the simulation itself."""


BASELINE = "baseline"
"""Name of the entries that this repository trained itself."""


def _widest_ranked() -> float:
    """Return the widest interval of the fewest episodes: who stops early must know as much."""
    low, high = wilson(FEWEST_EPISODES // 2, FEWEST_EPISODES)
    return high - low


@dataclass
class _Line:
    """A line of a section.

    Attributes:
        name: What the entry is called.
        entries: Column -> what it played there.
    """

    name: str
    entries: dict[str, ReportEntry] = field(default_factory=dict)

    @property
    def mean(self) -> float:
        """Mean of the rates, with the same weight for each column."""
        return fmean(entry.summary.rate for entry in self.entries.values())

    def has_all(self, columns: Sequence[str]) -> bool:
        """Return whether no column is missing: a mean over other tasks would not compare."""
        return self.entries.keys() == set(columns)

    def is_ranked(self, columns: Sequence[str]) -> bool:
        """Return whether it may stand before others, or behind them."""
        intervals = (entry.summary.interval for entry in self.entries.values())
        known = all(high - low <= _widest_ranked() for low, high in intervals)
        return self.name != REFERENCE and self.has_all(columns) and known


def leaderboard_page(results: Path, baselines: Sequence[LoadedResult] = ()) -> str:
    """Return the page of a folder of kept rows and submissions, in Markdown.

    Args:
        results: The expert's rows, a file per task, and `SUBMISSIONS`.
        baselines: Results of policies that were trained here.

    Raises:
        SubmissionError: If any of them was not played as published.
        UnreadableResultError: If any cannot be read.
    """
    template = Template(
        _TEMPLATE.read_text(), undefined=StrictUndefined, keep_trailing_newline=True
    )
    page: str = template.render(
        widest=round(100 * _widest_ranked()),
        first_seed=FIRST_SEED,
        fewest=FEWEST_EPISODES,
        schema=SCHEMA,
        tables=[as_markdown(table).rstrip() for table in leaderboard_tables(results, baselines)],
    )
    return page


def leaderboard_tables(results: Path, baselines: Sequence[LoadedResult] = ()) -> list[Table]:
    """Return a table per level, shift, way of playing, and for steps that were played alone.

    Args:
        results: The expert's rows, a file per task, and `SUBMISSIONS`.
        baselines: Results of policies that were trained here.

    Raises:
        SubmissionError: If anything was not played as published.
        UnreadableResultError: If anything cannot be read.
    """
    kept = load_results(results)
    for result in (*kept, *baselines):
        require_published(result)
    named = [(REFERENCE, entry) for entry in report_entries(kept)]
    named += [(_name(BASELINE, entry), entry) for entry in report_entries(baselines)]
    for file in sorted((results / SUBMISSIONS).glob("*.json")):
        named += [(_name(file.stem, entry), entry) for entry in report_entries([read(file).result])]
    sections: dict[tuple[object, ...], list[tuple[str, ReportEntry]]] = {}
    for name, entry in named:
        sections.setdefault(_section(entry), []).append((name, entry))
    return [_table(sections[section]) for section in sorted(sections, key=str)]


def _name(name: str, entry: ReportEntry) -> str:
    state = ", state" if entry.condition.obs == "state" else ""
    return f"{name} ({entry.policy}{state})"


def _section(entry: ReportEntry) -> tuple[object, ...]:
    """Return what numbers that stand side by side have in common, in the order of the page."""
    played = entry.condition
    alone = played.step is not None
    shift = (played.shift != ID, played.shift)
    return entry.level, is_beyond_paper(entry.task), alone, *shift, played.play


def _table(named: Iterable[tuple[str, ReportEntry]]) -> Table:
    lines: dict[str, _Line] = {}
    for name, entry in named:
        lines.setdefault(name, _Line(name)).entries[_column(entry)] = entry
    first = next(entry for line in lines.values() for entry in line.entries.values())
    columns = _columns(first, lines.values())
    ranked = [line for line in lines.values() if line.is_ranked(columns)]
    in_order = sorted(
        lines.values(),
        key=lambda line: (line.name != REFERENCE, line not in ranked, -line.mean, line.name),
    )
    shown: list[tuple[Cell, ...]] = []
    for line in in_order:
        better = sum(other.mean > line.mean for other in ranked)
        shown.append(
            (
                str(better + 1) if line in ranked else "",
                line.name,
                f"{100 * line.mean:.1f} %" if line.has_all(columns) else None,
                *(_cell(line.entries.get(column)) for column in columns),
                ", ".join(sorted({_commit(entry) for entry in line.entries.values()})),
            )
        )
    return Table(_title(first), ("rank", "entry", "mean", *columns, "code"), tuple(shown), "")


def _columns(first: ReportEntry, lines: Iterable[_Line]) -> list[str]:
    """Return the tasks of a level, played or not; of steps played alone those that were."""
    if first.condition.step is not None:
        return sorted({column for line in lines for column in line.entries})
    level, beyond = first.task.partition("/")[0], is_beyond_paper(first.task)
    tasks = [task for task in task_files() if is_beyond_paper(task) == beyond]
    return [name for of, _, name in (task.partition("/") for task in tasks) if of == level]


def _column(entry: ReportEntry) -> str:
    return " ".join(filter(None, (entry.task.partition("/")[2], entry.condition.step)))


def _cell(entry: ReportEntry | None) -> Rate | str | None:
    if entry is None:
        return None
    rate = success(entry)
    return f"{text(rate)} until" if entry.sequential else rate


def _title(entry: ReportEntry) -> str:
    beyond = ", beyond the paper" if is_beyond_paper(entry.task) else ""
    alone = ", single steps" if entry.condition.step is not None else ""
    return f"Level {entry.level}{beyond}, {replace(entry.condition, step=None).played}{alone}"


def _commit(entry: ReportEntry) -> str:
    return str(entry.result.provenance.get("commit") or "unknown")[:7]
