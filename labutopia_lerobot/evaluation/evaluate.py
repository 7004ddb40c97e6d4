"""An evaluation, from pairings of policies and tasks to episodes."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace

from labutopia_lerobot.evaluation.checkpoint import open_checkpoint
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES
from labutopia_lerobot.evaluation.remote.reach import REMOTE, reach
from labutopia_lerobot.evaluation.rollout import Episode, Pairing, play
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import setting_of


def make_pairings(config: EvaluationConfig) -> list[Pairing]:
    """Return what an evaluation plays, ordered by task and split.

    Raises:
        CheckpointError: If a checkpoint is missing, or cannot play its task.
        EvaluationOptionError: If options contradict each other.
        UnknownTaskError: If no task is named, or one that does not exist.
    """
    return [_pairing(config, task, split) for task in config.tasks for split in config.splits]


def evaluate(
    pairings: Sequence[Pairing],
    seeds: Sequence[int],
    workers: int,
    known: Collection[Episode] = (),
    enough: Callable[[str, str], bool] = lambda task, split: False,
) -> Iterator[Episode]:
    """Yield every episode as it is finished; what is in them does not depend on the workers.

    Args:
        pairings: What to play.
        seeds: Which episodes of each.
        workers: Number of processes.
        known: Episodes that an earlier run played; they are not yielded.
        enough: Whether a task and split needs no more episodes; asked before each of them.

    Raises:
        Exception: Whatever was raised in a worker; a bug is not a failed episode.
    """
    played = {(episode.pairing, episode.row.seed) for episode in known}
    jobs = (
        (pairing, seed)
        for pairing in pairings
        for seed in seeds
        if (pairing, seed) not in played and not enough(pairing.setting.task, pairing.setting.split)
    )
    yield from in_processes(play, jobs, workers)


def in_order(episodes: Sequence[Episode], pairings: Sequence[Pairing]) -> list[Episode]:
    """Return episodes in the order of the pairings, and then of the seeds."""
    return sorted(episodes, key=lambda episode: (pairings.index(episode.pairing), episode.row.seed))


def _pairing(config: EvaluationConfig, task: str, split: str) -> Pairing:
    policy = config.policy
    setting = setting_of(config, task=task, split=split, obs=config.obs or "state")
    if policy.name == REMOTE:
        remote = reach(policy, replace(setting, obs=config.obs or "pixels"), config.workers)
        return Pairing(remote.setting, REMOTE, remote)
    if policy.name not in REFERENCE_POLICIES:
        path = policy.path or f"outputs/train/{policy.name}"
        rename = policy.rename
        checkpoint = open_checkpoint(path, policy.name, setting, config.obs, policy.device, rename)
        return Pairing(checkpoint.setting, checkpoint.type, checkpoint)
    if policy != PolicyConfig(policy.name):
        raise EvaluationOptionError(
            f"policy={policy.name} takes no option of its own, such as policy.path"
        )
    canonical_task(setting)  # so that impossible axes are told at once
    return Pairing(setting, policy.name, REFERENCE_POLICIES[policy.name])
