"""How an evaluation goes, while it goes: a bar in a terminal, lines in a log file."""

import time
from collections.abc import Sequence
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import TaskID

from labutopia_lerobot.evaluation.rollout import Pairing
from labutopia_lerobot.evaluation.row import SINGLE, Row, Series
from labutopia_lerobot.runtime.bars import LogLines, counting_bars


class LiveProgress:
    """One bar for all episodes, with rate and time left, and one per series with its successes.

    Args:
        pairings: What is played.
        episodes: How many episodes of each.
        console: Where to; it knows whether it is a terminal.
    """

    def __init__(self, pairings: Sequence[Pairing], episodes: int, console: Console) -> None:
        self._bars = counting_bars(console)
        self._lines = LogLines(console)
        self._all = self._bars.add_task("Playing", total=len(pairings) * episodes, note="")
        self._of: dict[Series, TaskID] = {
            pairing.series: self._bars.add_task(_told(pairing.series), total=episodes, note="")
            for pairing in pairings
        }
        self._successes = dict.fromkeys(self._of, 0)
        self._played = 0
        self._began = time.monotonic()

    def __enter__(self) -> Self:
        self._bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._bars.stop()

    def known(self, rows: Sequence[Row]) -> None:
        """Count the rows of an earlier run, which say nothing of the rate."""
        for row in rows:
            self._count(row)
        self._began = time.monotonic()

    def played(self, row: Row) -> None:
        """Count an episode that has just been played."""
        self._count(row)
        self._played += 1
        rate = 60.0 * self._played / (time.monotonic() - self._began)
        self._bars.update(self._all, note=f"{rate:.1f} episodes/min")
        self._log(row, rate)

    def _count(self, row: Row) -> None:
        self._successes[row.series] += row.success
        self._bars.advance(self._all)
        self._bars.advance(self._of[row.series])
        self._bars.update(self._of[row.series], note=self._running(row))

    def _running(self, row: Row) -> str:
        done = round(self._bars.tasks[self._of[row.series]].completed)
        won = self._successes[row.series]
        return f"{won}/{done} succeeded, {100 * won / done:.0f} %"

    def _log(self, row: Row, rate: float) -> None:
        bar = self._bars.tasks[self._all]
        left_min = (bar.remaining or 0.0) / rate
        self._lines.write(
            f"Playing {bar.completed:.0f}/{bar.total:.0f}, {rate:.1f} episodes/min, "
            f"{left_min:.1f} min left; {_told(row.series)}: {self._running(row)}",
            at_once=bar.finished,
        )


def _told(series: Series) -> str:
    task, split, play = series
    return " ".join([task, split, *([play] if play != SINGLE else [])])
