"""One policy per step: it takes over where the step before is done, and is scored as any other."""

import json
import shutil
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

import tiny_act
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.checkpoint_security import CheckpointError
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.origin import origin
from labutopia_lerobot.evaluation.policies import ExpertOfStep, StagedPolicyMaker, StillPolicy
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import conditional_rates, level_tables
from labutopia_lerobot.evaluation.result_folder import (
    ACTIONS,
    OccupiedFolderError,
    claim,
    key_in_run,
    read_actions,
)
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.evaluation.submission import Submission, replayed
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.task import TaskError

from .conftest import Saver

DRAWER = "level2/operate_drawer"


def config(out: Path = Path(), **options: object) -> EvaluationConfig:
    chosen: dict = {"task": DRAWER, "obs": "state", "episodes": 2, "workers": 1, "videos": 0}
    chosen |= {"policy": PolicyConfig("expert"), "out": str(out)} | options
    return EvaluationConfig(**chosen)


def evaluated(out: Path, **options: object) -> tuple[dict, str]:
    reported = StringIO()
    file = run(config(out, **options), Console(file=reported, width=160))
    assert file is not None
    return json.loads(file.read_text()), reported.getvalue()


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict, str]:
    """The expert and a drawer, in both ways, by one process."""
    out = tmp_path_factory.mktemp("both") / "out"
    return out, *evaluated(out, play="both")


def test_the_expert_scores_staged_as_single_seed_by_seed(both: tuple[Path, dict, str]) -> None:
    rows = both[1]["rows"]
    assert [(row["play"], row["seed"], row["success"]) for row in rows] == [
        (play, seed, True) for play in ("single", "staged") for seed in (100_000, 100_001)
    ]
    assert [line["play"] for line in both[1]["summary"]] == ["single", "staged"]


@pytest.mark.slow
def test_rows_of_both_ways_do_not_depend_on_the_workers(
    both: tuple[Path, dict, str], tmp_path: Path
) -> None:
    assert evaluated(tmp_path, play="both", workers=2)[0]["rows"] == both[1]["rows"]


def test_the_steps_stand_in_the_tables_and_in_the_terminal(both: tuple[Path, dict, str]) -> None:
    found = report_entries(load_results(both[0]))
    assert [entry.condition.played for entry in found] == ["ID", "ID, staged"]
    single, by_step = level_tables(found)
    assert len(single.lines) == 1
    assert by_step.head == ("Policy", "Played", "SP", "1 open", "2 close")
    assert [line[1] for line in by_step.lines] == [
        *("S", "S given the one before", "A", "A given the one before"),
    ]
    reported = both[2].splitlines()
    (heading,) = (line for line in reported if line.startswith("operate_drawer: 2/2 [34, 100], "))
    assert "; staged 2/2 [34, 100], " in heading
    start = reported.index(heading)
    assert [line.split() for line in reported[start + 1 : start + 4]] == [
        ["SP", "1", "open", "2", "close"],
        ["S", "100.0", "100.0", "100.0"],
        ["A", "100.0", "100.0"],
    ]
    assert all(rate is not None and rate.percent == 100.0 for rate in conditional_rates(found[1]))


@pytest.mark.slow
def test_killed_between_the_ways_it_goes_on_with_what_is_missing(
    both: tuple[Path, dict, str], tmp_path: Path
) -> None:
    out = Path(shutil.copytree(both[0], tmp_path / "out"))
    (out / "result.json").unlink()
    *_, third, _ = (out / "rows.jsonl").read_text().splitlines(keepends=True)
    mark = json.loads(third) | {"seconds": 99.0}
    (out / "rows.jsonl").write_text(json.dumps(mark) + "\n")
    rows = evaluated(out, play="both")[0]["rows"]
    assert [row["play"] for row in rows] == ["single", "single", "staged", "staged"]
    assert [row["seconds"] == 99.0 for row in rows] == [False, False, True, False]
    (out / "result.json").unlink()
    with pytest.raises(OccupiedFolderError, match="play: 'both' there, 'staged' here"):
        evaluated(out, play="staged")


def test_episodes_of_both_ways_are_played_again_from_their_actions(
    both: tuple[Path, dict, str],
) -> None:
    (result,) = load_results(both[0])
    kept = read_actions(both[0] / ACTIONS)
    submission = Submission(result, [kept[key_in_run(row)] for row in result.rows])
    assert [wrong for _, wrong in replayed(submission, [1, 3])] == [[], []]


def test_a_step_alone_begins_in_the_very_state_in_which_its_policy_takes_over() -> None:
    (job,) = make_jobs(config(play="staged"))
    env, policy = LabEnv(job.setting), job.make_policy()
    observation, _ = env.reset(seed=7)
    policy.start(env, 7)
    while (step := env.workcell.progress.step) is not None and step.name == "open":
        observation, *_ = env.step(policy.act(observation))
    alone, _ = LabEnv(Setting(DRAWER, obs="state", step="close")).reset(seed=7)
    for key, values in observation.items():
        np.testing.assert_array_equal(alone[key], values)


