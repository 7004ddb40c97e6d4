"""A table as a value, and how it is written: as text for a terminal, Markdown, CSV, LaTeX."""

import csv
import io
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from textwrap import wrap

from rich.console import Console, ConsoleOptions, RenderableType, RenderResult
from rich.text import Text

from labutopia_lerobot.evaluation.reporting.paper import PaperNumber
from labutopia_lerobot.evaluation.uncertainty.intervals import Interval, Median


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


Cell = str | int | Rate | PaperNumber | Median | None
"""Content of a table's cell; None where there is nothing."""


@dataclass(frozen=True)
class Table:
    """A table.

    Attributes:
        title: What it shows.
        head: Names of its columns.
        lines: A cell per column each.
        note: What a reader has to know.
        brief: Whether text shows of its rates the per cent only; every other format shows all.
    """

    title: str
    head: tuple[str, ...]
    lines: tuple[tuple[Cell, ...], ...]
    note: str = ""
    brief: bool = False

    @property
    def repeated(self) -> list[int]:
        """Number of words at the beginning of each line that equal those of the line above."""
        pairs = zip(self.lines, ((), *self.lines[:-1]), strict=True)
        return [
            len(list(takewhile(lambda both: both[0] == both[1] and isinstance(both[0], str), both)))
            for both in (zip(line, above, strict=False) for line, above in pairs)
        ]

    def without_empty_columns(self) -> "Table":
        """Return the same table without columns in which nothing stands."""
        kept = [i for i in range(len(self.head)) if any(line[i] is not None for line in self.lines)]
        return replace(
            self,
            head=tuple(self.head[i] for i in kept),
            lines=tuple(tuple(line[i] for i in kept) for line in self.lines),
        )


def text(cell: Cell) -> str:
    """Return a cell in one line."""
    match cell:
        case None:
            return "-"
        case Rate(count, n, (low, high)):
            return f"{count}/{n} {cell.percent:.1f} [{100 * low:.0f}, {100 * high:.0f}]"
        case PaperNumber(percent, _):
            return f"{percent:.1f}"
        case Median(value, interval, _):
            bounds = "" if interval is None else f" [{interval[0]:.3g}, {interval[1]:.3g}]"
            return f"{value:.3g}{bounds}"
        case _:
            return str(cell)


_GAP = "  "
"""Between columns of a text table."""

_INDENT = "    "
"""Before what stands below a line."""

_LONG = 20
"""Characters from which on a last column of words may stand below its lines."""

_READABLE = 12
"""Characters of a column of words, if they need as many; fewer would be a word a line."""

_UNBREAKABLE = "\u00a0"


