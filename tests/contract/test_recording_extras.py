"""Depth, segmentation and forces in datasets: LeRobot reads them, the judge finds what is wrong."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import torch
from lerobot.datasets.dataset_tools import delete_episodes
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.envs import preprocess_observation
from lerobot.envs.factory import make_env_pre_post_processors
from lerobot.envs.utils import env_to_policy_features
from lerobot.utils.feature_utils import dataset_to_policy_features

from labutopia_lerobot.datasets.rendering import render
from labutopia_lerobot.datasets.tables import SEGMENTS, read_episodes
from labutopia_lerobot.datasets.verify import Verdict, verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.lerobot_plugin import LabUtopiaEnvConfig
from labutopia_lerobot.pictures import camera_and_kind
from labutopia_lerobot.runtime.video import VideoWriter, read_frames
from labutopia_lerobot.setting import DEPTH, FORCES, SEGMENTATION, Setting
from recordings import Watch, assert_same_dataset, recording

EXTRAS = (DEPTH, SEGMENTATION, FORCES)
TINY = ["task=level1/pick", "liquid=off", "width=64", "height=48", "cameras=[top]"]
SENSED = [*TINY, "extras=[depth,segmentation,forces]"]
DEPTH, SEGMENTS_SEEN = "observation.images.top_depth", "observation.images.top_segmentation"


@pytest.fixture(scope="module")
def sensed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished recording of two episodes with all extras."""
    return recording(tmp_path_factory.mktemp("sensed") / "dataset", *SENSED, "episodes=2")


@pytest.fixture
def spoilt(sensed: Path, tmp_path: Path) -> Path:
    """A copy of it, to be damaged."""
    return Path(shutil.copytree(sensed, tmp_path / "copy"))


def dataset(root: Path, **options: Any) -> LeRobotDataset:
    return LeRobotDataset("local/pick", root=root, **options)


def frames_of(root: Path, picture: str) -> list[Any]:
    (path,) = root.glob(f"videos/observation.images.{picture}/*/*.mp4")
    count = sum(row["length"] for row in read_episodes(root))
    kind = camera_and_kind(picture)[1]
    return [frame for _, frame in read_frames(path, 0, range(count), kind)]


def edit(root: Path, picture: str, change: Callable[[Any], Any]) -> None:
    frames = frames_of(root, picture)
    (path,) = root.glob(f"videos/observation.images.{picture}/*/*.mp4")
    with VideoWriter(path, 64, 48, camera_and_kind(picture)[1]) as video:
        for frame in frames:
            video.add(np.ascontiguousarray(change(frame)))


@pytest.mark.slow
def test_lerobot_reads_what_the_environment_shows(sensed: Path) -> None:
    setting = Setting("level1/pick", split="train", liquid="off", extras=EXTRAS, cameras=("top",))
    shown, _ = LabEnv(
        Setting(**{**vars(setting), "width": 64, "height": 48})  # type: ignore[arg-type]
    ).reset(seed=read_episodes(sensed)[0]["labutopia/seed"])
    in_millimetres, in_metres = dataset(sensed)[0], dataset(sensed, depth_output_unit="m")[0]
    depth = shown["images.top_depth"][..., 0]
    assert in_millimetres[DEPTH].shape == (1, 48, 64)
    assert np.abs(in_metres[DEPTH][0].numpy() - depth).max() <= 0.0005 + 1e-6
    assert np.abs(in_millimetres[DEPTH][0].numpy() - 1000 * depth).max() <= 0.5 + 1e-3
    for backend in ("pyav", "torchcodec"):
        seen = dataset(sensed, video_backend=backend)[0][SEGMENTS_SEEN] * 255
        shown_numbers = shown["pixels"]["top_segmentation"].transpose(2, 0, 1)
        assert np.array_equal(seen.numpy(), shown_numbers.astype(np.float32))
    assert in_metres["observation.forces"].tolist() == shown["forces"].tolist()


def test_lerobot_knows_the_depth_for_depth_and_its_statistics_are_those_of_the_pixels(
    sensed: Path,
) -> None:
    there = dataset(sensed, depth_output_unit="m")
    assert there.meta.depth_keys == [DEPTH]
    pixels = np.stack(frames_of(sensed, "top_depth")).astype(float)
    found = {name: np.array(values).ravel() for name, values in there.meta.stats[DEPTH].items()}
    assert found["min"] == pytest.approx(pixels.min(), abs=1e-6)
    assert found["max"] == pytest.approx(pixels.max(), abs=1e-6)
    assert found["mean"] == pytest.approx(pixels.mean(), abs=1e-5)
    assert found["std"] == pytest.approx(pixels.std(), abs=1e-5)


def test_numbers_have_their_names_beside_every_episode(sensed: Path, filmed: Path) -> None:
    for row in read_episodes(sensed):
        assert json.loads(row[SEGMENTS])[:4] == ["background", "robot", "liquid", "flask"]
    assert all(SEGMENTS not in row for row in read_episodes(filmed))


