"""`labutopia-chem ask` and `reasoner=FILE.json`: a language model decides what reacts in a task."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from labutopia_lerobot.chemistry import kept_answers
from labutopia_lerobot.chemistry.kept_answers import (
    KeptAnswer,
    KeptAnswers,
    KeptAnswersError,
    read,
    reasoner_label,
    write,
)
from labutopia_lerobot.cli import chem, publish, verify
from labutopia_lerobot.cli.evaluate import parse as evaluated
from labutopia_lerobot.datasets.description import read_recording
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.origin import origin
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.setting import SPLITS, Setting
from loopback_model import LoopbackModel, says
from recordings import recording
from typed_commands import typed

TASK = "level2/neutralise"
NOTHING = json.dumps({"reactions": []})
LIFT_BASE = """
from dataclasses import replace
from labutopia_lerobot.tasks.level2.beyond.neutralise import neutralise

def lift_base(draw):
    task = neutralise(draw)
    pick, *_ = task.steps
    return replace(task, steps=(pick,), goal=pick.substeps[-1].when, time_limit_s=10.0)
"""
"""The beginning of that task, which takes seconds."""

type Command = Callable[..., tuple[int, str, str]]


@pytest.fixture
def ask(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> Command:
    """Type a command; returns its exit status, output and errors."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_OFFLINE", False)
    return typed("labutopia-chem", chem.main, monkeypatch, capsys)


@pytest.fixture(scope="module")
def lift_base(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Words that name the short task."""
    folder = tmp_path_factory.mktemp("tasks")
    (folder / "level1").mkdir()
    (folder / "level1" / "lift_base.py").write_text(LIFT_BASE)
    return ["task=level1/lift_base", f"tasks_dir={folder}", "obs=state", "particles=100"]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model that says of every question that nothing reacts."""
    kept = KeptAnswers("stand-in")
    for split in SPLITS:
        for seed in range(40):
            contents = draw_scenario(Setting(TASK, split=split), seed).task.contents
            new = kept.unanswered([filling.compounds for filling in contents.values()])
            kept = KeptAnswers("stand-in", (*kept.answers, *map(KeptAnswer, new)))
    path = tmp_path_factory.mktemp("answers") / "mine.json"
    write(kept, path)
    return path


def test_every_question_of_a_task_is_asked_once_and_no_other_model_s_answers_are_mixed_in(
    ask: Command, tmp_path: Path
) -> None:
    out = tmp_path / "answers.json"
    with LoopbackModel(says("no JSON"), says("no JSON"), says(NOTHING)) as server:
        words = ("ask", TASK, "--out", str(out), "--base-url", server.address)
        status, text, _ = ask(*words, "--model", "m")
        asked = len(server.requests)
        again, _, _ = ask(*words, "--model", "m")
        assert len(server.requests) == asked
        other, _, why = ask(*words, "--model", "n")
    assert (status, again, other) == (0, 0, 2)
    assert "By the rules: " in text  # the first question, and its repair, were answered badly
    assert "nothing reacts" in text
    kept = read(out)
    assert kept.model == "m"
    assert len(kept.answers) == asked - 1
    assert sum(bool(one.failed) for one in kept.answers) == 1
    assert "holds answers of m, not of n" in " ".join(why.split())


def test_an_episode_and_its_row_say_who_decided(file: Path, lift_base: list[str]) -> None:
    config = evaluated([*lift_base, "policy=still", f"reasoner={file}"])
    (job,) = make_jobs(config)
    label = reasoner_label(str(file))
    assert job.condition.reasoner == label
    assert f"reasoner={label}" in job.condition.marks()
    assert origin(config, [job])["config"]["reasoner"] == label
    row = play(job, 0).row
    assert row.reasoner == row.condition.reasoner == label
    assert row.unreacted == []


def test_a_dataset_is_verified_with_the_file_and_not_published(
    file: Path,
    lift_base: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = [*lift_base, "episodes=1", f"reasoner={file}"]
    root = recording(tmp_path / "dataset", *words)
    label = reasoner_label(str(file))
    assert read_recording(root)["config"]["reasoner"] == label
    monkeypatch.setattr(kept_answers, "_read", {})
    kept_answers._label.cache_clear()
    verifying = ["labutopia-verify", str(root), "--workers", "1", lift_base[1]]
    typed_line(monkeypatch, *verifying)
    with pytest.raises(SystemExit, match="1"):
        verify.main()
    assert "--reasoner FILE.json" in " ".join(capsys.readouterr().out.split())
    typed_line(monkeypatch, *verifying, f"reasoner={file}")
    verify.main()
    assert "is intact" in capsys.readouterr().out
    typed_line(monkeypatch, "labutopia-publish", str(root), "repo_id=me/it", "dry_run=true")
    with pytest.raises(SystemExit, match="2"):
        publish.main()
    assert f"was recorded with answers of your own, {label}" in capsys.readouterr().err


def typed_line(monkeypatch: pytest.MonkeyPatch, *words: str) -> None:
    """Let a program find a command line."""
    monkeypatch.setattr("sys.argv", list(words))


def test_what_cannot_decide_is_refused_when_a_task_is_loaded(file: Path, tmp_path: Path) -> None:
    for reasoner, task, why in (
        ("llm", TASK, "labutopia-chem ask TASK"),
        (str(tmp_path / "none.json"), TASK, "cannot be read"),
        (str(file), "level1/pick", "nothing is dissolved in level1/pick"),
        (str(file), "level3/precipitate", "labutopia-chem ask level3/precipitate"),
    ):
        with pytest.raises(KeptAnswersError, match=why):
            LabEnv(Setting(task, obs="state", reasoner=reasoner))
