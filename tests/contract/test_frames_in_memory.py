"""Trainings read our recordings from memory, and are given what LeRobot gives them."""

import sys
from pathlib import Path
from typing import Any

import pytest
import torch
from lerobot.datasets.dataset_reader import DatasetReader
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.utils.import_utils import register_third_party_plugins

from labutopia_lerobot.datasets import frames_in_memory
from labutopia_lerobot.datasets.frames_in_memory import FramesInMemory, keep_frames_in_memory
from recordings import FILM, recording

AROUND = {"action": [step / 30 for step in range(-2, 40)], "observation.state": [-0.1, 0.0]}


@pytest.fixture(scope="module")
def pressed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("data") / "press"
    return recording(root, "task=level1/press", "obs=state", "episodes=3")


@pytest.fixture
def lerobots_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(DatasetReader, "get_item", frames_in_memory._read_from_files)


def frames(root: Path, **options: Any) -> list[dict[str, Any]]:
    dataset = LeRobotDataset("local/frames", root=root, **options)
    return [dataset[index] for index in range(0, len(dataset), 7)]


@pytest.mark.parametrize("episodes", [None, [0, 2]])
@pytest.mark.parametrize("around", [None, AROUND])
def test_frames_from_memory_are_those_from_tables(pressed, lerobots_own, episodes, around) -> None:
    of_files = frames(pressed, episodes=episodes, delta_timestamps=around)
    keep_frames_in_memory()
    of_memory = frames(pressed, episodes=episodes, delta_timestamps=around)
    assert len(of_files) > 30
    require_equal(of_files, of_memory)


@pytest.mark.slow
@pytest.mark.parametrize("as_bytes", [True, False])
@pytest.mark.parametrize("around", [None, {**AROUND, "observation.images.front": [-0.1, 0.0]}])
def test_pictures_from_memory_are_those_from_videos(filmed, lerobots_own, as_bytes, around) -> None:
    options = {"delta_timestamps": around, "return_uint8": as_bytes, "video_backend": "pyav"}
    of_files = frames(filmed, **options)
    keep_frames_in_memory()
    of_memory = frames(filmed, **options)
    assert any(".images." in name for name in of_memory[0])
    require_equal(of_files, of_memory)


def require_equal(of_files: list[dict[str, Any]], of_memory: list[dict[str, Any]]) -> None:
    for file, memory in zip(of_files, of_memory, strict=True):
        assert set(file) == set(memory)
        for name, value in file.items():
            if isinstance(value, torch.Tensor):
                assert value.dtype == memory[name].dtype
                assert torch.equal(value, memory[name])
            else:
                assert value == memory[name]


def test_what_a_frame_is_changed_to_does_not_change_the_next_reading(pressed, lerobots_own) -> None:
    keep_frames_in_memory()
    dataset = LeRobotDataset("local/frames", root=pressed, delta_timestamps=AROUND)
    before = dataset[5]["commanded_action"].clone()
    for value in dataset[5].values():
        if isinstance(value, torch.Tensor):
            value.zero_()
    assert torch.equal(dataset[5]["commanded_action"], before)


def test_lerobots_programs_read_from_memory(pressed, filmed, lerobots_own, monkeypatch) -> None:
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)  # the plugin sets its own
    monkeypatch.delitem(sys.modules, "lerobot_env_labutopia", raising=False)
    register_third_party_plugins()
    for root in (pressed, filmed):
        assert kept(root)


def test_pictures_that_half_of_the_memory_does_not_hold_are_read_as_ever(
    filmed, lerobots_own, monkeypatch
) -> None:
    keep_frames_in_memory()
    monkeypatch.setattr(frames_in_memory, "free_memory_bytes", lambda: 1_000_000)
    assert not kept(filmed)


@pytest.mark.slow
def test_recordings_with_language_are_read_as_ever(tmp_path, lerobots_own) -> None:
    root = recording(tmp_path / "told", *FILM, "episodes=1", "cameras=[front]", "language=true")
    keep_frames_in_memory()
    assert not kept(root)


def test_processes_that_load_read_pictures_as_ever(filmed, lerobots_own) -> None:
    keep_frames_in_memory()
    dataset = LeRobotDataset("local/frames", root=filmed, video_backend="pyav")
    loader = torch.utils.data.DataLoader(dataset, num_workers=1, batch_size=2)
    assert len(next(iter(loader))["frame_index"]) == 2


def kept(root: Path) -> bool:
    dataset = LeRobotDataset("local/frames", root=root, video_backend="pyav")
    assert dataset[0]["frame_index"] == 0
    return any(isinstance(value, FramesInMemory) for value in vars(dataset.reader).values())