@pytest.mark.slow
def test_an_extended_recording_is_the_same_as_one_at_once(sensed: Path, tmp_path: Path) -> None:
    recording(tmp_path / "longer", *SENSED, "episodes=1")
    assert_same_dataset(sensed, recording(tmp_path / "longer", *SENSED, "episodes=2"))


def test_the_judge_finds_no_fault(sensed: Path) -> None:
    assert verify(sensed) == Verdict([], [])


@pytest.mark.slow
@pytest.mark.parametrize("picture", ["top_depth", "top_segmentation"])
def test_a_flipped_picture_is_found(picture: str, spoilt: Path) -> None:
    edit(spoilt, picture, lambda frame: frame[:, ::-1])
    faults = verify(spoilt).faults
    assert len(faults) == 2
    assert all(f"{picture} is not what the camera sees" in fault for fault in faults)


def test_a_thing_that_is_called_another_is_found(spoilt: Path) -> None:
    edit(spoilt, "top_segmentation", lambda frame: np.where(frame == 3, 4, frame).astype(np.uint8))
    assert any("top_segmentation is not what the camera sees" in f for f in verify(spoilt).faults)


def test_other_forces_and_names_are_found(spoilt: Path) -> None:
    for folder, key, value in (
        ("data", "observation.forces", [1.0, 0.0]),
        ("meta/episodes", SEGMENTS, json.dumps(["flask"])),
    ):
        path = next((spoilt / folder).glob("*/*.parquet"))
        table = pq.read_table(path)
        values, number = table[key].to_pylist(), table.column_names.index(key)
        values[0] = value
        field = table.schema.field(number)
        pq.write_table(table.set_column(number, field, pa.array(values, type=field.type)), path)
    faults = verify(spoilt, 0).faults
    assert any("from frame 0 on, first in observation.forces" in fault for fault in faults)
    assert any(f'{SEGMENTS} of episode 0 is ["flask"]' in fault for fault in faults)


@pytest.mark.slow
def test_what_lerobot_keeps_of_them_it_keeps_bit_for_bit(sensed: Path, tmp_path: Path) -> None:
    kept = delete_episodes(dataset(sensed), [0], output_dir=tmp_path / "kept", repo_id="local/kept")
    first = read_episodes(sensed)[0]["length"]
    for picture in ("top_depth", "top_segmentation"):
        for there, here in zip(
            frames_of(sensed, picture)[first:], frames_of(kept.root, picture), strict=True
        ):
            assert np.array_equal(there, here), picture
    assert kept.meta.depth_keys == [DEPTH]


@pytest.mark.slow
def test_a_dataset_without_them_can_be_drawn_with_them(picked: Path, tmp_path: Path) -> None:
    size: dict[str, Any] = {"width": 64, "height": 48, "cameras": ["top"]}
    with pytest.raises(UserError, match="has no forces"):
        render(picked, tmp_path / "out", Watch(), extras=["forces"], **size)
    render(picked, tmp_path / "out", Watch(), extras=["segmentation"], **size)
    assert verify(tmp_path / "out") == Verdict([], [])


def test_lerobots_environment_offers_policies_what_its_datasets_do(sensed: Path) -> None:
    config = LabUtopiaEnvConfig(liquid="off", extras=EXTRAS, cameras=("top",), width=64, height=48)
    stored = dataset(sensed)
    offered = env_to_policy_features(config)
    trained = dataset_to_policy_features(stored.features)
    assert {key: feature.shape for key, feature in offered.items()} == {
        key: feature.shape for key, feature in trained.items()
    }
    ((envs,),) = (suite.values() for suite in config.create_envs(n_envs=1).values())
    observation, _ = envs.reset(seed=[0])
    envs.close()
    preprocess, _ = make_env_pre_post_processors(config, None)
    batch = preprocess(preprocess_observation(observation))
    item = stored[0]
    for key in trained.keys() - {"action"}:
        assert batch[key].shape[1:] == item[key].shape, key
        assert batch[key].dtype == item[key].dtype == torch.float32
    assert float(batch[DEPTH].median()) == pytest.approx(float(item[DEPTH].median()), rel=0.05)


def test_what_is_hidden_is_not_named_and_no_picture_is_drawn_beside_it(tmp_path: Path) -> None:
    words = ["task=level1/pick", "obs=state", "hidden=[sizes]", "episodes=1"]
    root = recording(tmp_path / "blind", *words)
    row = read_episodes(root)[0]
    stored = dataset(root)[0]["observation.environment_state"]
    assert len(json.loads(row["labutopia/privileged"])) == len(stored)
    with pytest.raises(UserError, match=r"recorded with hidden=\['sizes'\].*record it anew"):
        render(root, tmp_path / "drawn", Watch())
