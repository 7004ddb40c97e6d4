"""A table as a value, and how it is written: text, Markdown, CSV, LaTeX."""

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby, takewhile
from typing import Any

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table as RichTable
from rich.text import Text

from labutopia_lerobot.evaluation.reporting.paper import Printed
from labutopia_lerobot.evaluation.uncertainty.median import Median
from labutopia_lerobot.evaluation.uncertainty.proportion import Interval

_ABREAST = 6
"""Columns up to which a rate stands in one line of a terminal."""

_STACKED = 8
"""Columns up to which its parts stand below each other; a wider table has lines for columns."""

_LOOK: dict[str, Any] = {
    "title_justify": "left",
    "title_style": "bold",
    "caption_justify": "left",
    "box": box.SIMPLE_HEAD,
    "padding": (0, 1, 0, 0),
}


@dataclass(frozen=True)
class Rate:
    """A share of episodes.

    Attributes:
        count: Episodes in which it was so.
        n: All of them.
        interval: Confidence interval of the share, 95 %.
    """

    count: int
    n: int
    interval: Interval

    @property
    def percent(self) -> float:
        """The share [%]."""
        return 100 * self.count / self.n


Cell = str | int | Rate | Printed | Median | None
"""What stands in a table; None where there is nothing."""


@dataclass(frozen=True)
class Table:
    """A table.

    Attributes:
        title: What it shows.
        head: Names of its columns.
        lines: A cell per column each.
        note: What a reader has to know.
    """

    title: str
    head: tuple[str, ...]
    lines: tuple[tuple[Cell, ...], ...]
    note: str

    @property
    def repeated(self) -> list[int]:
        """How many words at the beginning of each line are those of the line above."""
        pairs = zip(self.lines, ((), *self.lines[:-1]), strict=True)
        return [
            len(list(takewhile(lambda both: both[0] == both[1] and isinstance(both[0], str), both)))
            for both in (zip(line, above, strict=False) for line, above in pairs)
        ]

    def without_empty_columns(self) -> "Table":
        """Return the same table without columns in which nothing stands."""
        kept = [i for i in range(len(self.head)) if any(line[i] is not None for line in self.lines)]
        return Table(
            self.title,
            tuple(self.head[i] for i in kept),
            tuple(tuple(line[i] for i in kept) for line in self.lines),
            self.note,
        )


def text(cell: Cell) -> str:
    """Return a cell in one line."""
    match cell:
        case None:
            return "-"
        case Rate(count, n, (low, high)):
            return f"{count}/{n} {cell.percent:.1f} [{100 * low:.0f}, {100 * high:.0f}]"
        case Printed(percent, _):
            return f"{percent:.1f}"
        case Median(value, interval, _):
            bounds = "" if interval is None else f" [{interval[0]:.3g}, {interval[1]:.3g}]"
            return f"{value:.3g}{bounds}"
        case _:
            return str(cell)


def as_text(table: Table) -> RenderableType:
    """Return a table for the terminal, one too wide as several with a line per column."""
    if len(table.head) > _STACKED:
        return _turned(table)
    stacked = len(table.head) > _ABREAST
    shown = RichTable(title=table.title, caption=table.note, **_LOOK)
    for i, name in enumerate(table.head):
        is_words = all(isinstance(line[i], str | None) for line in table.lines)
        shown.add_column(name, justify="left" if is_words else "right", overflow="fold")
    for line, repeated in zip(table.lines, table.repeated, strict=True):
        cells = (
            text(cell).replace(" ", "\n", 2) if stacked and isinstance(cell, Rate) else text(cell)
            for cell in line[repeated:]
        )
        shown.add_row(*[""] * repeated, *cells)
    return shown


def _turned(table: Table) -> RenderableType:
    """Return a table per heading, its lines as columns; the last of their words names them."""
    words = sum(
        all(isinstance(cell, str) for cell in column) for column in zip(*table.lines, strict=True)
    )
    parts = []
    for heading, lines in groupby(table.lines, key=lambda line: line[: max(words - 1, 1)]):
        columns = list(lines)
        part = RichTable(title=", ".join(map(text, heading)), **_LOOK)
        part.add_column()
        for line in columns:
            part.add_column(text(line[words - 1]), justify="right", overflow="fold")
        for i in range(words, len(table.head)):
            cells = [line[i] for line in columns]
            if any(cell is not None for cell in cells):
                part.add_row(table.head[i], *map(text, cells))
        parts.append(part)
    return Group(Text(table.title, "bold"), *parts, Text(f"{table.note}\n", "dim italic"))


def as_markdown(table: Table) -> str:
    """Return a table in GitHub's Markdown."""
    return "\n".join(
        [
            f"### {table.title}",
            "",
            _piped(table.head),
            _piped("---" for _ in table.head),
            *(_piped(map(text, line)) for line in table.lines),
            "",
            table.note,
            "",
        ]
    )


def as_csv(table: Table) -> str:
    """Return a table as comma-separated values, every number in a column of its own."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    kinds = [
        next((type(line[i]) for line in table.lines if line[i] is not None), str)
        for i in range(len(table.head))
    ]
    columns = list(zip(table.head, kinds, strict=True))
    writer.writerow(
        [" ".join(filter(None, (name, part))) for name, kind in columns for part in _PARTS[kind]]
    )
    for line in table.lines:
        values: list[object] = []
        for cell, kind in zip(line, kinds, strict=True):
            values += [""] * len(_PARTS[kind]) if cell is None else _values(cell)
        writer.writerow(values)
    return out.getvalue()


def as_latex(table: Table) -> str:
    """Return a table for LaTeX with the package booktabs."""
    lines = [" & ".join(_latex(text(cell)) for cell in line) for line in table.lines]
    return "\n".join(
        [
            r"\begin{table}",
            r"\centering",
            rf"\caption{{{_latex(table.title)}. {_latex(table.note)}}}",
            rf"\begin{{tabular}}{{{'l' * len(table.head)}}}",
            r"\toprule",
            " & ".join(map(_latex, table.head)) + r" \\",
            r"\midrule",
            *(rf"{line} \\" for line in lines),
            r"\bottomrule",
            r"\end{tabular}",
            r"\end{table}",
            "",
        ]
    )


FORMATS: dict[str, Callable[[Table], RenderableType]] = {
    "text": as_text,
    "markdown": as_markdown,
    "csv": as_csv,
    "latex": as_latex,
}
"""How tables can be written."""

_PARTS: dict[type, tuple[str, ...]] = {
    str: ("",),
    int: ("",),
    Rate: ("count", "n", "%", "low %", "high %"),
    Printed: ("%", "inferred n"),
    Median: ("median", "low", "high", "n"),
}
"""Kind of cell -> what its columns of comma-separated values are called."""


def _values(cell: Cell) -> Sequence[object]:
    match cell:
        case Rate(count, n, (low, high)):
            return [count, n, *(f"{100 * share:.2f}" for share in (count / n, low, high))]
        case Printed(percent, n):
            return [percent, n]
        case Median(value, interval, n):
            low_high: Sequence[object] = ("", "") if interval is None else interval
            return [value, *low_high, n]
        case _:
            return [cell]


def _piped(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"


_LATEX = {"\\": r"\textbackslash{}", "π": r"$\pi$"} | {c: rf"\{c}" for c in "&%$#_{}"}


def _latex(words: str) -> str:
    return "".join(_LATEX.get(letter, letter) for letter in words)
