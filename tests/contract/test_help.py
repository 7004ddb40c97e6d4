"""`--help` of every program lists every option; what takes long says what it is doing."""

import re
import subprocess
import sys
from dataclasses import fields
from importlib import import_module
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from labutopia_lerobot.cli import bench, experiment, record, replay, speed
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import ABOUT
from labutopia_lerobot.cli.recording_bars import RecordingBars
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.experiments.experiment import ExperimentConfig
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.runtime import bars
from labutopia_lerobot.setting import option_help

ROOT = Path(__file__).parents[2]


def evaluate(*arguments: str) -> "subprocess.CompletedProcess[str]":
    program = [sys.executable, str(ROOT / "eval" / "run.py"), *arguments]
    return subprocess.run(program, capture_output=True, text=True, check=False)


def entries(text: str) -> dict[str, str]:
    """Return the options that a help lists, each with its explanation."""
    found = re.findall(r"^  ([\w.]+)=\S*\s+(\S.*(?:\n {24}\S.*)*)$", text, re.MULTILINE)
    return {name: " ".join(explained.split()) for name, explained in found}


def test_help_of_the_evaluator_explains_every_option_and_lists_the_policies():
    done = evaluate("--help")
    assert done.returncode == 0, done.stderr
    assert ABOUT in done.stdout
    listed = entries(done.stdout)
    names = {option.name for option in fields(EvaluationConfig)} - {"policy"}
    assert set(listed) == names | {f"policy.{option.name}" for option in fields(PolicyConfig)}
    assert all(
        listed[name] == text
        for name, text in option_help(EvaluationConfig).items()
        if name in names
    )
    assert (
        "Policies: act, diffusion, expert, lerobot, mlp, pi0, random, remote, smolvla, still"
        in done.stdout
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "reported"),
    [(["policy=actt"], "policy=actt is unknown. Did you mean 'act'?"), ([], "Name a policy")],
)
def test_a_policy_that_is_none_is_reported_with_the_choices(arguments, reported):
    done = evaluate("task=level1/pick", *arguments)
    assert done.returncode == 2
    assert reported in done.stderr
    assert "Policies: act, diffusion, expert" in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_help_of_the_recorder_explains_every_option(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["labutopia-record", "--help"])
    record.main()
    shown = capsys.readouterr().out
    assert entries(shown) == {
        option.name: option_help(RecordingConfig)[option.name] for option in fields(RecordingConfig)
    }
    assert max(map(len, shown.splitlines())) <= 90


def test_help_of_the_recorder_lists_every_task_by_its_level(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["labutopia-record", "--help"])
    record.main()
    shown = " ".join(capsys.readouterr().out.partition("Tasks of the paper:")[2].split())
    listed = re.findall(r"(level\d)/ (.*?)(?= level\d/| Tasks|$)", shown)
    tasks = [f"{level}/{name}" for level, names in listed for name in names.split(", ")]
    assert tasks == list(task_files())


def test_help_of_the_experiments_explains_every_option(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["labutopia-experiment", "--help"])
    experiment.main()
    listed = entries(capsys.readouterr().out)
    assert set(listed) == {option.name for option in fields(ExperimentConfig)}
    assert all(listed[name] == text for name, text in option_help(ExperimentConfig).items())


@pytest.mark.parametrize(
    ("program", "options"),
    [
        ("verify", ["dataset"]),
        ("convert", ["source", "out", "--repo-id", "--instruction"]),
        ("cut", ["dataset", "--step", "--out", "--tasks-dir"]),
        ("render", ["dataset", "out", "--cameras", "--width", "--height"]),
        ("replay", ["dataset", "--episode", "--out", "--cameras", "--episodes"]),
        ("publish", ["what", "--repo-id", "--results", "--private", "--replace", "--dry-run"]),
        ("bench", ["tasks", "--json", "--seconds", "--episodes"]),
        ("check", ["folder", "--task"]),
        ("compare", ["first", "second", "--tables", "--json"]),
        (
            "film",
            ["task", "--out", "--seed", "--camera", "--exposures", "--fps", "--speed", "--room"],
        ),
        ("doctor", ["--json"]),
        ("recipe", ["policy", "DATASET", "--epochs", "--batch-size", "--out"]),
        ("report", ["DIR", "--tables", "--out"]),
        ("scene", ["  list", "  generate", "  check", "  export"]),
        (
            "view",
            ["task", "--seed", "--out", "--headless", "--web", "--port", "--width", "--robot"],
        ),
    ],
)
def test_help_of_the_other_programs_explains_every_option(monkeypatch, capsys, program, options):
    monkeypatch.setattr(sys, "argv", [f"labutopia-{program}", "--help"])
    monkeypatch.setenv("COLUMNS", "200")
    with pytest.raises(SystemExit, match="0"):
        import_module(f"labutopia_lerobot.cli.{program}").main()
    reported = capsys.readouterr().out
    assert ABOUT in reported
    for option in options:
        assert re.search(rf"^  {option}\b.* \S+", reported, re.MULTILINE), option


def test_replaying_no_episode_is_a_mistake(monkeypatch, capsys, tmp_path):
    (tmp_path / "meta").mkdir()
    monkeypatch.setattr(sys, "argv", ["labutopia-replay", str(tmp_path), "--episodes", "0"])
    with pytest.raises(SystemExit, match="2"):
        replay.main()
    assert "--episodes 0 is too small: at least 1" in capsys.readouterr().err


def test_the_benchmark_announces_every_measurement_before_it_begins(monkeypatch, capsys):
    for measurement in ("_fps", "_solver_speed", "_record", "renderer_name"):
        monkeypatch.setattr(speed, measurement, lambda *arguments: 1)
    monkeypatch.setattr(sys, "argv", ["labutopia-bench", "level1/pick", "--json"])
    bench.main()
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[0] for line in lines] == [f"Measuring {n}/9" for n in range(1, 10)]
    assert lines[-1] == "Measuring 9/9: demonstrations per hour of level1/pick ..."


def test_in_a_terminal_what_is_going_on_vanishes_when_it_is_over():
    terminal = Console(force_terminal=True, file=StringIO())
    with doing(terminal, "Playing"):
        pass
    drawn = terminal.file.getvalue()  # type: ignore[attr-defined]
    assert "Playing" in drawn
    assert drawn.endswith("\x1b[2K")  # the line is erased


def test_a_recording_writes_lines_into_a_log_file(monkeypatch):
    monkeypatch.setattr(bars, "_LOG_S", 0.0)
    log = Console(file=StringIO())
    shown = RecordingBars(3, log)
    shown.resumed([])
    what = (
        "level1/pick",
        0,
        0,
        "success",
        "",
        90,
        "machine",
        "",
        {},
        {},
        "Pick it up.",
        (),
        (),
        None,
    )
    shown.played(Candidate(*what))
    assert log.file.getvalue().startswith("Playing 1/3, ")  # type: ignore[attr-defined]
    assert "0 failed" in log.file.getvalue()  # type: ignore[attr-defined]
