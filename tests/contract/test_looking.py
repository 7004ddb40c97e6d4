"""Looking at recorded episodes, and drawing a dataset anew."""

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from labutopia_lerobot.cli import replay as program
from labutopia_lerobot.datasets.description import INFO, RECORDING, read_info
from labutopia_lerobot.datasets.rendering import UnfaithfulReplayError, render
from labutopia_lerobot.datasets.replay import ForeignDatasetError
from labutopia_lerobot.datasets.tables import read_episodes, read_frames
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.runtime.video import video_size_and_frames
from recordings import StoppedError, Watch


def show(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> None:
    monkeypatch.setattr(sys, "argv", ["labutopia-replay", *map(str, arguments)])
    program.main()


def test_an_episode_is_shown_as_a_film(picked: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    film = tmp_path / "films" / "episode.mp4"
    size = ["--width", 64, "--height", 48, "--cameras", "front", "top"]
    show(monkeypatch, picked, "--episode", 1, "--out", film, *size)
    length = read_episodes(picked)[1]["length"]
    assert video_size_and_frames(film) == (128, 48, length)
    said = capsys.readouterr().out
    assert "episode 1, seed 21: success, bit-identical to the recording. Wrote" in said


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (["--episode", "3"], "has 0 to 2"),
        (["--episode", "0", "--out", "film.gif"], "neither FILE.mp4 nor FILE.rrd"),
        (["--episode", "0"], "no display here: give --web, or --out"),
        (["--episode", "0", "--out", "a.mp4", "--cameras", "side"], "front, top, wrist"),
    ],
)
def test_what_cannot_be_shown_is_reported(
    picked: Path, monkeypatch, capsys, arguments: list[str], reported: str
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(SystemExit, match="2"):
        show(monkeypatch, picked, *arguments)
    assert reported in capsys.readouterr().err


@pytest.mark.slow
def test_an_episode_is_written_for_rerun(picked: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    pytest.importorskip("rerun", reason="an extra")
    from rerun.experimental import RrdReader

    out = tmp_path / "episode.rrd"
    size = ["--width", 64, "--height", 64, "--cameras", "front"]
    show(monkeypatch, picked, "--episode", 0, "--out", out, *size)
    written = RrdReader(out).store().schema().component_columns()
    paths = {str(column.entity_path) for column in written}
    assert {"/camera/front", "/state/joint1", "/action/gripper", "/step"} <= paths
    assert any(path.startswith("/fact/") for path in paths)


@pytest.mark.slow
def test_a_dataset_is_drawn_anew_with_the_same_episodes(picked: Path, tmp_path: Path) -> None:
    out = tmp_path / "drawn"
    first, rest = Watch(played=1), Watch()
    with pytest.raises(StoppedError):
        render(picked, out, first, cameras=("top",), width=64, height=48)
    render(picked, out, rest, cameras=("top",), width=64, height=48)
    assert (first.new, rest.new) == ([0], [1, 2])
    assert verify(out).faults == []
    info = read_info(out)
    assert info["features"]["observation.images.top"]["shape"] == [48, 64, 3]
    here, there = read_frames(picked), read_frames(out)
    for key in ("action", "observation.state", "next.reward", "timestamp"):
        assert here[key].to_pylist() == there[key].to_pylist()
    before = np.array(here["observation.environment_state"].to_pylist())
    after = np.array(there["privileged.environment_state"].to_pylist())
    assert np.array_equal(after[:, : before.shape[1]], before)


def test_an_episode_that_goes_otherwise_is_not_drawn(picked: Path, tmp_path: Path) -> None:
    root = Path(shutil.copytree(picked, tmp_path / "changed"))
    path = next(root.glob("data/*/*.parquet"))
    table = pq.read_table(path)
    states = table["observation.state"].to_pylist()
    states[50][0] += 0.01
    place = table.column_names.index("observation.state")
    kind = table.schema.field(place)
    pq.write_table(table.set_column(place, kind, pa.array(states, type=kind.type)), path)
    with pytest.raises(UnfaithfulReplayError, match=r"from frame 50 on, first in observation"):
        render(root, tmp_path / "drawn", Watch(), cameras=("top",), width=64, height=48)


def test_a_foreign_dataset_is_not_drawn(picked: Path, tmp_path: Path) -> None:
    (tmp_path / "meta").mkdir()
    (tmp_path / INFO).write_text(json.dumps(read_info(picked)))
    with pytest.raises(ForeignDatasetError, match=RECORDING):
        render(tmp_path, tmp_path / "drawn", Watch(), cameras=("top",))
