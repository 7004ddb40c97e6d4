"""Results that lie in a folder, finished or not, or in a file of kept rows."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.result_folder import ORIGIN, RESULT, ROWS, SCHEMA, read_rows
from labutopia_lerobot.evaluation.rows import (
    EvaluationSummary,
    Row,
    UnreadableResultError,
    from_columns,
    summarise,
)
from labutopia_lerobot.foreign_files import read_json_object


@dataclass(frozen=True)
class LoadedResult:
    """A result.

    Attributes:
        place: Folder of the result, or file of kept rows.
        finished: Whether every episode was played.
        rows: Its rows, in order; of an unfinished one, of the episodes so far.
        provenance: What they come from (see `origin`), as far as it is recorded.
    """

    place: Path
    finished: bool
    rows: tuple[Row, ...]
    provenance: Mapping[str, Any]

    @property
    def config(self) -> Mapping[str, Any]:
        """The options of the run, as far as they are recorded."""
        config: Mapping[str, Any] = self.provenance.get("config", {})
        return config

    @property
    def sequential(self) -> bool:
        """Whether the run could stop early by its own outcomes (`until`)."""
        return self.config.get("until") is not None

    @cached_property
    def summaries(self) -> list[EvaluationSummary]:
        """Summaries of its rows, one per policy and condition."""
        return summarise(self.rows, sequential=self.sequential)


def load_results(place: Path) -> list[LoadedResult]:
    """Return every result at or below a folder, or in a file, by path.

    Args:
        place: Folder of results, or of files of rows such as `eval/results`, or one such file.

    Raises:
        UnreadableResultError: If there is none, or one is damaged.
    """
    if place.is_file():
        return [_read_file(place, place)]
    folders = {file.parent for name in (RESULT, ROWS) for file in place.rglob(name)}
    kept = () if folders else place.glob("*.json")
    results = [*map(_read_folder, sorted(folders)), *(_read_file(f, f) for f in sorted(kept))]
    if not results:
        raise UnreadableResultError(
            f"{place} holds neither {RESULT} nor {ROWS}. Make one: "
            f"python eval/run.py task=level1/pick policy=expert out={place}"
        )
    return results


def _read_folder(folder: Path) -> LoadedResult:
    if (folder / RESULT).exists():
        return _read_file(folder / RESULT, folder)
    rows = sorted(
        read_rows(folder / ROWS), key=lambda row: (row.task, row.split, row.policy, row.seed)
    )
    origin: dict[str, Any] = {}
    if (folder / ORIGIN).exists():
        origin = read_json_object(folder / ORIGIN, UnreadableResultError)
    code = origin.pop("code", {})
    return LoadedResult(folder, finished=False, rows=tuple(rows), provenance={**code, **origin})


def _read_file(file: Path, place: Path) -> LoadedResult:
    return result_in(read_json_object(file, UnreadableResultError), file, place)


def result_in(content: Mapping[str, Any], file: Path, place: Path) -> LoadedResult:
    """Return the finished result that a JSON object holds.

    Args:
        content: The object; one of an earlier version may lack its schema and some columns.
        file: Where it came from.
        place: What the result is to be called by.

    Raises:
        UnreadableResultError: If it holds none, or one of a later version.
    """
    schema = content.get("schema", SCHEMA)
    if not isinstance(schema, int) or schema > SCHEMA:
        raise UnreadableResultError(
            f"{file} has the schema {schema!r}, and this version knows those up to {SCHEMA}: "
            "install a newer one"
        )
    provenance = content.get("provenance", {})
    if not isinstance(provenance, dict) or not isinstance(provenance.get("config", {}), dict):
        raise UnreadableResultError(f"The `provenance` of {file} is no JSON object")
    rows = tuple(_rows(content.get("rows"), file))
    return LoadedResult(place, finished=True, rows=rows, provenance=provenance)


def _rows(rows: object, file: Path) -> Iterator[Row]:
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise UnreadableResultError(f"{file} has no `rows`: it is no result of `eval/run.py`")
    for row in rows:
        yield from_columns(Row, row, file)
