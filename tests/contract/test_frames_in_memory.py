"""Trainings read our recordings of states from memory, and are given what LeRobot gives them."""

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
from recordings import recording

AROUND = {"action": [step / 30 for step in range(-2, 40)], "observation.state": [-0.1, 0.0]}


@pytest.fixture(scope="module")
def pressed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("data") / "press"
    return recording(root, "task=level1/press", "obs=state", "episodes=3")


@pytest.fixture
def lerobots_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(DatasetReader, "get_item", frames_in_memory._read_from_tables)


def frames(root: Path, **options: Any) -> list[dict[str, Any]]:
    dataset = LeRobotDataset("local/frames", root=root, **options)
    return [dataset[index] for index in range(0, len(dataset), 7)]


@pytest.mark.parametrize("episodes", [None, [0, 2]])
@pytest.mark.parametrize("around", [None, AROUND])
def test_frames_from_memory_are_those_from_tables(pressed, lerobots_own, episodes, around) -> None:
    tables = frames(pressed, episodes=episodes, delta_timestamps=around)
    keep_frames_in_memory()
    memory = frames(pressed, episodes=episodes, delta_timestamps=around)
    assert len(tables) == len(memory) > 30
    for table, kept in zip(tables, memory, strict=True):
        assert list(table) == list(kept)
        for name, value in table.items():
            if isinstance(value, torch.Tensor):
                assert value.dtype == kept[name].dtype
                assert torch.equal(value, kept[name])
            else:
                assert value == kept[name]


def test_what_a_frame_is_changed_to_does_not_change_the_next_reading(pressed, lerobots_own) -> None:
    keep_frames_in_memory()
    dataset = LeRobotDataset("local/frames", root=pressed, delta_timestamps=AROUND)
    before = dataset[5]["commanded_action"].clone()
    for value in dataset[5].values():
        if isinstance(value, torch.Tensor):
            value.zero_()
    assert torch.equal(dataset[5]["commanded_action"], before)


def test_lerobots_programs_read_states_from_memory_and_pictures_as_ever(
    pressed, filmed, lerobots_own, monkeypatch
) -> None:
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)  # the plugin sets its own
    monkeypatch.delitem(sys.modules, "lerobot_env_labutopia", raising=False)
    register_third_party_plugins()
    for root, kept in ((pressed, True), (filmed, False)):
        dataset = LeRobotDataset("local/frames", root=root, video_backend="pyav")
        assert dataset[0]["frame_index"] == 0
        assert any(isinstance(v, FramesInMemory) for v in vars(dataset.reader).values()) == kept
