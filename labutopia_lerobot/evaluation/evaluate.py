"""An evaluation, from pairings of policies and tasks to episodes."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace

from labutopia_lerobot.evaluation.checkpoint import Checkpoint, open_checkpoint
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES, reference_of_step
from labutopia_lerobot.evaluation.remote.reach import REMOTE, reach
from labutopia_lerobot.evaluation.rollout import Episode, Pairing, play
from labutopia_lerobot.evaluation.row import STAGED, Series
from labutopia_lerobot.evaluation.staged import Staged
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting, setting_of


def make_pairings(config: EvaluationConfig) -> list[Pairing]:
    """Return what an evaluation plays, ordered by task, split and way of playing.

    Raises:
        CheckpointError: If a checkpoint is missing, or cannot play its task.
        EvaluationOptionError: If options contradict each other.
        TaskError: If a task does not have the step that is to be played.
        UnknownTaskError: If no task is named, or one that does not exist.
    """
    return [
        _staged(config, task, split) if play == STAGED else _single(config, task, split)
        for task in config.tasks
        for split in config.splits
        for play in config.plays
    ]


def evaluate(
    pairings: Sequence[Pairing],
    seeds: Sequence[int],
    workers: int,
    known: Collection[Episode] = (),
    enough: Callable[[Series], bool] = lambda series: False,
) -> Iterator[Episode]:
    """Yield every episode as it is finished; what is in them does not depend on the workers.

    Args:
        pairings: What to play.
        seeds: Which episodes of each.
        workers: Number of processes.
        known: Episodes that an earlier run played; they are not yielded.
        enough: Whether a series needs no more episodes; asked before each of them.

    Raises:
        Exception: Whatever was raised in a worker; a bug is not a failed episode.
    """
    played = {(episode.pairing, episode.row.seed) for episode in known}
    jobs = (
        (pairing, seed)
        for pairing in pairings
        for seed in seeds
        if (pairing, seed) not in played and not enough(pairing.series)
    )
    yield from in_processes(play, jobs, workers)


def in_order(episodes: Sequence[Episode], pairings: Sequence[Pairing]) -> list[Episode]:
    """Return episodes in the order of the pairings, and then of the seeds."""
    return sorted(episodes, key=lambda episode: (pairings.index(episode.pairing), episode.row.seed))


def _single(config: EvaluationConfig, task: str, split: str) -> Pairing:
    policy = config.policy
    setting = setting_of(config, task=task, split=split, obs=config.obs or "state")
    canonical_task(setting)  # so that impossible axes and steps are told at once
    if policy.name == REMOTE:
        remote = reach(policy, replace(setting, obs=config.obs or "pixels"), config.workers)
        return Pairing(remote.setting, REMOTE, remote)
    if policy.name not in REFERENCE_POLICIES:
        checkpoint = _checkpoint(config, setting)
        return Pairing(checkpoint.setting, checkpoint.type, checkpoint)
    _require_no_options(policy)
    return Pairing(setting, policy.name, REFERENCE_POLICIES[policy.name])


def _staged(config: EvaluationConfig, task: str, split: str) -> Pairing:
    """Return the pairing of a task and one policy per step of it."""
    policy = config.policy
    setting = setting_of(config, task=task, split=split, obs=config.obs or "state")
    steps = [step.name for step in canonical_task(setting).steps]
    if setting.step is not None or len(steps) == 1:
        played = setting.step or steps[0]
        raise EvaluationOptionError(
            f"play={config.play} needs several steps, and of {task} only {played} is played: there "
            "is nothing to be switched. Leave play= out"
        )
    if policy.name == REMOTE:
        raise EvaluationOptionError(
            f"play={config.play} needs a policy per step, and policy.address= names one: play "
            f"step by step, with a server for each, as in step={steps[0]}"
        )
    if policy.name in REFERENCE_POLICIES:
        _require_no_options(policy)
        makers = tuple((step, reference_of_step(policy.name, step)) for step in steps)
        return Pairing(setting, policy.name, Staged(makers), STAGED)
    opened = {step: _checkpoint(config, replace(setting, step=step), True) for step in steps}
    observed = {replace(checkpoint.setting, step=None) for checkpoint in opened.values()}
    if len(observed) > 1:
        told = (f"{step}: {_observed(each.setting)}" for step, each in opened.items())
        raise EvaluationOptionError(
            f"The policies of the steps of {task} must observe the same, but they were trained on "
            f"{'; '.join(told)}. Train them alike"
        )
    kinds = "+".join(dict.fromkeys(checkpoint.type for checkpoint in opened.values()))
    return Pairing(observed.pop(), kinds, Staged(tuple(opened.items())), STAGED)


def _checkpoint(
    config: EvaluationConfig, setting: Setting, one_of_several: bool = False
) -> Checkpoint:
    policy = config.policy
    return open_checkpoint(
        policy.path or f"outputs/train/{policy.name}",
        policy.name,
        setting,
        config.obs,
        policy.device,
        policy.rename,
        one_of_several,
    )


def _observed(setting: Setting) -> str:
    """Return what a policy observes, in words."""
    if setting.obs == "state":
        return "state"
    return f"{' and '.join(setting.cameras)} at {setting.width}x{setting.height}"


def _require_no_options(policy: PolicyConfig) -> None:
    if policy != PolicyConfig(policy.name):
        raise EvaluationOptionError(
            f"policy={policy.name} takes no option of its own, such as policy.path"
        )
