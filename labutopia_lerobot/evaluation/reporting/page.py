"""One self-contained HTML file of results, with films: it needs no network, and no scripts."""

import base64
import json
import os
import shlex
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from labutopia_lerobot.evaluation.condition import EXPERT, SINGLE
from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.failure_causes import failed_in
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.charts import failure_shares, funnel, slopes
from labutopia_lerobot.evaluation.reporting.report_entry import ReportEntry, report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import (
    cause_in_words,
    failures,
    level_tables,
    precision_table,
)
from labutopia_lerobot.evaluation.reporting.table import Table
from labutopia_lerobot.evaluation.result_folder import VIDEOS, film_of, film_of_expert
from labutopia_lerobot.evaluation.rows import Row, UnreadableResultError
from labutopia_lerobot.foreign_files import inside
from labutopia_lerobot.setting import options_of
from labutopia_lerobot.task import HOLD_S

_PROGRAM = ("python", "eval/run.py")
_OF_THE_ROW = ("task", "level", "split", "play", "policy", "seed", "episodes", "axes", "obs")
"""Options that the rows record, and those that they make needless."""

_OF_THE_RUN = ("out", "workers", "videos", "until", "versus", "episodes_for")
"""Options on which no row depends, or whose work the number of episodes does."""


def command(entry: ReportEntry) -> str:
    """Return the command that plays exactly the rows of an entry."""
    seeds = [row.seed for row in entry.rows]
    return _command(entry, seeds[0], seeds[-1] - seeds[0] + 1)


def episode_command(entry: ReportEntry, row: Row) -> str:
    """Return the command that plays one episode, and films it."""
    return _command(entry, row.seed, 1)


def _command(entry: ReportEntry, seed: int, episodes: int) -> str:
    row = entry.rows[0]
    config = entry.result.config
    words = {
        "task": row.task,
        "policy": row.policy,
        **{f"policy.{name}": config.get("policy", {}).get(name) for name in ("path", "device")},
        "split": row.split,
        "play": None if row.play == SINGLE else row.play,
        "axes": row.axes or None,
        "obs": row.obs,
        "seed": seed,
        "episodes": episodes,
        **dict(_unusual(config)),
    }
    options = [f"{name}={_value(value)}" for name, value in words.items() if value is not None]
    return shlex.join([*_PROGRAM, *options])


