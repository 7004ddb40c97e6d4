"""The same parts in small: a few minutes measure rates that nobody knows yet."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from labutopia_lerobot.experiments.parts.cutting_part import CuttingPart
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart
from labutopia_lerobot.experiments.parts.recording_part import RecordingPart, VerificationPart
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.rates import Rates

FOLDER = "warm_up"
"""Where it is done, in the folder of the experiment."""

_DEMONSTRATIONS = 3
_STEPS = 20
_EPISODES = 3


def warm_up(pending: Sequence[ExperimentPart], rates: Rates, out: Path) -> list[ExperimentPart]:
    """Return small parts that measure every rate that is needed and not known, in order.

    Args:
        pending: Parts that are to be done.
        rates: Rates that are known.
        out: Folder of the experiment.
    """
    first: dict[str, ExperimentPart] = {}
    for part in pending:
        if not rates.knows(part):
            first.setdefault(part.rate_key, part)
    return list(dict.fromkeys(p for part in first.values() for p in _with_needs(_small(part, out))))


def _small(part: ExperimentPart, out: Path) -> ExperimentPart:
    match part:
        case RecordingPart():
            return _recording(part, out)
        case VerificationPart() | CuttingPart():
            return replace(part, out=out / FOLDER, recording=_recording(part.recording, out))
        case TrainingPart():
            return _training(part, out)
        case EvaluationPart():
            trained = tuple(_training(training, out) for training in part.trainings)
            return replace(
                part, out=out / FOLDER, trainings=trained, at=None, episodes=_EPISODES, videos=0
            )
    raise TypeError(f"no part of an experiment: {part!r}")


def _recording(part: RecordingPart, out: Path) -> RecordingPart:
    return replace(part, out=out / FOLDER, demonstrations=_DEMONSTRATIONS)


def _training(part: TrainingPart, out: Path) -> TrainingPart:
    return replace(
        part,
        out=out / FOLDER,
        recording=_recording(part.recording, out),
        budget=replace(part.budget, steps=_STEPS, epochs=None),
        evaluate_at=(),
    )


def _with_needs(part: ExperimentPart) -> list[ExperimentPart]:
    return [*(each for need in part.needs for each in _with_needs(need)), part]
