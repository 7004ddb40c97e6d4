"""`python scripts/make_cards.py [TASK ...]`: the cards in `datasets_cards`, one per task.

No dataset is released yet. So each card is of a sample that this script records, small enough to be
made again anywhere: its facts (`.json`) and its strip of pictures (`.jpg`) are kept beside the card
(`.md`), which is made of them and of the expert's rows in `eval/results`. With `--text` only the
cards are made again, from what is kept.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

import expert_rows
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.cli.recording_bars import RecordingBars
from labutopia_lerobot.datasets.recorder import record
from labutopia_lerobot.datasets.recording_folder import FinishedError
from labutopia_lerobot.evaluation.rows import EvaluationSummary, summarise
from labutopia_lerobot.hub.dataset_card import card_of_dataset
from labutopia_lerobot.hub.dataset_facts import DatasetFacts
from labutopia_lerobot.hub.strip import picture_strip
from labutopia_lerobot.registry import task_files

ROOT = Path(__file__).parents[1]
CARDS = ROOT / "datasets_cards"
SAMPLES = ROOT / "outputs" / "cards"
EPISODES = 3


@clear_errors
def main() -> None:
    """Record samples and write their cards."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("tasks", nargs="*", help="task ids (default: all)")
    parser.add_argument("--text", action="store_true", help="record nothing")
    arguments = parser.parse_args()
    tasks = [] if arguments.text else arguments.tasks or list(task_files())
    # All samples first: with the first card the checkout is no longer the commit that it names.
    for sample in [sample_of(task) for task in tasks]:
        keep_facts(sample)
    results = expert_results()
    for facts in sorted(CARDS.glob("*.json")):
        facts.with_suffix(".md").write_text(card(facts, results))


def sample_of(task: str) -> Path:
    """Record the sample of a task, if it is not there yet; return its folder."""
    options = [f"task={task}", f"episodes={EPISODES}", f"root={SAMPLES / task}"]
    (config,) = parse(options).datasets()
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    try:
        with RecordingBars(EPISODES, console) as bars:
            record(config, bars)
    except FinishedError:
        console.print(f"{config.folder} is finished", markup=False)
    return config.folder


def keep_facts(sample: Path) -> None:
    """Keep facts and pictures of a sample."""
    facts = DatasetFacts.read(sample)
    file = CARDS / f"{'-'.join(sample.relative_to(SAMPLES).parts)}.json"
    facts.save(file)
    strip = picture_strip(sample, facts.info)
    assert strip is not None
    file.with_suffix(".jpg").write_bytes(strip)


def expert_results() -> list[EvaluationSummary]:
    """Return the expert's rates."""
    rows = expert_rows.read(expert_rows.RESULTS).values()
    return [line for played in rows for line in summarise(played)]


def card(file: Path, results: Sequence[EvaluationSummary]) -> str:
    """Return the card of the facts in a file."""
    facts = DatasetFacts.load(file)
    return card_of_dataset(facts, facts.config["repo_id"], results, file.with_suffix(".jpg").name)


if __name__ == "__main__":
    main()
