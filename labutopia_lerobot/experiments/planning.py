"""From an experiment to its parts, in the order in which they are done."""

from collections.abc import Iterator, Sequence
from itertools import product

from labutopia_lerobot.evaluation.condition import REFERENCES, SINGLE, STAGED
from labutopia_lerobot.experiments.experiment import Experiment
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart
from labutopia_lerobot.experiments.parts.recording_part import RecordingPart
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.study import ExperimentOptionError, Shift, Study
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

type _Trainings = tuple[TrainingPart, ...]


def parts_of(experiment: Experiment) -> list[ExperimentPart]:
    """Return every part once: study by study, policy by policy, task by task.

    Each task is recorded, verified, trained and evaluated before the next is begun, so that what is
    there at any moment is whole lines of the tables.

    Raises:
        ExperimentOptionError: If studies make different things under one name.
    """
    parts: dict[str, ExperimentPart] = {}
    for study in experiment.studies:
        for part in _parts_of_study(experiment, study):
            if parts.setdefault(part.name, part) != part:
                raise ExperimentOptionError(
                    f"Two studies of {experiment.name} make '{part.name}' differently: give one of "
                    "them a label="
                )
    return list(parts.values())


def check(parts: Sequence[ExperimentPart]) -> None:
    """Check every part before anything is done.

    Raises:
        UserError: If one cannot be done; the message says which and why.
    """
    for part in parts:
        try:
            part.check()
        except Exception as error:
            error.add_note(f"(in: {part.name})")
            raise


def evaluations(parts: Sequence[ExperimentPart]) -> list[EvaluationPart]:
    """Return those parts that are evaluations."""
    return [part for part in parts if isinstance(part, EvaluationPart)]


def _parts_of_study(experiment: Experiment, study: Study) -> Iterator[ExperimentPart]:
    tasks = [task for task in study.tasks if not experiment.only or task in experiment.only]
    for policy, task in product(study.policies, tasks):
        if policy in REFERENCES:
            yield from _reference(experiment, study, policy, task)
            continue
        repeats = range(study.trainings)
        for count, play, repeat in product(study.demonstrations, study.plays, repeats):
            steps = _steps(study, task) if play == STAGED else [None]
            trainings = tuple(
                _training(experiment, study, policy, task, step, count, repeat) for step in steps
            )
            for training in trainings:
                yield from (*training.needs, training)
            yield from _learned(experiment, study, policy, task, play, trainings)


def _learned(
    experiment: Experiment, study: Study, policy: str, task: str, play: str, trainings: _Trainings
) -> Iterator[ExperimentPart]:
    along = study.evaluate_at if play == SINGLE and not trainings[0].repeat else ()
    first = study.shifts[0]  # success over steps needs one condition
    for at in along:
        if at != trainings[0].steps:
            yield _evaluation(experiment, study, policy, task, first, play, trainings, at)
    for shift in study.shifts:
        yield _evaluation(experiment, study, policy, task, shift, play, trainings, None)


def _reference(
    experiment: Experiment, study: Study, policy: str, task: str
) -> Iterator[ExperimentPart]:
    for play, shift in product(study.plays, study.shifts):
        yield _evaluation(experiment, study, policy, task, shift, play, (), None)


def _training(
    experiment: Experiment,
    study: Study,
    policy: str,
    task: str,
    step: str | None,
    count: int,
    repeat: int,
) -> TrainingPart:
    out = experiment.out
    chosen = dict(study.options)
    alone = chosen.pop("step", None)
    chosen |= {} if study.pace == 1.0 else {"pace": study.pace}
    recording = RecordingPart(
        out, task, alone, count, study.obs, tuple(chosen.items()), experiment.workers
    )
    label = study.label_of(policy)
    return TrainingPart(
        out=out,
        recording=recording,
        step=step,
        policy=policy,
        label=label,
        budget=study.budget,
        repeat=repeat,
        evaluate_at=study.evaluate_at,
        device=experiment.device,
    )


def _evaluation(
    experiment: Experiment,
    study: Study,
    policy: str,
    task: str,
    shift: Shift,
    play: str,
    trainings: _Trainings,
    at: int | None,
) -> EvaluationPart:
    return EvaluationPart(
        out=experiment.out,
        policy=policy,
        label=study.label_of(policy),
        control=study.control,
        task=task,
        shift=shift,
        play=play,
        trainings=trainings,
        at=at,
        episodes=study.episodes,
        obs=study.obs,
        options=study.options,
        workers=experiment.workers,
        device=experiment.device,
        videos=experiment.videos,
    )


def _steps(study: Study, task: str) -> list[str]:
    """Return the names of the steps of a task."""
    tasks_dir = dict(study.options).get("tasks_dir")
    setting = Setting(task, obs=study.obs, tasks_dir=tasks_dir)
    return [step.name for step in canonical_task(setting).steps]
