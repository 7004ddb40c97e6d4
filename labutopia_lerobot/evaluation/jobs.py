"""Jobs of an evaluation: one per task, split and way of playing."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial

from labutopia_lerobot.chemistry.kept_answers import reasoner_label
from labutopia_lerobot.evaluation.checkpoint import Checkpoint, open_checkpoint, trained_on
from labutopia_lerobot.evaluation.condition import SINGLE, STAGED, Condition
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.policies import (
    REFERENCE_POLICIES,
    PolicyMaker,
    StagedPolicyMaker,
    reference_of_step,
)
from labutopia_lerobot.evaluation.remote.remote_policy import REMOTE, open_server
from labutopia_lerobot.features import observation_features
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenes import room_label
from labutopia_lerobot.setting import Setting, setting_of


@dataclass(frozen=True)
class EvaluationJob:
    """One policy in one setting: whatever an episode depends on beside its seed.

    Attributes:
        setting: Task, robot, observation and the other options.
        policy: What the policy is called.
        make_policy: Makes it.
        play: How it plays the steps, `single` or `staged`.
    """

    setting: Setting
    policy: str
    make_policy: PolicyMaker
    play: str = SINGLE

    @cached_property
    def condition(self) -> Condition:
        """Under which condition its episodes are played."""
        setting = self.setting
        return Condition(
            task=setting.task,
            split=setting.split,
            axes=setting.axes,
            play=self.play,
            step=setting.step,
            liquid=setting.liquid if _holds_liquid(setting) else None,
            particles=setting.particles,
            reasoner=reasoner_label(setting.reasoner),
            robot=setting.robot,
            room=room_label(setting.room),
            obs=setting.obs,
            renderer=setting.renderer,
            odometry=setting.odometry,
        )


def make_jobs(config: EvaluationConfig) -> list[EvaluationJob]:
    """Return what an evaluation plays, ordered by task, split and way of playing.

    Raises:
        CheckpointError: If a checkpoint is missing, or cannot play its task.
        EvaluationOptionError: If options contradict each other.
        TaskError: If a task does not have the step that is to be played.
        UnknownOptionError: If a task does not have what is to be observed, or hidden.
        UnknownTaskError: If no task is named, or one that does not exist.
    """
    jobs = [
        _staged(config, task, split) if play == STAGED else _single(config, task, split)
        for task in config.tasks
        for split in config.splits
        for play in config.plays
    ]
    for job in jobs:
        observation_features(job.setting, partial(canonical_task, job.setting))
    return jobs


def trained_elsewhere(jobs: Iterable[EvaluationJob]) -> Iterator[str]:
    """Yield a sentence for each job whose policy was trained on other tasks than it plays."""
    for job in jobs:
        tasks = (
            trained_on(job.make_policy.folder) if isinstance(job.make_policy, Checkpoint) else ()
        )
        played = job.setting.task
        if tasks and played.rpartition("/")[2] not in {task.rpartition("/")[2] for task in tasks}:
            yield f"{played}: the policy was trained on {' and '.join(tasks)}"


def _single(config: EvaluationConfig, task: str, split: str) -> EvaluationJob:
    policy = config.policy
    setting = setting_of(config, task=task, split=split, obs=config.obs or "state")
    canonical_task(setting)  # so that impossible axes and steps are reported at once
    if policy.name == REMOTE:
        remote = open_server(policy, replace(setting, obs=config.obs or "pixels"), config.workers)
        return EvaluationJob(remote.setting, REMOTE, remote)
    if policy.name not in REFERENCE_POLICIES:
        checkpoint = _checkpoint(config, setting)
        return EvaluationJob(checkpoint.setting, checkpoint.type, checkpoint)
    _require_no_options(policy)
    return EvaluationJob(setting, policy.name, REFERENCE_POLICIES[policy.name])


def _staged(config: EvaluationConfig, task: str, split: str) -> EvaluationJob:
    """Return the job of a task and one policy per step of it."""
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
        return EvaluationJob(setting, policy.name, StagedPolicyMaker(makers), STAGED)
    opened = {step: _checkpoint(config, replace(setting, step=step), True) for step in steps}
    observed = {replace(checkpoint.setting, step=None) for checkpoint in opened.values()}
    if len(observed) > 1:
        observations = (f"{step}: {_observed(each.setting)}" for step, each in opened.items())
        raise EvaluationOptionError(
            f"The policies of the steps of {task} must observe the same, but they were trained on "
            f"{'; '.join(observations)}. Train them alike"
        )
    kinds = "+".join(dict.fromkeys(checkpoint.type for checkpoint in opened.values()))
    return EvaluationJob(observed.pop(), kinds, StagedPolicyMaker(tuple(opened.items())), STAGED)


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


@lru_cache(maxsize=1)
def _holds_liquid(setting: Setting) -> bool:
    """Return whether the vessels of the task hold something, also where it is left out."""
    return bool(canonical_task(replace(setting, liquid="on")).contents)
