"""Whole demonstrations are cut into those of their steps, which are verified as any dataset is."""

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from labutopia_lerobot.cli import cut as command
from labutopia_lerobot.cli import verify as verify_command
from labutopia_lerobot.datasets.cutting import CuttingError, NothingOfStepError, cut, steps_of
from labutopia_lerobot.datasets.declaration import STEP
from labutopia_lerobot.datasets.description import RECORDING, read_info
from labutopia_lerobot.datasets.recording_folder import RecordingFolderError
from labutopia_lerobot.datasets.rendering import render
from labutopia_lerobot.datasets.replay import ForeignDatasetError, replay
from labutopia_lerobot.datasets.restoring import recorded_columns
from labutopia_lerobot.datasets.tables import (
    CUT,
    frames_of_episodes,
    read_episode_statistics,
    read_episodes,
)
from labutopia_lerobot.datasets.verification.environment import ALL
from labutopia_lerobot.datasets.verify import Verdict, verify
from labutopia_lerobot.runtime.video import read_frames
from labutopia_lerobot.setting import UnknownOptionError
from recordings import Watch, edit_table, recording

DRAWER = ["task=level2/operate_drawer"]
STEPS = ["open", "close"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("whole") / "drawer"
    return recording(root, *DRAWER, "obs=state", "episodes=1")


@pytest.fixture(scope="module")
def pieces(whole: Path) -> dict[str, Path]:
    places = {step: whole.with_name(step) for step in STEPS}
    for step, place in places.items():
        assert cut(whole, step, place) == 1
    return places


def columns_of(root: Path) -> list[dict[str, Any]]:
    info = read_info(root)
    frames = frames_of_episodes(root, read_episodes(root))
    return [recorded_columns(info, each) for _, each in frames]


def test_the_pieces_of_an_episode_are_the_episode(whole: Path, pieces: dict[str, Path]) -> None:
    assert steps_of(whole) == STEPS
    for entire, opened, shut in zip(
        columns_of(whole), *map(columns_of, pieces.values()), strict=True
    ):
        assert set(opened[STEP]) == {"open"}
        assert set(shut[STEP]) == {"close", ""}  # behind it, until the goal has held
        for key, values in entire.items():
            assert np.array_equal(np.concatenate([opened[key], shut[key]]), values)


@pytest.mark.parametrize("step", STEPS)
def test_what_was_cut_is_what_the_environment_does(step: str, pieces: dict[str, Path]) -> None:
    assert verify(pieces[step]) == Verdict([], [])
    assert all(played.faithful for played in replay(pieces[step]))


def test_pictures_are_cut_without_being_encoded_anew(tmp_path: Path) -> None:
    film = ["width=64", "height=48", "cameras=[front]", "language=true"]
    root = recording(tmp_path / "film", *DRAWER, *film, "extras=[depth]", "episodes=1")
    cut(root, "close", tmp_path / "piece")
    assert verify(tmp_path / "piece", ALL) == Verdict([], [])
    (row,) = read_episodes(tmp_path / "piece")
    first = json.loads(row[CUT])["first"]
    of = next(root.glob("videos/observation.images.front/*/*.mp4"))
    piece = next(tmp_path.glob("piece/videos/observation.images.front/*/*.mp4"))
    wanted = [0, 1, row["length"] - 1]
    before = [picture for _, picture in read_frames(of, first, wanted)]
    shown = [picture for _, picture in read_frames(piece, 0, wanted)]
    assert np.array_equal(before, shown)
    assert "language_persistent" in read_info(tmp_path / "piece")["features"]
    mean = read_episode_statistics(tmp_path / "piece")["observation.images.front/mean"]
    assert 0.1 < mean.mean() < 0.9


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"first": 3}, "differs from frame 0 on"),
        ({"first": 10_000}, "begins at frame 10000, but the expert ends at"),
        ({"step": "open"}, "says open, but its first frame is of close"),
        ({"pace": 0.5}, "differs from frame 0 on"),
        ({"pace": 1e-9}, "has the pace 1e-09, not 0.2 to 1"),
        ({"last": False}, "is success, but replayed it is success"),
    ],
)
def test_a_piece_that_says_it_is_another_is_a_fault(
    wrong: dict[str, Any], said: str, whole: Path, tmp_path: Path
) -> None:
    cut(whole, "close", tmp_path / "piece")

    def lie(values: list[str]) -> None:
        values[0] = json.dumps(json.loads(values[0]) | wrong)

    edit_table(tmp_path / "piece", "meta/episodes", CUT, lie)
    assert any(said in fault for fault in verify(tmp_path / "piece").faults)


def test_what_cannot_be_cut_is_refused(
    whole: Path, pieces: dict[str, Path], picked: Path, tmp_path: Path
) -> None:
    with pytest.raises(UnknownOptionError, match="open, close"):
        cut(whole, "shut", tmp_path / "out")
    with pytest.raises(CuttingError, match="is there already"):
        cut(whole, "close", pieces["close"])
    with pytest.raises(CuttingError, match="no recording of one whole task"):
        cut(pieces["close"], "close", tmp_path / "out")
    with pytest.raises(CuttingError, match="level1/pick, which has one step"):
        cut(picked, "1_pick", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_step_that_takes_no_time_leaves_nothing_to_learn_from(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    root = Path(shutil.copytree(whole, tmp_path / "at_once"))

    def shut_at_once(steps: list[str]) -> None:
        steps[:] = ["open"] * (len(steps) - 1) + ["close"]

    edit_table(root, "data", STEP, shut_at_once)
    with pytest.raises(NothingOfStepError, match="done as soon as the step before"):
        cut(root, "close", tmp_path / "out")
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr("sys.argv", ["labutopia-cut", str(root)])
    command.main()
    opened, nothing = capsys.readouterr().out.splitlines()
    assert opened == f"{root}-open: 1 episodes of open"
    assert "has 2 frames of close" in nothing


def test_an_edited_dataset_is_not_cut(whole: Path, tmp_path: Path) -> None:
    cut(whole, "open", tmp_path / "piece")
    (tmp_path / "piece" / RECORDING).unlink()
    with pytest.raises(ForeignDatasetError, match="has edited it"):
        cut(tmp_path / "piece", "open", tmp_path / "out")


def test_what_was_cut_is_neither_drawn_anew_nor_recorded_on(
    pieces: dict[str, Path], tmp_path: Path
) -> None:
    with pytest.raises(ForeignDatasetError, match="was cut: draw the whole recording anew"):
        render(pieces["open"], tmp_path / "out", Watch())
    with pytest.raises(RecordingFolderError, match=r"config\.cut: True there, None here"):
        recording(pieces["open"], *DRAWER, "obs=state", "step=open", "episodes=3")


def test_the_program_makes_a_dataset_of_every_step(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    root = tmp_path / "drawer"
    root.symlink_to(whole)
    monkeypatch.setattr("sys.argv", ["labutopia-cut", str(root)])
    command.main()
    assert capsys.readouterr().out.splitlines() == [
        f"{root}-{step}: 1 episodes of {step}" for step in STEPS
    ]
    monkeypatch.setattr("sys.argv", ["labutopia-verify", f"{root}-close", "--workers=1"])
    verify_command.main()
    assert "is intact: 1 episodes" in capsys.readouterr().out
