"""Films of failures, beside the expert's in the same scene."""

import base64
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.causes import failed_in
from labutopia_lerobot.evaluation.reporting.commands import episode_command
from labutopia_lerobot.evaluation.reporting.entry import Entry
from labutopia_lerobot.evaluation.reporting.outcomes import EXPERT, cause_told, scene
from labutopia_lerobot.evaluation.result import film_of, film_of_expert


def clips(entries: Sequence[Entry]) -> Iterator[dict[str, Any]]:
    """Yield every filmed failure, with the expert's film of the same scene where there is one."""
    expert = {
        scene(row): film_of(entry.result.place, row)
        for entry in entries
        for row in entry.rows
        if row.policy == EXPERT
    }
    for entry in entries:
        for row in entry.rows:
            film = film_of(entry.result.place, row)
            if row.success or not film.exists():
                continue
            beside = (film_of_expert(film), expert.get(scene(row)))
            found = next((file for file in beside if file is not None and file.exists()), None)
            told = [(entry.policy, _data(film))]
            if row.policy != EXPERT:
                told.append((EXPERT, _data(found)))
            yield {
                "task": row.task,
                "seed": row.seed,
                "heading": f"{entry.policy}, {entry.played}",
                "cause": cause_told(row),
                "step": failed_in(row),
                "seconds": f"{row.seconds:.1f}",
                "command": episode_command(entry, row),
                "clips": told,
            }


def _data(file: Path | None) -> str | None:
    """Return a film as it stands in a page, or None if there is none."""
    return None if file is None else base64.b64encode(file.read_bytes()).decode()
