"""The progress of an experiment: what is done, how far it is, how long everything takes."""

from types import TracebackType
from typing import Self

from rich.console import Console

from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart
from labutopia_lerobot.runtime.bars import LogLines, counting_bars


class RunningBars:
    """One bar for all parts; where there is no terminal, a line every ten seconds.

    Args:
        count: How many parts are to be done.
        console: Where to draw.
    """

    def __init__(self, count: int, console: Console) -> None:
        self._bars = counting_bars(console)
        self._lines = LogLines(console)
        self._all = self._bars.add_task("Parts", total=count, note="")

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

    def shown(self, part: ExperimentPart, share: float, left_s: float | None) -> None:
        """Show how far a part is.

        Args:
            part: The part that is done now.
            share: How much of it is done, from 0 to 1.
            left_s: How long it and everything behind it will take [s], or None if nobody knows.
        """
        left = "time left not known" if left_s is None else f"{_duration(left_s)} left in all"
        note = f"{part.name}: {100 * share:.0f} %, {left}"
        self._bars.update(self._all, note=note)
        bar = self._bars.tasks[self._all]
        self._lines.write(f"Part {bar.completed + 1:.0f}/{bar.total:.0f}, {note}")

    def ended(self, part: ExperimentPart) -> None:
        """Count a part that is over."""
        self._bars.advance(self._all)
        bar = self._bars.tasks[self._all]
        self._lines.write(f"Parts {bar.completed:.0f}/{bar.total:.0f}: {part.name}", at_once=True)


def _duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
