"""A submission is what its episodes were, to the bit; nothing else passes."""

import json
import runpy
import shutil
import sys
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.result_folder import decode, encode
from labutopia_lerobot.evaluation.rows import Row, UnreadableResultError, from_columns, summarise
from labutopia_lerobot.evaluation.run import run
from labutopia_lerobot.evaluation.submission import (
    SubmissionError,
    other_build,
    pack,
    read,
    replayed,
)
from labutopia_lerobot.runtime.video import video_size_and_frames

EVAL = Path(__file__).parents[2] / "eval"


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of a random policy that stopped by itself, with a film."""
    out = tmp_path_factory.mktemp("submission") / "out"
    options = EvaluationConfig(
        policy=PolicyConfig("random"),
        task="level1/press",
        until=0.3,
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


@pytest.fixture
def hundred(submission: Path) -> dict[str, Any]:
    """What nobody played: a genuine episode, over and over again under the published seeds."""
    content: dict[str, Any] = json.loads(submission.read_text())
    content["provenance"]["config"] |= {"until": None, "episodes": 100}
    row = content["rows"][0]
    content["rows"] = [row | {"seed": 100_000 + index} for index in range(100)]
    content["actions"] = content["actions"][:1] * 100
    return content


def submitted(content: dict[str, Any], folder: Path) -> Path:
    """Write a submission whose summary follows from its rows, whatever these are."""
    config = content["provenance"]["config"]
    rows = [from_columns(Row, row, folder) for row in content["rows"]]
    summaries = summarise(rows, sequential=config["until"] is not None)
    content["summary"] = [summary.columns for summary in summaries]
    content["actions"] = content["actions"][:1] * len(rows)
    file = folder / "submission.json"
    file.write_text(json.dumps(content))
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
    count = len(read(submission).actions)
    assert other_build(read(submission)) == []
    check(monkeypatch, submission)
    said = capsys.readouterr().out
    assert f"All {count} drawn episodes came out the same, to the bit." in said
    assert "not whose they are" in said


@pytest.mark.slow
def test_one_episode_under_a_hundred_seeds_does_not_come_out_the_same(
    hundred: dict[str, Any],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    file = submitted(hundred, tmp_path)
    read(file)
    with pytest.raises(SystemExit, match="1"):
        check(monkeypatch, file)
    assert "the submission is not what it says" in capsys.readouterr().out


def seeds(content: dict[str, Any], *chosen: int) -> None:
    row = content["rows"][0]
    content["rows"] = [row | {"seed": seed} for seed in chosen]
    content["provenance"]["config"]["episodes"] = len(chosen)


@pytest.mark.parametrize(
    ("chosen", "refusal"),
    [
        ([5, 17, 923], "its 3 seeds must be 100000 to 100002, each once and in order"),
        ([100_000] * 100, "each once and in order"),
        ([*range(100_000, 100_050), *range(100_051, 100_101)], "each once and in order"),
        (list(range(100_099, 99_999, -1)), "each once and in order"),
        (list(range(100_100, 100_200)), "its 100 seeds must be 100000 to 100099"),
        (list(range(100_000, 100_099)), "100 at least"),
    ],
)
def test_other_seeds_than_the_published_ones_are_refused(
    hundred: dict[str, Any], tmp_path: Path, chosen: list[int], refusal: str
) -> None:
    seeds(hundred, *chosen)
    with pytest.raises(SubmissionError, match=refusal):
        read(submitted(hundred, tmp_path))


def test_what_was_left_out_is_noticed(hundred: dict[str, Any], tmp_path: Path) -> None:
    hundred["provenance"]["config"]["episodes"] = 300
    with pytest.raises(SubmissionError, match=r"holds 100 episodes .* and was to play 300"):
        read(submitted(hundred, tmp_path))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("liquid", "off"),
        ("particles", 1),
        ("robot", "iiwa"),
        ("room", "organic_7"),
        ("renderer", "filament"),
        ("tasks_dir", "my_tasks"),
    ],
)
def test_another_setting_than_the_published_one_is_refused(
    hundred: dict[str, Any], tmp_path: Path, name: str, value: object
) -> None:
    hundred["provenance"]["config"][name] = value
    with pytest.raises(SubmissionError, match=f"played with {name}={value}; published is"):
        read(submitted(hundred, tmp_path))


@pytest.mark.parametrize(
    "columns",
    [
        {"liquid": "off"},
        {"liquid": "on", "particles": 1},
        {"robot": "iiwa"},
        {"room": "organic_7"},
        {"split": "train"},
        {"after": "press"},
        {"obs": "pixels", "policy": "act", "renderer": "Filament on llvmpipe"},
    ],
)
def test_rows_of_another_setting_are_refused_whatever_the_options_say(
    hundred: dict[str, Any], tmp_path: Path, columns: dict[str, object]
) -> None:
    hundred["rows"] = [row | columns for row in hundred["rows"]]
    with pytest.raises(SubmissionError, match="in the default setting"):
        read(submitted(hundred, tmp_path))


def test_other_conditions_that_are_published_are_accepted(
    hundred: dict[str, Any], tmp_path: Path
) -> None:
    for columns in (
        {"split": "ood", "axes": ["light", "wall"]},
        {"play": "staged"},
        {"step": "press", "after": "approach"},
    ):
        hundred["rows"] += [row | columns for row in hundred["rows"][:100]]
    assert len(read(submitted(hundred, tmp_path)).result.summaries) == 4


def test_the_same_episodes_by_two_policies_are_refused(
    hundred: dict[str, Any], tmp_path: Path
) -> None:
    hundred["rows"] += [row | {"policy": "act", "obs": "pixels"} for row in hundred["rows"]]
    with pytest.raises(SubmissionError, match="the same episodes are there by another policy"):
        read(submitted(hundred, tmp_path))


@pytest.mark.parametrize("schema", [None, 0, 99, "1"])
def test_a_submission_of_another_schema_is_refused(
    hundred: dict[str, Any], tmp_path: Path, schema: object
) -> None:
    hundred["schema"] = schema
    with pytest.raises(SubmissionError, match="no schema 1"):
        read(submitted(hundred, tmp_path))


def test_damaged_content_is_refused_in_one_line(hundred: dict[str, Any], tmp_path: Path) -> None:
    file = submitted(hundred, tmp_path)
    for damage in (
        {"rows": [None] * 100},
        {"rows": [row | {"substeps": [1]} for row in hundred["rows"]]},
        {"rows": hundred["rows"][1:]},
        {"provenance": {"config": [1]}},
        {"provenance": None},
        {"actions": {}},
    ):
        file.write_text(json.dumps(hundred | damage))
        with pytest.raises(UserError):
            read(file)
    file.write_text("[" * 100_000)
    with pytest.raises(UserError, match="cannot be read"):
        read(file)


def test_actions_of_another_robot_are_reported(hundred: dict[str, Any], tmp_path: Path) -> None:
    hundred["actions"] = [encode(np.zeros((3, 100), np.float32))]
    with pytest.raises(SubmissionError, match="100 elements, and not of 8"):
        list(replayed(read(submitted(hundred, tmp_path)), [0]))


@pytest.mark.slow
def test_a_row_that_says_more_than_its_actions_did_is_found(
    submission: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    content = json.loads(submission.read_text())
    content["rows"][0]["clipped_actions"] += 1
    submission.write_text(json.dumps(content))
    with pytest.raises(SystemExit, match="1"):
        check(monkeypatch, submission)
    said = capsys.readouterr().out
    assert "differs in clipped_actions" in said
    assert "played by this very build: the submission is not what it says" in said

    content["provenance"]["versions"]["mujoco"] = "0.1"
    submission.write_text(json.dumps(content))
    with pytest.raises(SystemExit, match="1"):
        check(monkeypatch, submission)
    said = capsys.readouterr().out
    assert "versions.mujoco: '0.1' there" in said
    assert "That may be the other build's doing" in said


def test_a_summary_of_other_rows_is_refused(submission: Path) -> None:
    content = json.loads(submission.read_text())
    content["summary"][0]["successes"] += 1
    submission.write_text(json.dumps(content))
    with pytest.raises(SubmissionError, match="does not follow from its rows"):
        read(submission)


def test_an_unfinished_result_is_not_submitted(played: Path, tmp_path: Path) -> None:
    with pytest.raises(SubmissionError, match="holds no finished result"):
        pack(tmp_path, tmp_path / "submission.json")


def test_what_is_not_played_as_published_is_not_packed(played: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(played, tmp_path / "out"))
    content = json.loads((folder / "result.json").read_text())
    content["provenance"]["config"]["particles"] = 1
    (folder / "result.json").write_text(json.dumps(content))
    with pytest.raises(SubmissionError, match="particles=1"):
        pack(folder, tmp_path / "submission.json")
    assert not (tmp_path / "submission.json").exists()


def test_a_result_says_its_schema_and_one_of_a_later_version_is_refused(
    played: Path, tmp_path: Path
) -> None:
    content = json.loads((played / "result.json").read_text())
    assert content["schema"] == 1
    (tmp_path / "later.json").write_text(json.dumps(content | {"schema": 2}))
    with pytest.raises(UnreadableResultError, match="schema 2"):
        load_results(tmp_path / "later.json")


def test_the_film_shows_every_action_of_its_episode(played: Path) -> None:
    rows = json.loads((played / "result.json").read_text())["rows"]
    film, experts = sorted((played / "videos").iterdir())
    assert experts.stem == f"{film.stem}_expert"  # beside a failure
    assert video_size_and_frames(film)[2] == rows[0]["steps"] + 1
