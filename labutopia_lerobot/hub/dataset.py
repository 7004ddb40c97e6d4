"""A dataset as a repository of the Hub: verified, with its card, found by LeRobot's tag."""

import os
from collections.abc import Sequence
from itertools import chain
from pathlib import Path

from labutopia_lerobot.datasets.description import DamagedDatasetError
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.hub.card import finished_summaries
from labutopia_lerobot.hub.dataset_card import card_of_dataset
from labutopia_lerobot.hub.dataset_facts import DatasetFacts, dataset_files
from labutopia_lerobot.hub.repository import CARD, Repository
from labutopia_lerobot.hub.strip import STRIP, picture_strip
from labutopia_lerobot.registry import require_task


def dataset_repository(
    root: Path,
    repo_id: str,
    results: Sequence[LoadedResult],
    tasks_dir: str | None = None,
) -> Repository:
    """Verify a dataset and return what is to lie on the Hub.

    LeRobot and its visualiser look for the format's version as a tag.

    Args:
        root: Folder of the dataset.
        repo_id: Its name on the Hub, for the commands in its card.
        results: Evaluations, for its card.
        tasks_dir: A further folder of tasks, which the user trusts.

    Raises:
        UnknownTaskError: If it was recorded with a task that is not there.
        DamagedDatasetError: If anything is wrong with it.
        UntoldDatasetError: If it does not say how it was recorded.
        UnfinishedResultError: If a result is not finished.
    """
    summaries = list(chain(*finished_summaries(results)))
    faults = verify(root, tasks_dir=tasks_dir, workers=len(os.sched_getaffinity(0))).faults
    if faults:
        listed = "\n".join(f"  {fault}" for fault in faults)
        raise DamagedDatasetError(f"{root} has faults and is not published:\n{listed}")
    facts = DatasetFacts.read(root)
    for task in facts.tasks:
        require_task(task, tasks_dir)  # one that cannot be played again is not vouched for
    files: dict[str, Path | bytes] = {**dataset_files(root)}
    strip = picture_strip(root, facts.info)
    if strip is not None:
        files[STRIP] = strip
    card = card_of_dataset(facts, repo_id, summaries, strip=None if strip is None else STRIP)
    files[CARD] = card.encode()
    return Repository("dataset", files, tag=facts.info["codebase_version"])
