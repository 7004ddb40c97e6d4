"""Data of the charts of the page, in per cent and in pixels."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from labutopia_lerobot.evaluation.condition import SINGLE
from labutopia_lerobot.evaluation.reporting.paper import paper_number
from labutopia_lerobot.evaluation.reporting.report_entry import ReportEntry, shifts
from labutopia_lerobot.evaluation.reporting.result_tables import cause_in_words, failures, success
from labutopia_lerobot.evaluation.reporting.table import Rate

_COLOURS = 8
_LEFT, _RIGHT, _TOP, _BOTTOM = 40, 190, 10, 190
"""Ends of the lines of a slope chart [pixels]."""

_LABEL_GAP = 13
_SEEDS = 4
"""Failed seeds of a cause that are named; the rows have all."""


def funnel(entry: ReportEntry) -> dict[str, Any]:
    """Return how many episodes came to each substep."""
    summary = entry.summary
    return {
        **_named(entry),
        "substeps": [(name, 100 * rate) for name, rate in summary.substep_rates.items()],
        "percent": 100 * summary.rate,
    }


def failure_shares(entry: ReportEntry, causes: Sequence[str]) -> dict[str, Any]:
    """Return the shares of causes among the failures: in each step side by side, and in all.

    Args:
        entry: The evaluation of one condition.
        causes: Every cause of the page; its place in there is its colour.
    """
    counts = failures(entry)
    total = counts.total()
    steps: dict[str, list[dict[str, Any]]] = {}
    for (step, cause), count in counts.most_common():
        segments = steps.setdefault(step, [])
        start = sum(segment["percent"] for segment in segments)
        percent = 100 * count / total
        segments.append({"start": start, "percent": percent, "colour": _colour(cause, causes)})
    by_cause: dict[str, list[int]] = {}
    for row in entry.rows:
        if not row.success:
            by_cause.setdefault(cause_in_words(row), []).append(row.seed)
    return {
        **_named(entry),
        "failed": total,
        "steps": [
            (step, segments, sum(segment["percent"] for segment in segments))
            for step, segments in steps.items()
        ],
        "causes": [
            {
                "cause": cause,
                "colour": _colour(cause, causes),
                "percent": 100 * len(seeds) / total,
                "seeds": ", ".join(map(str, seeds[:_SEEDS])) + ", ..." * (len(seeds) > _SEEDS),
            }
            for cause, seeds in sorted(by_cause.items(), key=lambda item: -len(item[1]))
        ],
    }


def _colour(cause: str, causes: Sequence[str]) -> int:
    return causes.index(cause) % _COLOURS


def slopes(entries: Sequence[ReportEntry]) -> list[dict[str, Any]]:
    """Return a chart per policy that was played under several conditions: a line per task."""
    usual = (e for e in entries if e.condition.play == SINGLE and e.condition.step is None)
    ordered = sorted(usual, key=lambda entry: entry.label)
    charts = []
    for label, group in groupby(ordered, key=lambda entry: entry.label):
        of_policy = list(group)
        times = Counter(entry.task for entry in of_policy)
        shifted = [entry for entry in of_policy if times[entry.task] > 1]
        if len(shifts(shifted)) > 1:
            charts.append(_slope(label, shifted, shifts(shifted)))
    return charts


def _slope(label: str, entries: Sequence[ReportEntry], shown: Sequence[str]) -> dict[str, Any]:
    x = {
        name: _LEFT + index * (_RIGHT - _LEFT) / (len(shown) - 1)
        for index, name in enumerate(shown)
    }
    lines: list[dict[str, Any]] = []
    for index, task in enumerate(dict.fromkeys(entry.task for entry in entries)):
        of_task = [entry for entry in entries if entry.task == task]
        rates = {entry.condition.shift: success(entry).percent for entry in of_task}
        theirs = {c: paper_number(task, of_task[0].policy, c) for c in shown}
        paper = {c: number.percent for c, number in theirs.items() if number is not None}
        dots = [(round(x[c], 1), _y(rates[c])) for c in shown if c in rates]
        lines.append(
            {
                "task": task.partition("/")[2],
                "last": f"{rates[[c for c in shown if c in rates][-1]]:.0f}",
                "colour": index % _COLOURS,
                "dots": dots,
                "points": _points(dots),
                "theirs": _points([(round(x[c], 1), _y(paper[c])) for c in shown if c in paper]),
            }
        )
    return _drawn(label, x, lines)


def curve(
    title: str, places: Sequence[int], rates: Mapping[str, Mapping[int, Rate]]
) -> dict[str, Any]:
    """Return a chart of success over a number, such as of demonstrations.

    Args:
        title: What it shows.
        places: Every value of the number, in increasing order; they stand equally far apart.
        rates: Name of a line -> value of the number -> rate of success; of each line at least one.
    """
    apart = (_RIGHT - _LEFT) / max(len(places) - 1, 1)
    x = {str(place): _LEFT + index * apart for index, place in enumerate(places)}
    lines: list[dict[str, Any]] = []
    for index, (name, points) in enumerate(rates.items()):
        measured = [place for place in places if place in points]
        dots = [(round(x[str(p)], 1), _y(points[p].percent)) for p in measured]
        lines.append(
            {
                "task": name,
                "last": f"{points[measured[-1]].percent:.0f}",
                "colour": index % _COLOURS,
                "dots": dots,
                "points": _points(dots),
                "theirs": "",
            }
        )
    return _drawn(title, x, lines)


def _drawn(title: str, x: Mapping[str, float], lines: list[dict[str, Any]]) -> dict[str, Any]:
    """Return a chart of lines; their labels stand at their ends, none on another."""
    lines.sort(key=lambda line: line["dots"][-1][1])
    height = max(_BOTTOM + 24, _TOP + _LABEL_GAP * len(lines) + 30)
    for line, y in zip(lines, _spread([line["dots"][-1][1] for line in lines]), strict=True):
        line["label_y"] = y
    return {
        "policy": title,
        "height": height,
        "right": _RIGHT,
        "marks": [{"percent": p, "y": _y(p)} for p in (0, 25, 50, 75, 100)],
        "columns": [{"name": name, "x": round(position, 1)} for name, position in x.items()],
        "lines": lines,
    }


def _y(percent: float) -> float:
    return round(_BOTTOM - (_BOTTOM - _TOP) * percent / 100, 1)


def _points(dots: Sequence[tuple[float, float]]) -> str:
    return " ".join(f"{x},{y}" for x, y in dots)


def _spread(positions: Sequence[float]) -> list[float]:
    """Return where labels go, in the same order, none on another and all above the bottom."""
    placed: list[float] = []
    for position in positions:
        placed.append(max(position, placed[-1] + _LABEL_GAP if placed else position))
    limit = max(_BOTTOM, _TOP + _LABEL_GAP * len(placed)) + _LABEL_GAP
    for index in reversed(range(len(placed))):
        limit -= _LABEL_GAP
        placed[index] = min(placed[index], limit)
    return placed


def _named(entry: ReportEntry) -> dict[str, Any]:
    return {
        "task": entry.task,
        "heading": f"{entry.label}, {entry.condition.played}",
        "n": len(entry.rows),
    }
