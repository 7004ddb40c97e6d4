"""A run of the evaluator: from its options to its result, its table and its films."""

from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

from rich.console import Console
from rich.progress import track

from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.evaluate import evaluate, in_order, make_pairings
from labutopia_lerobot.evaluation.films import choose, film, require_camera
from labutopia_lerobot.evaluation.result import ResultFolder, provenance
from labutopia_lerobot.evaluation.rollout import Episode
from labutopia_lerobot.evaluation.statistics import summarise
from labutopia_lerobot.evaluation.table import summary_table
from labutopia_lerobot.runtime.workers import in_processes


def run(config: EvaluationConfig, console: Console) -> Path:
    """Play every episode, write the result, print the table, film a few episodes.

    Returns:
        The result file.

    Raises:
        UserError: If the options are impossible.
        Exception: Whatever was raised in a worker; the rows of finished episodes are kept.
    """
    config.check()
    pairings = make_pairings(config)
    if config.videos:
        require_camera()
    folder = ResultFolder(Path(config.out))
    seeds = range(config.seed, config.seed + config.episodes)
    episodes: list[Episode] = []
    played = evaluate(pairings, seeds, config.workers)
    for episode in _watched(played, "Playing", len(pairings) * len(seeds)):
        folder.add(episode.row)
        episodes.append(episode)
    episodes = in_order(episodes, pairings)
    rows = [episode.row for episode in episodes]
    summaries = summarise(rows)
    renderers = {episode.renderer for episode in episodes if episode.renderer}
    origin = provenance(asdict(config), ", ".join(sorted(renderers)) or None)
    file = folder.finish(rows, summaries, origin)
    console.print(summary_table(summaries, level_means=config.level is not None))
    films = choose(episodes, config.videos, folder.path / "videos")
    for _ in _watched(in_processes(film, films, config.workers), "Filming", len(films)):
        pass
    console.print(f"Wrote {file}", soft_wrap=True, markup=False, highlight=False)
    return file


def _watched[Item](items: Iterable[Item], verb: str, total: int) -> Iterable[Item]:
    return track(items, verb, total=total, console=Console(stderr=True), disable=total == 0)
