"""A run of the evaluator: from its options to its result, its table and its films."""

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import track

from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.evaluate import evaluate, in_order, make_pairings
from labutopia_lerobot.evaluation.films import choose, film, require_camera
from labutopia_lerobot.evaluation.found import FoundResult, find_results
from labutopia_lerobot.evaluation.live import LiveProgress
from labutopia_lerobot.evaluation.origin import full_provenance, origin
from labutopia_lerobot.evaluation.reporting.cost import cost_table
from labutopia_lerobot.evaluation.reporting.entry import entries
from labutopia_lerobot.evaluation.reporting.levels import step_table
from labutopia_lerobot.evaluation.reporting.table import as_text
from labutopia_lerobot.evaluation.result import ResultFolder, claim
from labutopia_lerobot.evaluation.rollout import Episode, Pairing
from labutopia_lerobot.evaluation.row import STAGED, Row
from labutopia_lerobot.evaluation.statistics import summarise
from labutopia_lerobot.evaluation.stopping import Seen, StoppingRule
from labutopia_lerobot.evaluation.table import summary_table
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
        console.print(as_text(cost_table(config.episodes_for, settings)), markup=False)
        return None
    pairings = make_pairings(config)
    if config.videos:
        require_camera(pairings[0].setting.renderer)
    began = origin(config, pairings)
    with claim(Path(config.out), began) as folder:
        episodes = _play(config, pairings, folder)
        rows = [episode.row for episode in episodes]
        summaries = summarise(rows)
        file = folder.finish(rows, summaries, full_provenance(began, config, rows))
        means, anytime = config.level is not None, config.until is not None
        console.print(summary_table(summaries, level_means=means, anytime=anytime))
        if STAGED in config.plays:
            told = entries([FoundResult(folder.path, True, tuple(rows), {})])
            console.print(as_text(step_table(told)), markup=False)
        _film(config, episodes, folder)
    console.print(f"Wrote {file}", soft_wrap=True, markup=False, highlight=False)
    return file


def _play(
    config: EvaluationConfig, pairings: Sequence[Pairing], folder: ResultFolder
) -> list[Episode]:
    """Return every episode in order; only those without a row are played."""
    seeds = range(config.seed, config.seed + config.episodes)
    seen = Seen(StoppingRule(config.until) if config.until else None, config.seed, _rival(config))
    of = {pairing.series: pairing for pairing in pairings}
    kept = zip(folder.rows, folder.actions(), strict=True)
    episodes = [Episode(of[row.series], row, actions) for row, actions in kept]
    for episode in episodes:
        seen.note(episode.row)
    played = evaluate(pairings, seeds, config.workers, tuple(episodes), seen.enough)
    with LiveProgress(pairings, len(seeds), Console(stderr=True)) as live:
        live.known(folder.rows)
        for episode in played:
            folder.add(episode.row, episode.actions)
            live.played(episode.row)
            seen.note(episode.row)
            episodes.append(episode)
    return [episode for episode in in_order(episodes, pairings) if seen.counts(episode.row)]


def _rival(config: EvaluationConfig) -> list[Row]:
    """Return the rows of the result that this run is to be told apart from."""
    if config.versus is None:
        return []
    return [row for result in find_results(Path(config.versus)) for row in result.rows]


def _film(config: EvaluationConfig, episodes: Sequence[Episode], folder: ResultFolder) -> None:
    films = choose(episodes, config.videos, folder.path)
    filmed = in_processes(film, films, config.workers)
    bar = Console(stderr=True)
    for _ in track(filmed, "Filming", total=len(films), console=bar, disable=not films):
        pass
