"""An evaluation that was killed goes on where it was; nothing else goes on with it."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

import tiny_act
from killing import killed_at_any_moment
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.origin import origin
from labutopia_lerobot.evaluation.result_folder import OccupiedFolderError, claim
from labutopia_lerobot.evaluation.rollout import Episode, film
from labutopia_lerobot.evaluation.rows import UnreadableResultError
from labutopia_lerobot.evaluation.run import run

from .conftest import RUN, Program, Saver

COMMAND = ["task=level1/pick", "policy=expert", "obs=state", "episodes=40", "workers=2", "videos=0"]


def config(out: Path, **options: object) -> EvaluationConfig:
    chosen: dict = {"episodes": 2, "workers": 1, "videos": 0, "obs": "state"} | options
    policy = chosen.pop("policy", PolicyConfig("still"))
    return EvaluationConfig(policy=policy, task="level1/pick", out=str(out), **chosen)


def evaluate_into(out: Path, **options: object) -> dict:
    file = run(config(out, **options), Console(file=StringIO()))
    return json.loads(file.read_text())


def start(
    folder: Path, *overrides: str, interrupt: signal.Handlers = signal.SIG_DFL
) -> "subprocess.Popen[str]":
    line = [sys.executable, str(RUN), *overrides]
    return subprocess.Popen(
        line,
        cwd=folder,
        start_new_session=True,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=partial(signal.signal, signal.SIGINT, interrupt),
    )


def wait_until(condition: Callable[[], bool], seconds: float = 120.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def rows_in(out: Path) -> int:
    file = out / "rows.jsonl"
    return file.read_text().count("\n") if file.exists() else -1


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An evaluation that has one of its two rows."""
    out = tmp_path_factory.mktemp("begun") / "out"
    evaluate_into(out)
    (out / "result.json").unlink()
    first, _ = (out / "rows.jsonl").read_text().splitlines(keepends=True)
    (out / "rows.jsonl").write_text(first)
    return out


@pytest.fixture
def unfinished(begun: Path, tmp_path: Path) -> Path:
    """A copy of it, to be gone on with."""
    return Path(shutil.copytree(begun, tmp_path / "copy"))


@pytest.mark.slow
def test_killed_at_ten_random_moments_it_ends_with_the_rows_of_an_uninterrupted_run(
    evaluate_program: Program, tmp_path: Path
) -> None:
    begun = time.monotonic()
    whole = evaluate_program(*COMMAND, "out=whole")
    assert whole.returncode == 0, whole.stderr
    command = [sys.executable, str(RUN), *COMMAND, "out=killed"]
    within = time.monotonic() - begun
    for _ in killed_at_any_moment(command, times=10, within=within, folder=tmp_path):
        resumed, uninterrupted = (
            json.loads((tmp_path / name / "result.json").read_text())
            for name in ("killed", "whole")
        )
        assert resumed["rows"] == uninterrupted["rows"]
        assert [row["seed"] for row in resumed["rows"]] == list(range(100_000, 100_040))
        assert resumed["summary"] == uninterrupted["summary"]
        assert resumed["provenance"]["config"].pop("out") == "killed"
        assert uninterrupted["provenance"]["config"].pop("out") == "whole"
        assert resumed["provenance"] == uninterrupted["provenance"]
        shutil.rmtree(tmp_path / "killed")


@pytest.mark.slow
def test_interrupted_it_says_the_command_that_goes_on(tmp_path: Path) -> None:
    command = ["task=level1/pick", "policy=still", "episodes=40", "workers=1", "videos=0"]
    process = start(tmp_path, *command)
    wait_until(lambda: any(rows_in(file.parent) >= 1 for file in tmp_path.rglob("rows.jsonl")))
    os.killpg(process.pid, signal.SIGINT)
    reported = process.communicate()[1]
    assert process.returncode == 130, reported
    assert "Traceback" not in reported
    going_on = reported.partition("Go on: python ")[2].split("\n")[0].split()
    assert going_on[1:-1] == command
    (out,) = {file.parent for file in tmp_path.rglob("rows.jsonl")}
    assert tmp_path / going_on[-1].removeprefix("out=") == out


@pytest.mark.slow
def test_where_interrupts_are_ignored_it_plays_on(tmp_path: Path) -> None:
    command = ["task=level1/pick", "policy=still", "episodes=3", "workers=1", "videos=0"]
    process = start(tmp_path, *command, interrupt=signal.SIG_IGN)
    wait_until(lambda: any(rows_in(file.parent) >= 1 for file in tmp_path.rglob("rows.jsonl")))
    os.killpg(process.pid, signal.SIGINT)
    reported = process.communicate()[1]
    assert process.returncode == 0, reported


def test_only_missing_episodes_are_played(unfinished: Path) -> None:
    mark = json.loads((unfinished / "rows.jsonl").read_text()) | {"seconds": 99.0}
    (unfinished / "rows.jsonl").write_text(json.dumps(mark) + "\n")
    rows = evaluate_into(unfinished)["rows"]
    assert [row["seed"] for row in rows] == [100_000, 100_001]
    assert rows[0]["seconds"] == 99.0
    assert rows[1]["seconds"] < 99.0