def _unusual(config: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the other options that were not left at their defaults."""
    for option in options_of(EvaluationConfig):
        if option.name in config and option.name not in (*_OF_THE_ROW, *_OF_THE_RUN):
            value = config[option.name]
            usual = None if option.default is MISSING else option.default
            if _value(value) != _value(usual):
                yield option.name, value


def _value(value: object) -> str:
    """Return a value as Hydra reads it."""
    if isinstance(value, list | tuple):
        return f"[{','.join(map(str, value))}]"
    return str(value)


_TEMPLATES = Path(__file__).with_name("templates")

MOST_EMBEDDED = 16_000_000
"""Bytes of all films of a page up to which they stand in it; beyond, it would open too slowly."""


@dataclass(frozen=True)
class FilmedEpisode:
    """An episode with a film.

    Attributes:
        entry: Which policy under which condition.
        row: What became of the episode.
        films: Who plays -> its film of the scene, or None where there is none.
    """

    entry: ReportEntry
    row: Row
    films: tuple[tuple[str, Path | None], ...]

    @property
    def outcome(self) -> str:
        """Outcome of the episode in words."""
        how = (
            "success"
            if self.row.success
            else f"{cause_in_words(self.row)} in {failed_in(self.row)}"
        )
        return f"{how}, after {self.row.seconds:.1f} s"

    @property
    def command(self) -> str:
        """Command that plays it again."""
        return episode_command(self.entry, self.row)


def filmed_episodes(entries: Sequence[ReportEntry]) -> list[FilmedEpisode]:
    """Return every filmed episode, the failures of an entry first."""
    expert = {
        row.scene: _film(entry, row)
        for entry in entries
        for row in entry.rows
        if row.policy == EXPERT
    }
    filmed = []
    for entry in entries:
        for row in sorted(entry.rows, key=lambda row: row.success):
            film = _film(entry, row)
            if film is None:
                continue
            films: list[tuple[str, Path | None]] = [(entry.label, film)]
            if not row.success and row.policy != EXPERT:
                beside = film_of_expert(film)
                films.append((EXPERT, beside if beside.is_file() else expert.get(row.scene)))
            filmed.append(FilmedEpisode(entry, row, tuple(films)))
    return filmed


def films_of(results: Sequence[LoadedResult]) -> list[Path]:
    """Return the films that a page of these results shows, each once."""
    clips = (clip for each in filmed_episodes(report_entries(results)) for clip in each.films)
    return list(dict.fromkeys(film for _, film in clips if film is not None))


def addresses(films: Sequence[Path], folder: Path) -> dict[Path, str]:
    """Return film -> its address in a page: the film itself if all are small, or else a link.

    Args:
        films: What the page shows.
        folder: Where the page lies; links are relative to it.
    """
    if sum(film.stat().st_size for film in films) > MOST_EMBEDDED:
        return {film: quote(os.path.relpath(film, folder)) for film in films}
    return {
        film: f"data:video/mp4;base64,{base64.b64encode(film.read_bytes()).decode()}"
        for film in films
    }


def _film(entry: ReportEntry, row: Row) -> Path | None:
    """Return the film of an episode, or None if there is none.

    Names of outcomes come from a file: whatever leads out of the folder of films is none.
    """
    film = film_of(entry.result.place, row)
    try:
        inside(entry.result.place / VIDEOS, film.name, UnreadableResultError)
    except UnreadableResultError:
        return None
    return film if film.parent.name == VIDEOS and film.is_file() else None


def write_page(
    file: Path,
    results: Sequence[LoadedResult],
    tables: Sequence[Table] = (),
    curves: Sequence[Mapping[str, Any]] = (),
) -> None:
    """Write the page of results; the same results in the same place give the same bytes.

    Args:
        file: The page.
        results: What it shows; at least one of them has a row.
        tables: Further tables, which come first.
        curves: Charts of what grows with something, as `charts.curve` makes them.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    written = file.with_name(f"{file.name}.tmp")
    address_of = addresses(films_of(results), file.parent)
    written.write_text(page(results, address_of, tables, curves))
    written.replace(file)  # where a link lies, it is replaced and not followed


def page(
    results: Sequence[LoadedResult],
    address_of: Mapping[Path, str],
    tables: Sequence[Table] = (),
    curves: Sequence[Mapping[str, Any]] = (),
) -> str:
    """Return the page of results as HTML.

    Args:
        results: What it shows; at least one of them has a row.
        address_of: Film -> its address, for all of `films_of(results)`.
        tables: Further tables, which come first.
        curves: Charts, as `charts.curve` makes them.
    """
    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = environment.get_template("style.css").render()
    template = environment.get_template("page.html.j2")
    content = _content(results, address_of, tables, curves)
    return template.render(content, style=environment.filters["safe"](style))


def _content(
    results: Sequence[LoadedResult],
    address_of: Mapping[Path, str],
    further: Sequence[Table],
    curves: Sequence[Mapping[str, Any]],
) -> dict[str, Any]:
    entries = report_entries(results)
    shown = (*further, *level_tables(entries))
    tables = [(f"table{index}", table) for index, table in enumerate(shown)]
    films = filmed_episodes(entries)
    precision = precision_table(entries)
    shifted = slopes(entries)
    with_failures = [entry for entry in entries if failures(entry)]
    causes = Counter(cause for entry in with_failures for _, cause in failures(entry).elements())
    common = [cause for cause, _ in causes.most_common()]
    failed = [failure_shares(entry, common) for entry in with_failures]
    sections = [
        *((id_, table.title) for id_, table in tables),
        *([("curves", "Curves")] if curves else []),
        *([("shift", "Under shift")] if shifted else []),
        ("substeps", "Substeps"),
        *([("failures", "Failures")] if failed else []),
        *([("films", "Films")] if films else []),
        *([("precision", precision.title)] if precision.lines else []),
        ("again", "Commands"),
        ("origin", "Origin"),
    ]
    names = list(dict.fromkeys(entry.name for entry in entries))
    tasks = list(dict.fromkeys(entry.task for entry in entries))
    return {
        "title": f"{_joined(names, 'policies')} on {_joined(tasks, 'tasks')}",
        "hold": f"{HOLD_S:g}",
        "figures": [
            (sum(len(entry.rows) for entry in entries), "episodes"),
            (len(tasks), "tasks" if len(tasks) > 1 else "task"),
            (len(names), "policies" if len(names) > 1 else "policy"),
            (sum(entry.summary.successes for entry in entries), "successes"),
        ],
        "warnings": [
            f"Unfinished: {result.place}, {len(result.rows)} episodes so far"
            for result in results
            if not result.finished
        ],
        "sections": sections,
        "tables": tables,
        "curves": curves,
        "slopes": shifted,
        "funnels": [funnel(entry) for entry in entries],
        "failures": failed,
        "films": [_filmed(episode, address_of) for episode in films],
        "embedded": all(address.startswith("data:") for address in address_of.values()),
        "beside": not all(address.startswith(("data:", "/")) for address in address_of.values()),
        "precision": precision,
        "commands": [
            {
                "task": entry.task,
                "heading": f"{entry.label}, {entry.condition.played}",
                "command": command(entry),
            }
            for entry in entries
        ],
        "origins": [_origin(result) for result in results],
    }


def _filmed(episode: FilmedEpisode, address_of: Mapping[Path, str]) -> dict[str, Any]:
    entry, row = episode.entry, episode.row
    return {
        "task": row.task,
        "seed": row.seed,
        "heading": f"{entry.label}, {entry.condition.played}",
        "outcome": episode.outcome,
        "command": episode.command,
        "clips": [(who, None if film is None else address_of[film]) for who, film in episode.films],
    }


def _joined(names: Sequence[str], kind: str) -> str:
    """Return names as in a sentence, or how many there are."""
    if len(names) > 3:
        return f"{len(names)} {kind}"
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def _origin(result: LoadedResult) -> dict[str, Any]:
    return {"place": str(result.place), "facts": list(_described(result.provenance.items()))}


def _described(provenance: Any) -> Iterator[tuple[str, str]]:
    """Yield the origin of rows, in words."""
    for name, value in provenance:
        if name == "versions" and isinstance(value, dict):
            value = ", ".join(f"{package} {v}" for package, v in value.items() if v is not None)
        elif isinstance(value, dict):
            value = json.dumps(value, separators=(", ", ": "))
        if value not in (None, "", "{}"):
            yield name.replace("_", " "), str(value)
