"""Results that lie in a folder, finished or not."""

from dataclasses import dataclass
from pathlib import Path

from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.result import RESULT, ROWS, read_rows
from labutopia_lerobot.evaluation.row import UnreadableResultError, from_columns
from labutopia_lerobot.evaluation.statistics import Summary, summarise


@dataclass(frozen=True)
class FoundResult:
    """A result.

    Attributes:
        folder: Where it lies.
        finished: Whether every episode was played.
        summaries: What it tells; of an unfinished one, of the episodes so far.
    """

    folder: Path
    finished: bool
    summaries: tuple[Summary, ...]


def find_results(folder: Path) -> list[FoundResult]:
    """Return every result at or below a folder, by path.

    Raises:
        UnreadableResultError: If there is none, or one is damaged.
    """
    files = [file for name in (RESULT, ROWS) for file in folder.rglob(name)]
    if not files:
        raise UnreadableResultError(
            f"{folder} holds neither {RESULT} nor {ROWS}. Make one: "
            f"python eval/run.py task=level1/pick policy=expert out={folder}"
        )
    return [_read(place) for place in sorted({file.parent for file in files})]


def _read(folder: Path) -> FoundResult:
    file = folder / RESULT
    if not file.exists():
        rows = read_rows(folder / ROWS)
        rows.sort(key=lambda row: (row.task, row.split, row.policy, row.seed))
        return FoundResult(folder, finished=False, summaries=tuple(summarise(rows)))
    lines = read_json_object(file, UnreadableResultError).get("summary")
    if not isinstance(lines, list) or not all(isinstance(line, dict) for line in lines):
        raise UnreadableResultError(f"{file} has no `summary`: it is no result of `eval/run.py`")
    summaries = tuple(from_columns(Summary, line, file) for line in lines)
    return FoundResult(folder, finished=True, summaries=summaries)