@pytest.mark.slow
def test_half_a_row_is_dropped_and_played_again(unfinished: Path) -> None:
    file = unfinished / "rows.jsonl"
    whole = file.read_text()
    file.write_text(whole + whole[: len(whole) // 2])
    rows = evaluate_into(unfinished)["rows"]
    assert [json.loads(line) for line in file.read_text().splitlines()] == rows
    assert len(rows) == 2


def test_a_damaged_row_is_reported_by_its_line(unfinished: Path) -> None:
    file = unfinished / "rows.jsonl"
    file.write_text("{half\n" + file.read_text())
    with pytest.raises(UnreadableResultError, match="Line 1 of"):
        evaluate_into(unfinished)


@pytest.mark.parametrize(
    ("options", "difference"),
    [
        ({"episodes": 3}, "config.episodes: 2 there, 3 here"),
        ({"seed": 5}, "config.seed: 100000 there, 5 here"),
        ({"policy": PolicyConfig("random")}, "config.policy.name: 'still' there, 'random' here"),
        ({"robot": "iiwa"}, "config.robot: 'default' there, 'iiwa' here"),
    ],
)
def test_another_evaluation_does_not_go_on_with_it(
    begun: Path, options: dict[str, object], difference: str
) -> None:
    before = {path: path.stat().st_mtime_ns for path in begun.rglob("*")}
    with pytest.raises(OccupiedFolderError) as refusal:
        evaluate_into(begun, **options)
    assert difference in str(refusal.value)
    assert {path: path.stat().st_mtime_ns for path in begun.rglob("*")} == before


@pytest.mark.parametrize(("part", "name"), [("code", "commit"), ("versions", "scipy")])
def test_other_code_does_not_go_on_with_it(unfinished: Path, part: str, name: str) -> None:
    began = json.loads((unfinished / "evaluation.json").read_text())
    began[part][name] = "of yesterday"
    (unfinished / "evaluation.json").write_text(json.dumps(began))
    with pytest.raises(OccupiedFolderError, match=rf"{part}\.{name}: 'of yesterday' there"):
        evaluate_into(unfinished)


@pytest.mark.slow
def test_a_result_is_traced_to_its_weights_and_others_do_not_go_on_with_it(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder = save_checkpoint()
    saved = folder.parents[1] / "000700"
    folder.parent.rename(saved)
    folder.parent.symlink_to("000700")
    policy = PolicyConfig("act", str(folder.parents[2]), "cpu")
    result = evaluate_into(tmp_path / "out", policy=policy)
    reported = result["provenance"]["checkpoints"]["level1/pick"]
    assert (reported["folder"], reported["step"]) == (str(saved / "pretrained_model"), 700)
    assert {"model.safetensors", "config.json"} <= reported["sha256"].keys()
    assert result["provenance"]["device"] == "cpu"

    (tmp_path / "out" / "result.json").unlink()
    shutil.copytree(saved, saved.with_name("000800"))
    folder.parent.unlink()
    folder.parent.symlink_to("000800")
    with pytest.raises(OccupiedFolderError, match=r"level1/pick\.step: 700 there, 800 here"):
        evaluate_into(tmp_path / "out", policy=policy)


def test_weights_that_training_overwrote_do_not_go_on(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder = save_checkpoint()
    options = config(tmp_path, policy=PolicyConfig("act", str(folder), "cpu"))
    began = origin(options, make_jobs(options))
    with claim(tmp_path / "out", began):
        pass
    tiny_act.change(folder)
    refused = pytest.raises(OccupiedFolderError, match=r"sha256\.model\.safetensors")
    with refused, claim(tmp_path / "out", origin(options, make_jobs(options))):
        pass


def test_a_folder_in_use_is_refused(unfinished: Path) -> None:
    options = config(unfinished)
    refused = pytest.raises(OccupiedFolderError, match="in use by another process")
    with claim(unfinished, origin(options, make_jobs(options))), refused:
        evaluate_into(unfinished)


def test_rows_of_nobody_knows_what_are_refused(tmp_path: Path) -> None:
    (tmp_path / "rows.jsonl").write_text("{}\n")
    with pytest.raises(OccupiedFolderError, match="already holds a result"):
        evaluate_into(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["rows.jsonl"]


@pytest.mark.slow
def test_the_actions_of_an_earlier_run_are_kept_and_filmed(
    unfinished: Path, tmp_path: Path
) -> None:
    options = config(unfinished)
    (job,) = make_jobs(options)
    with claim(unfinished, origin(options, [job])) as folder:
        ((row,), (actions,)) = folder.rows, folder.actions()
    assert actions.shape == (row.steps, 8)
    film(Episode(job, row, actions), tmp_path / "film.mp4")
    assert (tmp_path / "film.mp4").stat().st_size > 1000


def test_rows_without_their_actions_are_reported(unfinished: Path) -> None:
    (unfinished / "actions.jsonl").unlink()
    with pytest.raises(UnreadableResultError, match=r"actions\.jsonl lacks actions of a row"):
        evaluate_into(unfinished)
