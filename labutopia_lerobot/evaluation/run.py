"""A run of the evaluator: from its options to its result, its tables and its films."""

import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import TaskID, track

from labutopia_lerobot.evaluation.condition import SINGLE, Condition
from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.jobs import EvaluationJob, make_jobs, trained_elsewhere
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.origin import full_provenance, origin
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.run_tables import cost_table, run_tables
from labutopia_lerobot.evaluation.reporting.table import TextTable
from labutopia_lerobot.evaluation.result_folder import ResultFolder, claim
from labutopia_lerobot.evaluation.rollout import (
    Episode,
    choose,
    evaluate,
    film,
    in_order,
    require_camera,
)
from labutopia_lerobot.evaluation.rows import Row, summarise
from labutopia_lerobot.evaluation.stopping import SequentialMonitor, StoppingRule, find_rival
from labutopia_lerobot.runtime.bars import LogLines, counting_bars
from labutopia_lerobot.runtime.workers import in_processes


def run(config: EvaluationConfig, console: Console) -> Path | None:
    """Play every episode, write the result, print the table, film a few episodes.

    What an earlier run of the same evaluation left in the folder is gone on with.

    Returns:
        The result file; None with `episodes_for`, which plays nothing.

    Raises:
        UserError: If the options are impossible, or the folder is in other use.
        Exception: Whatever was raised in a worker; the rows of finished episodes are kept.
    """
    config.check()
    if config.episodes_for is not None:
        settings = len(config.tasks) * len(config.splits)
        console.print(TextTable(cost_table(config.episodes_for, settings)))
        return None
    jobs = make_jobs(config)
    for note in dict.fromkeys(trained_elsewhere(jobs)):
        console.print(note, soft_wrap=True, markup=False, highlight=False)
    if config.videos:
        require_camera(jobs[0].setting.renderer)
    seeds = range(config.seed, config.seed + config.episodes)
    rival = None
    if config.versus is not None:
        rival = find_rival(Path(config.versus), [job.condition for job in jobs], seeds)
    began = origin(config, jobs, rival)
    with claim(Path(config.out), began) as folder:
        rule = None if config.until is None else StoppingRule(config.until)
        monitor = SequentialMonitor(rule, config.seed, rival)
        episodes = _play(config, jobs, folder, monitor)
        rows = [episode.row for episode in episodes]
        summaries = summarise(rows, sequential=config.until is not None)
        result = LoadedResult(folder.path, True, tuple(rows), {"config": config.chosen})
        for table in run_tables(report_entries([result]), level_means=config.level is not None):
            console.print(TextTable(table))
            console.print()
        _film(config, episodes, folder)  # before it is finished: what is not can be gone on with
        file = folder.finish(rows, summaries, full_provenance(began, config, rows))
    console.print(f"Wrote {file}", soft_wrap=True, markup=False, highlight=False)
    return file


def _play(
    config: EvaluationConfig,
    jobs: Sequence[EvaluationJob],
    folder: ResultFolder,
    monitor: SequentialMonitor,
) -> list[Episode]:
    """Return every episode in order; only those without a row are played."""
    seeds = range(config.seed, config.seed + config.episodes)
    of = {job.condition: job for job in jobs}
    kept = zip(folder.rows, folder.actions(), strict=True)
    episodes = [Episode(of[row.condition], row, actions) for row, actions in kept]
    for episode in episodes:
        monitor.note(episode.row)
    played = evaluate(jobs, seeds, config.workers, tuple(episodes), monitor.enough)
    with LiveProgress(jobs, len(seeds), Console(stderr=True)) as live:
        live.known(folder.rows)
        for episode in played:
            folder.add(episode.row, episode.actions)
            live.played(episode.row)
            monitor.note(episode.row)
            episodes.append(episode)
    return [episode for episode in in_order(episodes, jobs) if monitor.counts(episode.row)]


def _film(config: EvaluationConfig, episodes: Sequence[Episode], folder: ResultFolder) -> None:
    films = choose(episodes, config.videos, folder.path)
    filmed = in_processes(film, films, config.workers)
    bar = Console(stderr=True)
    for _ in track(filmed, "Filming", total=len(films), console=bar, disable=not films):
        pass


class LiveProgress:
    """One bar for all episodes, with rate and time left, and one per condition with its successes.

    Args:
        jobs: Episodes to play.
        episodes: How many episodes of each.
        console: Where to; it knows whether it is a terminal.
    """

    def __init__(self, jobs: Sequence[EvaluationJob], episodes: int, console: Console) -> None:
        self._bars = counting_bars(console)
        self._lines = LogLines(console)
        self._all = self._bars.add_task("Playing", total=len(jobs) * episodes, note="")
        self._of: dict[Condition, TaskID] = {
            condition: self._bars.add_task(_described(condition), total=episodes, note="")
            for condition in (job.condition for job in jobs)
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
        self._successes[row.condition] += row.success
        self._bars.advance(self._all)
        self._bars.advance(self._of[row.condition])
        self._bars.update(self._of[row.condition], note=self._running(row))

    def _running(self, row: Row) -> str:
        done = round(self._bars.tasks[self._of[row.condition]].completed)
        won = self._successes[row.condition]
        return f"{won}/{done} succeeded, {100 * won / done:.0f} %"

    def _log(self, row: Row, rate: float) -> None:
        bar = self._bars.tasks[self._all]
        left_min = (bar.remaining or 0.0) / rate
        self._lines.write(
            f"Playing {bar.completed:.0f}/{bar.total:.0f}, {rate:.1f} episodes/min, "
            f"{left_min:.1f} min left; {_described(row.condition)}: {self._running(row)}",
            at_once=bar.finished,
        )


def _described(condition: Condition) -> str:
    staged = [condition.play] if condition.play != SINGLE else []
    return " ".join([condition.task, condition.split, *staged])