@pytest.mark.slow
def test_a_step_alone_is_counted_by_itself(tmp_path: Path) -> None:
    rows = evaluated(tmp_path / "open", step="open", episodes=1)[0]["rows"]
    rows += evaluated(tmp_path / "close", step="close", episodes=1)[0]["rows"]
    assert [(row["step"], row["success"], row["play"]) for row in rows] == [
        ("open", True, "single"),
        ("close", True, "single"),
    ]
    assert list(rows[0]["substeps"]) == ["gripped", "opened", "released"]
    assert rows[1]["step_times"].keys() == {"close"}
    (table,) = level_tables(report_entries(load_results(tmp_path)))
    assert table.title == "Steps played alone"
    assert [line[3] for line in table.lines] == ["close", "open"]


def test_each_step_is_played_by_its_own_policy() -> None:
    (job,) = make_jobs(config(play="staged"))
    only_open = StagedPolicyMaker((("open", ExpertOfStep("open")), ("close", StillPolicy)))
    row = play(replace(job, make_policy=only_open), 100_000).row
    assert row.step_times["open"] is not None
    assert (row.outcome, row.step_times["close"]) == ("timeout", None)


def test_who_opens_nothing_comes_to_no_second_step() -> None:
    (job,) = make_jobs(config(policy=PolicyConfig("random"), play="staged"))
    row = play(job, 100_000).row
    assert (row.play, row.success, row.step_times["close"]) == ("staged", False, None)


def test_what_cannot_be_staged_is_reported() -> None:
    for options, reported in (
        ({"task": "level1/pick"}, "of level1/pick only pick is played"),
        ({"step": "open"}, "only open is played"),
        ({"policy": PolicyConfig("remote")}, "needs a policy per step"),
    ):
        with pytest.raises(EvaluationOptionError, match=reported):
            make_jobs(config(**({"play": "staged"} | options)))
    with pytest.raises(TaskError, match=r"no step 'shut'\. Steps of this task: open, close"):
        make_jobs(config(step="shut"))
    with pytest.raises(UnknownOptionError, match="single, staged, both"):
        config(play="step by step").check()


def learned(folder: Path, **options: object) -> EvaluationConfig:
    policy = PolicyConfig("act", str(folder), "cpu")
    return config(**({"policy": policy, "play": "staged", "obs": None} | options))


def pixels(save_checkpoint: Saver, tmp_path: Path, **cameras: tuple[str, ...]) -> Path:
    """Return a folder with a tiny ACT per step, each with its own cameras."""
    for step, seen in cameras.items():
        shutil.copytree(save_checkpoint(cameras=seen), tmp_path / "act" / DRAWER / step)
    return tmp_path / "act"


def test_a_policy_per_step_is_found_below_its_task_and_traced_to_its_weights(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder = pixels(save_checkpoint, tmp_path, open=("front",), close=("front",))
    shutil.copytree(folder / DRAWER / "open", folder / DRAWER, dirs_exist_ok=True)
    options = learned(folder, play="both")
    single, staged = make_jobs(options)
    assert (single.policy, staged.policy) == ("act", "act")
    assert single.setting == staged.setting
    began = origin(options, [single, staged])
    assert [(name, each["folder"]) for name, each in began["checkpoints"].items()] == [
        (DRAWER, str(folder / DRAWER)),
        (f"{DRAWER}/open", str(folder / DRAWER / "open")),
        (f"{DRAWER}/close", str(folder / DRAWER / "close")),
    ]
    with claim(tmp_path / "out", began):
        pass
    tiny_act.change(folder / DRAWER / "close")
    other = origin(options, make_jobs(options))
    refused = pytest.raises(OccupiedFolderError, match=r"operate_drawer/close\.sha256\.model")
    with refused, claim(tmp_path / "out", other):
        pass


def test_weights_per_step_are_loaded_and_play(save_checkpoint: Saver, tmp_path: Path) -> None:
    folder = pixels(save_checkpoint, tmp_path, open=("front",), close=("front",))
    (job,) = make_jobs(learned(folder))
    env, policy = LabEnv(job.setting), job.make_policy()
    observation, _ = env.reset(seed=7)
    policy.start(env, 7)
    assert policy.act(observation).shape == (8,)
    assert policy.device == "cpu"  # type: ignore[attr-defined]
    env.close()


def test_a_step_without_its_checkpoint_is_named_with_the_commands_that_make_it(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder = pixels(save_checkpoint, tmp_path, open=("front",))
    for given in (folder, folder / DRAWER):
        with pytest.raises(CheckpointError) as refusal:
            make_jobs(learned(given))
        assert f"No checkpoint for {DRAWER} step=close" in str(refusal.value)
        assert f"labutopia-record task={DRAWER}\n" in str(refusal.value)
        assert f"labutopia-cut outputs/datasets/{DRAWER} --step=close\n" in str(refusal.value)
        recipe = f"$(labutopia-recipe act outputs/datasets/{DRAWER}-close --epochs 200 --out "
        assert recipe in str(refusal.value)
    # One policy for everything is none per step, however often it could be loaded.
    with pytest.raises(CheckpointError, match="step=open"):
        make_jobs(learned(folder / DRAWER / "open"))
    (alone,) = make_jobs(learned(folder / DRAWER / "open", play="single", step="open"))
    assert alone.setting.step == "open"


def test_policies_that_observe_otherwise_cannot_take_over_from_each_other(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder = pixels(save_checkpoint, tmp_path, open=("front",), close=("top",))
    with pytest.raises(EvaluationOptionError, match="open: front at 64x64; close: top at 64x64"):
        make_jobs(learned(folder))
