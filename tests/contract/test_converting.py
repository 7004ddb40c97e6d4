"""The original's HDF5 episodes, made to their description, become a dataset of ours."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from lerobot.datasets.lerobot_dataset import LeRobotDataset

from labutopia_lerobot.datasets.conversion import CONVERSION, ConversionError, convert
from labutopia_lerobot.datasets.original import OriginalFileError
from labutopia_lerobot.datasets.tables import column, read_episodes, read_frames
from labutopia_lerobot.datasets.verify import verify

h5py = pytest.importorskip("h5py", reason="an extra")

FRAMES = 131
CAMERAS = ("camera_1_rgb", "camera_2_rgb", "camera_3_rgb")


def poses(frames: int) -> np.ndarray:
    """Element e of frame t is t + e / 10, the finger at t / 10,000."""
    reported = np.arange(frames)[:, None] + np.arange(8) / 10
    reported[:, 7] = np.arange(frames) / 10_000
    return reported.astype(np.float32)


def fill(group: "h5py.Group", frames: int = FRAMES, reported: str = "Pick up the beaker") -> None:
    """Write an episode as the original's collector does."""
    for number, camera in enumerate(CAMERAS):
        pictures = np.zeros((frames, 3, 32, 48), np.uint8)
        pictures[:, number] = np.linspace(0, 255, frames).astype(np.uint8)[:, None, None]
        group.create_dataset(
            camera, data=pictures, chunks=(min(frames, 64), 3, 32, 48), compression="gzip"
        )
    group["agent_pose"] = poses(frames)
    group["actions"] = poses(frames + 1)[1:]
    group["language_instruction"] = reported


@pytest.fixture
def original(tmp_path: Path) -> Path:
    """Two files of one episode each."""
    folder = tmp_path / "dataset"
    folder.mkdir()
    for name, frames in (("episode_0000.h5", FRAMES), ("episode_0001.h5", 40)):
        with h5py.File(folder / name, "w") as file:
            fill(file, frames)
    return folder


def test_poses_are_halved_in_rate_and_actions_are_the_next_of_them(original: Path, tmp_path: Path):
    assert convert(original, tmp_path / "out", "local/original") == 2
    lengths = [row["length"] for row in read_episodes(tmp_path / "out")]
    assert lengths == [FRAMES // 2, 20]
    table = read_frames(tmp_path / "out").slice(0, lengths[0])
    states, actions = column(table, "observation.state"), column(table, "action")
    expected = poses(FRAMES + 1)
    expected[:, 7] *= 2  # of one finger to between both
    assert np.array_equal(states, expected[0 : FRAMES - 1 : 2])
    assert np.array_equal(actions, expected[2 : FRAMES + 1 : 2])
    assert np.array_equal(actions[:-1], states[1:])


def test_each_camera_keeps_its_pictures_under_our_name(original: Path, tmp_path: Path) -> None:
    convert(original, tmp_path / "out", "local/original")
    dataset = LeRobotDataset("local/original", root=tmp_path / "out", video_backend="pyav")
    item = dataset[30]
    assert item["task"] == "Pick up the beaker"
    bright = 60 / (FRAMES - 1)  # of frame 60 of the original
    for channel, camera in enumerate(("front", "top", "wrist")):
        colors = item[f"observation.images.{camera}"].mean(dim=(1, 2)).numpy()
        assert colors[channel] == pytest.approx(bright, abs=0.03)
        assert np.delete(colors, channel) == pytest.approx(0.0, abs=0.05)


def test_it_is_intact_not_replayable_and_marked(original: Path, tmp_path: Path) -> None:
    convert(original, tmp_path / "out", "local/original")
    verdict = verify(tmp_path / "out")
    assert verdict.faults == []
    assert any("replay" in text for text in verdict.unchecked)
    reported = json.loads((tmp_path / "out" / CONVERSION).read_text())
    assert reported["licence"] == "CC-BY-NC-4.0"
    assert reported["replayable"] is False
    assert reported["files"].keys() == {"episode_0000.h5", "episode_0001.h5"}


def test_files_of_equal_names_in_several_folders_are_all_in_the_record(
    original: Path, tmp_path: Path
) -> None:
    for run in ("first", "second"):
        shutil.copytree(original, tmp_path / "runs" / run)
    convert(tmp_path / "runs", tmp_path / "out", "local/original")
    reported = json.loads((tmp_path / "out" / CONVERSION).read_text())
    assert len(reported["files"]) == 4
    assert "second/episode_0001.h5" in reported["files"]


def test_a_merged_file_holds_an_episode_per_group(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "episode_data.hdf5", "w") as file:
        fill(file.create_group("episode_0000"), 20)
        fill(file.create_group("episode_0001"), 30)
    assert convert(tmp_path / "episode_data.hdf5", tmp_path / "out", "local/original") == 2


def test_navigation_is_refused(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "walk.h5", "w") as file:
        file["joint_positions"] = np.zeros((10, 12), np.float32)
        file["robot_position"] = np.zeros((10, 3), np.float32)
    with pytest.raises(OriginalFileError, match=r"navigation.*only manipulation"):
        convert(tmp_path / "walk.h5", tmp_path / "out", "local/original")
    assert not (tmp_path / "out").exists()


def test_what_is_no_episode_is_refused_with_what_it_lacks(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "half.h5", "w") as file:
        fill(file)
        del file["actions"]
    with pytest.raises(OriginalFileError, match="lacks actions"):
        convert(tmp_path / "half.h5", tmp_path / "out", "local/original")
    (tmp_path / "text.h5").write_text("no HDF5")
    with pytest.raises(OriginalFileError, match="cannot be read as HDF5"):
        convert(tmp_path / "text.h5", tmp_path / "out", "local/original")
    with pytest.raises(ConversionError, match="holds no"):
        convert(tmp_path / "nowhere", tmp_path / "out", "local/original")


def test_an_episode_without_instruction_needs_one(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "press.h5", "w") as file:
        fill(file, 20, "")
    with pytest.raises(ConversionError, match="--instruction"):
        convert(tmp_path / "press.h5", tmp_path / "out", "local/original")
    convert(tmp_path / "press.h5", tmp_path / "out", "local/original", "Press the button")
    assert read_episodes(tmp_path / "out")[0]["tasks"] == ["Press the button"]