@dataclass(frozen=True)
class TextTable:
    """A table in a terminal or a log file, laid out for its width.

    One that is too wide has its last column of words below each line; or else its cells in several
    lines; or else its columns in bands below each other, each with the words that head the lines.

    Attributes:
        table: The table to show.
    """

    table: Table

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield its lines."""
        width = options.max_width
        for line in self.table.title.split("\n"):
            yield Text("\n".join(_wrapped(line, width)), "bold")
        for line in _laid_out(self.table, width):
            yield Text(line, no_wrap=True, overflow="ignore")
        if self.table.note:
            yield Text()
            yield Text("\n".join(_wrapped(self.table.note, width)), "italic")


@dataclass(frozen=True)
class _Column:
    """A column of a text table.

    Attributes:
        head: Its name.
        cells: A text per line, in which only what may be wrapped has blanks.
        words: Whether it holds words only, and no numbers.
    """

    head: str
    cells: tuple[str, ...]
    words: bool

    @property
    def widest(self) -> int:
        return max(map(len, (self.head, *self.cells)))

    @property
    def narrowest(self) -> int:
        words = (word for part in (self.head, *self.cells) for word in part.split(" "))
        return max(min(_READABLE, self.widest) * self.words, *map(len, words))

    def lines(self, cell: str, width: int) -> list[str]:
        """Return a cell, or the head, in lines of this width."""
        return [
            line.ljust(width) if self.words else line.rjust(width)
            for line in _wrapped(cell, width) or [""]
        ]


def _laid_out(table: Table, width: int) -> list[str]:
    columns = [
        _Column(
            table.head[i],
            tuple(
                "" if i < repeated else _shown(line[i], table.brief)
                for line, repeated in zip(table.lines, table.repeated, strict=True)
            ),
            all(isinstance(line[i], str | None) for line in table.lines)
            and not all(_is_number(line[i]) for line in table.lines),
        )
        for i in range(len(table.head))
    ]
    *others, last = columns
    if _width(column.widest for column in columns) <= width:
        return _band(columns, width, ruled=not table.brief)
    long = last.words and last.widest > _LONG
    if long and _width(column.widest for column in others) <= width:
        return _band(others, width, ruled=not table.brief, below=last.cells)
    lines: list[str] = []
    for band in _bands(columns, width):
        lines += [*[""] * bool(lines), *_band(band, width, ruled=not table.brief)]
    return lines


def _bands(columns: Sequence[_Column], width: int) -> Iterator[list[_Column]]:
    """Yield columns that fit side by side; each band begins with the words that head the lines."""
    heading = list(takewhile(lambda column: column.words, columns))
    band = list(heading)
    for column in columns[len(heading) :]:
        narrowest = _width(each.narrowest for each in (*band, column))
        if narrowest > width and len(band) > len(heading):
            yield band
            band = list(heading)
        band.append(column)
    yield band


def _band(
    columns: Sequence[_Column], width: int, *, ruled: bool, below: Sequence[str] = ()
) -> list[str]:
    """Return the lines of columns side by side, each as wide as there is room for.

    Args:
        columns: Columns to show.
        width: Characters of a line.
        ruled: Whether there is a rule below the head.
        below: What stands below each line, if anything does.
    """
    widths = [column.widest for column in columns]
    if _width(widths) > width:
        widths = [column.narrowest for column in columns]
        for i, column in enumerate(columns):
            spare = width - _width(widths)
            widths[i] += max(0, min(spare, column.widest - widths[i])) * column.words
    shown = [_side_by_side(columns, [column.head for column in columns], widths)]
    shown += [["─" * _width(widths)]] if ruled else []
    for line, cells in enumerate(zip(*(column.cells for column in columns), strict=True)):
        shown.append(_side_by_side(columns, cells, widths))
        if below:
            shown.append([_INDENT + part for part in _wrapped(below[line], width - len(_INDENT))])
    return [line.rstrip().replace(_UNBREAKABLE, " ") for lines in shown for line in lines]


def _side_by_side(
    columns: Sequence[_Column], cells: Sequence[str], widths: Sequence[int]
) -> list[str]:
    parts = [
        column.lines(cell, width)
        for column, cell, width in zip(columns, cells, widths, strict=True)
    ]
    blank = (" " * width for width in widths)
    filled = [
        [*part, *[empty] * (max(map(len, parts)) - len(part))]
        for part, empty in zip(parts, blank, strict=True)
    ]
    return [_GAP.join(line) for line in zip(*filled, strict=True)]


def _width(widths: Iterable[int]) -> int:
    each = list(widths)
    return sum(each) + len(_GAP) * (len(each) - 1)


def _wrapped(words: str, width: int) -> list[str]:
    return wrap(words, width, break_long_words=False, break_on_hyphens=False)


def _is_number(cell: Cell) -> bool:
    """Return whether words begin with a number, as `12.5 s` or `< 0.0001`, or are none."""
    return not cell or re.match(r"[-+<>]? ?\d", str(cell)) is not None


def _shown(cell: Cell, brief: bool) -> str:
    """Return a cell in one line; intervals have no blank at which they could be wrapped."""
    if brief and cell is None:
        return ""
    if brief and isinstance(cell, Rate):
        return f"{cell.percent:.1f}"
    return re.sub(r"\[.*?\]", lambda match: match[0].replace(" ", _UNBREAKABLE), text(cell))


def as_markdown(table: Table) -> str:
    """Return a table in GitHub's Markdown."""
    return "\n".join(
        [
            f"## {table.title}",
            "",
            _piped(table.head),
            _piped("---" for _ in table.head),
            *(_piped(map(text, line)) for line in table.lines),
            "",
            *((table.note, "") if table.note else ()),
        ]
    )


def as_csv(table: Table) -> str:
    """Return a table as comma-separated values, every number in a column of its own."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    kinds = [
        max(
            (type(line[i]) for line in table.lines if line[i] is not None), key=_widest, default=str
        )
        for i in range(len(table.head))
    ]
    columns = list(zip(table.head, kinds, strict=True))
    writer.writerow(
        [" ".join(filter(None, (name, part))) for name, kind in columns for part in _PARTS[kind]]
    )
    for line in table.lines:
        values: list[object] = []
        for cell, kind in zip(line, kinds, strict=True):
            values += _in_columns(cell, _PARTS[kind])
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
    "text": TextTable,
    "markdown": as_markdown,
    "csv": as_csv,
    "latex": as_latex,
}
"""Formats in which tables can be written."""

_PARTS: dict[type, tuple[str, ...]] = {
    str: ("",),
    int: ("",),
    Rate: ("count", "n", "%", "low %", "high %"),
    PaperNumber: ("%", "inferred n"),
    Median: ("median", "low", "high", "n"),
}
"""Kind of cell -> what its columns of comma-separated values are called."""


def _widest(kind: type) -> int:
    return len(_PARTS[kind])


def _in_columns(cell: Cell, parts: Sequence[str]) -> list[object]:
    """Return the values of a cell below the heads of its column, which another kind may have."""
    if cell is None:
        return [""] * len(parts)
    own, values = _PARTS[type(cell)], _values(cell)
    if own == ("",):  # words
        return [*values, *[""] * (len(parts) - 1)]
    given = dict(zip(own, values, strict=True))
    return [given.get(part, given.get(f"inferred {part}", "")) for part in parts]


def _values(cell: Cell) -> Sequence[object]:
    match cell:
        case Rate(count, n, (low, high)):
            return [count, n, *(f"{100 * share:.2f}" for share in (count / n, low, high))]
        case PaperNumber(percent, n):
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
