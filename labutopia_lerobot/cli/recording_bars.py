"""The progress of a recording in the terminal: rate, failures, time left."""

import time
from collections.abc import Sequence
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)

from labutopia_lerobot.datasets.candidate import Candidate

_LOG_S = 10.0
"""Time between two lines in a log file [s]."""


class RecordingBars:
    """A `Watcher` that draws one bar for playing and one for writing the dataset.

    Where there is no terminal, such as in a log file, it writes a line every ten seconds instead.

    Args:
        episodes: How many demonstrations are wanted.
        console: Where to draw.
    """

    def __init__(self, episodes: int, console: Console) -> None:
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            TextColumn("{task.fields[note]}"),
            console=console,
        )
        self._console = console
        self._playing = self._progress.add_task("Playing", total=episodes, note="")
        self._writing = self._progress.add_task("Writing", total=episodes, note="")
        self._began = self._logged = time.monotonic()
        self._frames = self._failures = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._progress.stop()

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        """Begin to draw, with the candidates of a previous run, which say nothing of the rate."""
        self._progress.start()
        successes = sum(candidate.success for candidate in candidates)
        self._failures = len(candidates) - successes
        self._progress.reset(self._playing, completed=successes)

    def played(self, candidate: Candidate) -> None:
        """Count a finished candidate."""
        self._frames += candidate.frames
        self._failures += not candidate.success
        rate = self._frames / (time.monotonic() - self._began)
        note = f"{rate:.0f} frames/s, {self._failures} failed"
        self._progress.update(self._playing, advance=int(candidate.success), note=note)
        self._log(self._playing, note)

    def assembled(self, candidate: Candidate) -> None:
        """Count an episode of the dataset."""
        self._progress.advance(self._writing)
        self._log(self._writing)

    def _log(self, bar: TaskID, note: str = "") -> None:
        """Write a line of one of the bars where nothing can be drawn, if it is time."""
        if self._console.is_terminal or time.monotonic() - self._logged < _LOG_S:
            return
        self._logged = time.monotonic()
        shown = self._progress.tasks[bar]
        counted = f"{shown.description} {shown.completed:.0f}/{shown.total:.0f}"
        self._console.print(f"{counted}{note and ', '}{note}", markup=False)
