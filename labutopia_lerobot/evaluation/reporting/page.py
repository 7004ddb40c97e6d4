"""One self-contained HTML file of results: it needs no network, and no scripts."""

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from labutopia_lerobot.evaluation.found import FoundResult
from labutopia_lerobot.evaluation.reporting.charts import failure_shares, funnel, slopes
from labutopia_lerobot.evaluation.reporting.clips import clips
from labutopia_lerobot.evaluation.reporting.commands import command
from labutopia_lerobot.evaluation.reporting.entry import entries
from labutopia_lerobot.evaluation.reporting.levels import level_tables
from labutopia_lerobot.evaluation.reporting.outcomes import failures, precision_table
from labutopia_lerobot.task import HOLD_S

_TEMPLATES = Path(__file__).with_name("templates")


def write_page(file: Path, results: Sequence[FoundResult]) -> None:
    """Write the page of results; the same results give the same bytes."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(page(results))


def page(results: Sequence[FoundResult]) -> str:
    """Return the page of results as HTML."""
    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = environment.get_template("style.css").render()
    template = environment.get_template("page.html.j2")
    return template.render(_content(results), style=environment.filters["safe"](style))


def _content(results: Sequence[FoundResult]) -> dict[str, Any]:
    found = entries(results)
    tables = [(f"table{index}", table) for index, table in enumerate(level_tables(found))]
    films = list(clips(found))
    precision = precision_table(found)
    shifted = slopes(found)
    with_failures = [entry for entry in found if failures(entry)]
    causes = Counter(cause for entry in with_failures for _, cause in failures(entry).elements())
    common = [cause for cause, _ in causes.most_common()]
    failed = [failure_shares(entry, common) for entry in with_failures]
    sections = [
        *((id_, table.title) for id_, table in tables),
        *([("shift", "Under shift")] if shifted else []),
        ("substeps", "Sub-steps"),
        *([("failures", "Failures")] if failed else []),
        *([("films", "Films")] if films else []),
        *([("precision", precision.title)] if precision.lines else []),
        ("again", "Commands"),
        ("origin", "Origin"),
    ]
    names = list(dict.fromkeys(entry.policy for entry in found))
    tasks = list(dict.fromkeys(entry.task for entry in found))
    return {
        "title": f"{_joined(names, 'policies')} on {_joined(tasks, 'tasks')}",
        "hold": f"{HOLD_S:g}",
        "figures": [
            (sum(len(entry.rows) for entry in found), "episodes"),
            (len(tasks), "tasks" if len(tasks) > 1 else "task"),
            (len(names), "policies" if len(names) > 1 else "policy"),
            (sum(entry.summary.successes for entry in found), "successes"),
        ],
        "warnings": [
            f"Unfinished: {result.place}, {len(result.rows)} episodes so far"
            for result in results
            if not result.finished
        ],
        "sections": sections,
        "tables": tables,
        "slopes": shifted,
        "funnels": [funnel(entry) for entry in found],
        "failures": failed,
        "films": films,
        "precision": precision,
        "commands": [
            {
                "task": entry.task,
                "heading": f"{entry.policy}, {entry.played}",
                "command": command(entry),
            }
            for entry in found
        ],
        "origins": [_origin(result) for result in results],
    }


def _joined(names: Sequence[str], kind: str) -> str:
    """Return names as in a sentence, or how many there are."""
    if len(names) > 3:
        return f"{len(names)} {kind}"
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def _origin(result: FoundResult) -> dict[str, Any]:
    return {"place": str(result.place), "told": list(_told(result.provenance.items()))}


def _told(provenance: Any) -> Iterator[tuple[str, str]]:
    """Yield what is told of where rows come from, in words."""
    for name, value in provenance:
        if name == "versions":
            value = ", ".join(f"{package} {v}" for package, v in value.items() if v is not None)
        elif isinstance(value, dict):
            value = json.dumps(value, separators=(", ", ": "))
        if value not in (None, "", "{}"):
            yield name.replace("_", " "), str(value)
