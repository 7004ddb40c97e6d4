"""`python scripts/make_leaderboard.py`: `docs/leaderboard.md`, from the rows in `eval/results`.

The expert's rows lie there, a file per task (`scripts/expert_rows.py`); submissions, which
`eval/submit.py` packs, below in `submissions/`.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from statistics import fmean
from typing import Any

from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.row import Row, UnreadableResultError, from_columns
from labutopia_lerobot.evaluation.statistics import Summary, summarise
from labutopia_lerobot.registry import is_beyond_paper

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "eval" / "results"
PAGE = ROOT / "docs" / "leaderboard.md"

_EXPERT = "scripted expert"
_HEAD = """# Leaderboard

Successes of all episodes of a task, with the 95 % interval of Wilson, from the rows in
[eval/results](../eval/results); made by `scripts/make_leaderboard.py`. A mean counts every task the
same. Policies marked "state" are told the poses of all things.

To enter: evaluate, then

```
python eval/submit.py DIR                                  # DIR/submission.json
python eval/check_submission.py DIR/submission.json
```

and send the file as `eval/results/submissions/NAME.json`. Before it is taken, a drawn sample of its
episodes is played again from their actions, on the same build, and must come out the same to the
bit.
"""


@dataclass(frozen=True)
class Line:
    """What one entry won at one task.

    Attributes:
        entry: What it is called.
        code: The commit that it was played with.
        summary: What it won.
    """

    entry: str
    code: str
    summary: Summary


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(RESULTS))


def page(results: Path) -> str:
    """Return the page of a folder of results."""
    lines = sorted(_lines(results), key=_section)
    parts = [_HEAD]
    for (level, split), group in groupby(lines, key=_section):
        parts.append(f"## {level.capitalize()}, split {split}\n\n{_table(list(group))}")
    return "\n".join(parts)


def _lines(results: Path) -> Iterator[Line]:
    for file in sorted(results.glob("*.json")):
        yield from _lines_of(file, _EXPERT)
    for file in sorted((results / "submissions").glob("*.json")):
        yield from _lines_of(file, file.stem)


def _lines_of(file: Path, entry: str) -> Iterator[Line]:
    content = read_json_object(file, UnreadableResultError)
    rows = [from_columns(Row, {"facts": {}, "history": {}} | row, file) for row in content["rows"]]
    for summary in summarise(rows):
        mark = ", state" if summary.obs == "state" and entry != _EXPERT else ""
        yield Line(entry + mark, _code(content["provenance"]), summary)


def _code(provenance: Mapping[str, Any]) -> str:
    commit = provenance["commit"]
    return "unknown" if commit is None else str(commit)[:7]


def _section(line: Line) -> tuple[str, str]:
    task = line.summary.task
    level = task.partition("/")[0].replace("level", "level ")
    beyond = ", beyond the paper" if is_beyond_paper(task) else ""
    return level + beyond, line.summary.split


def _table(lines: Sequence[Line]) -> str:
    tasks = sorted({line.summary.task for line in lines})
    names = " | ".join(task.partition("/")[2] for task in tasks)
    rows = [f"| entry | mean | {names} | code |", f"| --- |{' --- |' * (len(tasks) + 2)}"]
    entries = dict.fromkeys(line.entry for line in lines)
    of = {entry: [line for line in lines if line.entry == entry] for entry in entries}
    best_first = sorted(of.items(), key=lambda item: -fmean(x.summary.rate for x in item[1]))
    for entry, own in best_first:
        won = {line.summary.task: _cell(line.summary) for line in own}
        cells = " | ".join(won.get(task, "-") for task in tasks)
        # A mean over other tasks than the others' would not compare.
        whole = len(won) == len(tasks)
        mean = f"{100 * fmean(x.summary.rate for x in own):.0f} %" if whole else "-"
        code = ", ".join(sorted({line.code for line in own}))
        rows.append(f"| {entry} | {mean} | {cells} | {code} |")
    return "\n".join(rows) + "\n"


def _cell(summary: Summary) -> str:
    low, high = summary.wilson95
    return f"{summary.successes}/{summary.n} ({100 * low:.0f} to {100 * high:.0f} %)"


if __name__ == "__main__":
    main()
