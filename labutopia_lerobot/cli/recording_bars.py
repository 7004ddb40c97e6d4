"""The progress of a recording in the terminal: rate, failures, time left."""

import time
from collections.abc import Sequence
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import TaskID

from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.runtime.bars import LogLines, counting_bars


class RecordingBars:
    """A `Watcher` that draws one bar for playing and one for writing the dataset.

    Where there is no terminal, such as in a log file, it writes a line every ten seconds instead.

    Args:
        episodes: How many demonstrations are wanted.
        console: Where to draw.
    """

    def __init__(self, episodes: int, console: Console) -> None:
        self._progress = counting_bars(console)
        self._lines = LogLines(console)
        self._playing = self._progress.add_task("Playing", total=episodes, note="")
        self._writing = self._progress.add_task("Writing", total=episodes, note="")
        self._began = time.monotonic()
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
        shown = self._progress.tasks[bar]
        counted = f"{shown.description} {shown.completed:.0f}/{shown.total:.0f}"
        self._lines.write(f"{counted}{note and ', '}{note}", at_once=shown.finished)
