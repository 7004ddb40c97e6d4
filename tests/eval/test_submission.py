"""A submission is what its episodes were, to the bit; nothing else passes."""

import json
import runpy
import sys
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.evaluation.stored_actions import decode, encode
from labutopia_lerobot.evaluation.submission import SubmissionError, other_build, pack, read
from labutopia_lerobot.runtime.video import video_size_and_frames

EVAL = Path(__file__).parents[2] / "eval"


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two episodes of a random policy: one film of them too."""
    out = tmp_path_factory.mktemp("submission") / "out"
    options = EvaluationConfig(
        policy=PolicyConfig("random"),
        task="level1/press",
        episodes=2,
        workers=1,
        videos=1,
        out=str(out),
    )
    run(options, Console(file=StringIO()))
    return out


@pytest.fixture
def submission(played: Path, tmp_path: Path) -> Path:
    file = tmp_path / "submission.json"
    pack(played, file)
    return file


def check(monkeypatch: pytest.MonkeyPatch, file: Path) -> None:
    monkeypatch.setattr(sys, "argv", ["check_submission.py", str(file)])
    runpy.run_path(str(EVAL / "check_submission.py"), run_name="__main__")


def test_actions_survive_to_the_bit() -> None:
    rng = np.random.default_rng(0)
    for shape in ((0, 8), (1, 8), (333, 8)):
        actions = rng.normal(size=shape).astype(np.float32)
        assert (decode(json.loads(json.dumps(encode(actions)))) == actions).all()
    with pytest.raises(ValueError, match="no stored actions"):
        decode({"shape": [1, 8]})


def test_what_was_played_here_is_played_again_to_the_bit(
    submission: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert other_build(read(submission)) == []
    check(monkeypatch, submission)
    assert "All 2 drawn episodes came out the same, to the bit." in capsys.readouterr().out


def test_a_row_that_says_more_than_its_actions_did_is_found(
    submission: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    content = json.loads(submission.read_text())
    content["rows"][0]["clipped_actions"] += 1
    submission.write_text(json.dumps(content))
    with pytest.raises(SystemExit, match="1"):
        check(monkeypatch, submission)
    told = capsys.readouterr().out
    assert "differs in clipped_actions" in told
    assert "played by this very build: the submission is not what it says" in told

    content["provenance"]["versions"]["mujoco"] = "0.1"
    submission.write_text(json.dumps(content))
    with pytest.raises(SystemExit, match="1"):
        check(monkeypatch, submission)
    told = capsys.readouterr().out
    assert "versions.mujoco: '0.1' there" in told
    assert "That may be the other build's doing" in told


def test_a_summary_of_other_rows_is_refused(submission: Path) -> None:
    content = json.loads(submission.read_text())
    content["summary"][0]["successes"] += 1
    submission.write_text(json.dumps(content))
    with pytest.raises(SubmissionError, match="does not follow from its rows"):
        read(submission)


def test_an_unfinished_result_is_not_submitted(played: Path, tmp_path: Path) -> None:
    with pytest.raises(SubmissionError, match="holds no finished result"):
        pack(tmp_path, tmp_path / "submission.json")


def test_the_film_shows_every_action_of_its_episode(played: Path) -> None:
    rows = json.loads((played / "result.json").read_text())["rows"]
    film, experts = sorted((played / "videos").iterdir())
    assert experts.stem == f"{film.stem}_expert"  # beside a failure
    assert video_size_and_frames(film)[2] == rows[0]["steps"] + 1
