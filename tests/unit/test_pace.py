"""Demonstrations may be slower than the expert's usual ones."""

import pytest

from labutopia_lerobot.cli.experiment import parse
from labutopia_lerobot.datasets.demonstration import Demonstration, demonstrate
from labutopia_lerobot.datasets.recording_config import RecordingConfig, RecordingOptionError
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.experiments.planning import evaluations, parts_of
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import SUCCESS

PACE = 0.6
SEED = 3


def played(pace: float) -> Demonstration:
    env = LabEnv(Setting("level1/press", obs="state"))
    return demonstrate(env, SEED, lambda pictures: None, pace)


def test_at_a_slower_pace_the_expert_does_the_same_in_more_time():
    usual, slow = played(1.0), played(PACE)
    assert usual.outcome == slow.outcome == SUCCESS
    assert 1.2 < slow.frames / usual.frames < 1.0 / PACE  # what it holds for, it holds as long


def test_the_pace_is_of_the_recording_and_not_of_the_evaluation(tmp_path):
    words = ("policy=act", "level1/press", "obs=state", f"pace={PACE}", f"out={tmp_path}")
    parts = parts_of(parse(words))
    (evaluation,) = evaluations(parts)
    assert f"pace={PACE}" in parts[0].command()
    assert not any(word.startswith("pace=") for word in evaluation.command())
    assert parts[0].config.provenance["config"]["pace"] == PACE


@pytest.mark.parametrize("pace", [0.0, 0.1, 1.5])
def test_an_impossible_pace_is_refused(pace):
    (config,) = RecordingConfig(task="level1/press", obs="state", pace=pace).datasets()
    with pytest.raises(RecordingOptionError, match=f"pace={pace} is impossible"):
        config.check()
