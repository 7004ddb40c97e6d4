"""What LeRobot's own tests ask of every dataset, asked of ours; its tools work on ours."""

import json
import subprocess
import sys
from itertools import islice
from pathlib import Path

import av
import numpy as np
import pytest
import torch
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.utils.collate import lerobot_collate_fn
from lerobot.utils.feature_utils import dataset_to_policy_features

from labutopia_lerobot.datasets.tables import PARAPHRASES, column, read_episodes, read_frames
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from recordings import FILM, recording

COUNTERS = {"timestamp", "frame_index", "episode_index", "index", "task_index"}


@pytest.fixture(scope="module")
def dataset(filmed: Path) -> LeRobotDataset:
    return LeRobotDataset("local/pick", root=filmed, video_backend="pyav")


def test_the_metadata_count_the_same_as_the_data(dataset: LeRobotDataset) -> None:
    episodes = list(dataset.meta.episodes)
    assert len(episodes) == dataset.num_episodes == dataset.meta.total_episodes
    assert sum(episode["length"] for episode in episodes) == len(dataset)
    assert dataset.meta.total_frames == len(dataset.hf_dataset) == len(dataset)
    first = 0
    for number, episode in enumerate(episodes):
        assert episode["episode_index"] == number
        assert (episode["dataset_from_index"], episode["dataset_to_index"]) == (
            first,
            first + episode["length"],
        )
        first += episode["length"]


def test_every_episode_counts_its_frames(dataset: LeRobotDataset) -> None:
    for episode in dataset.meta.episodes:
        rows = range(episode["dataset_from_index"], episode["dataset_to_index"])
        frames = dataset.hf_dataset.select(rows)
        assert torch.stack(list(frames["index"])).tolist() == list(rows)
        assert torch.stack(list(frames["frame_index"])).tolist() == list(range(len(rows)))
        times = torch.stack(list(frames["timestamp"]))
        assert torch.allclose(times.diff(), torch.full((len(rows) - 1,), 1 / 30), atol=1e-5)
        assert times[0] == 0.0


def test_statistics_are_there_and_in_order(dataset: LeRobotDataset) -> None:
    for key, feature in dataset.features.items():
        if feature["dtype"] == "string":
            assert key not in dataset.meta.stats
            continue
        statistics = dataset.meta.stats[key]
        assert {"min", "max", "mean", "std", "count", "q01", "q99"} <= statistics.keys()
        assert statistics["count"].item() == len(dataset)
        low, mean, high = (statistics[name] for name in ("min", "mean", "max"))
        assert (low <= mean + 1e-6).all()
        assert (mean <= high + 1e-6).all()
        assert (statistics["std"] >= 0).all()
        shape = (3, 1, 1) if feature["dtype"] == "video" else tuple(feature["shape"])
        assert mean.shape == shape


def test_windows_stop_at_the_ends_of_an_episode(filmed: Path) -> None:
    around = [-1 / 30, 0.0, 1 / 30]
    dataset = LeRobotDataset(
        "local/pick", root=filmed, video_backend="pyav", delta_timestamps={"action": around}
    )
    for episode in dataset.meta.episodes:
        first, last = episode["dataset_from_index"], episode["dataset_to_index"] - 1
        assert dataset[first]["action_is_pad"].tolist() == [True, False, False]
        assert dataset[last]["action_is_pad"].tolist() == [False, False, True]
        assert torch.equal(dataset[first]["action"][0], dataset[first]["action"][1])


def test_every_frame_has_a_task_of_the_table(dataset: LeRobotDataset) -> None:
    table = dataset.meta.tasks
    assert table["task_index"].tolist() == list(range(len(table)))
    for index in (0, len(dataset) - 1):
        item = dataset[index]
        assert item["task"] == table.index[item["task_index"].item()]


def test_videos_have_a_frame_at_every_timestamp(dataset: LeRobotDataset) -> None:
    for key in dataset.meta.video_keys:
        for path in sorted(dataset.root.glob(f"videos/{key}/*/*.mp4")):
            with av.open(str(path)) as video:
                times = [frame.time for frame in video.decode(video=0)]
            assert np.allclose(times, np.arange(len(times)) / 30, atol=1e-4)
    for index in range(0, len(dataset), 37):  # LeRobot raises where a timestamp has no frame
        assert dataset[index]["observation.images.front"].shape == (3, 48, 64)


def test_policies_are_offered_states_pictures_and_actions_only(dataset: LeRobotDataset) -> None:
    offered = dataset_to_policy_features(dataset.features)
    assert set(offered) == {
        "action",
        "observation.state",
        "observation.images.front",
        "observation.images.wrist",
    }


def test_a_batch_of_frames_can_be_collated(dataset: LeRobotDataset) -> None:
    batch = next(iter(torch.utils.data.DataLoader(dataset, batch_size=4)))
    assert batch["action"].shape == (4, 8)
    assert batch["next.reward"].shape == batch["next.done"].shape == (4,)
    assert batch["annotation.step"] == ["pick"] * 4


@pytest.mark.slow
def test_language_columns_say_what_the_annotations_say(tmp_path: Path) -> None:
    options = [*FILM, "episodes=1", "cameras=[front]", "language=true"]
    root = recording(tmp_path / "dataset", *options)
    verdict = verify(root, 0)
    assert verdict.faults == []
    dataset = LeRobotDataset("local/pick", root=root, video_backend="pyav")
    rows = dataset[0]["language_persistent"]
    assert rows == dataset[len(dataset) - 1]["language_persistent"]
    said = {
        style: [row["content"] for row in rows if row["style"] == style]
        for style in ("task_aug", "subtask", "memory", "motion")
    }
    paraphrases = canonical_task(Setting("level1/pick")).paraphrases
    assert json.loads(read_episodes(root)[0][PARAPHRASES]) == list(paraphrases)
    assert sorted(said["task_aug"]) == sorted(paraphrases)
    assert said["subtask"] == ["pick"]
    assert said["memory"] == ["gripped", "lifted"]
    phases = column(read_frames(root), "annotation.phase").tolist()
    assert said["motion"] == list(dict.fromkeys(phases))
    lifted = next(row["timestamp"] for row in rows if row["content"] == "lifted")
    substeps = column(read_frames(root), "annotation.substep").tolist()
    assert lifted == pytest.approx(substeps.index("lifted") / 30)
    assert lerobot_collate_fn([dataset[0], dataset[1]])["action"].shape == (2, 8)


def test_streaming_gives_the_same_items(dataset: LeRobotDataset) -> None:
    pytest.importorskip("torchcodec", exc_type=RuntimeError)  # it needs FFmpeg's libraries
    from lerobot.datasets.streaming_dataset import StreamingLeRobotDataset

    streamed = StreamingLeRobotDataset("local/pick", root=dataset.root, shuffle=False)
    keys = dataset.meta.video_keys
    assert keys
    for item in islice(streamed, 5):
        same = dataset[int(item["index"])]
        assert torch.equal(item["action"], same["action"])
        for key in keys:  # two decoders: a level apart
            assert torch.allclose(item[key], same[key], atol=1.5 / 255)


@pytest.mark.slow
def test_lerobots_viewer_writes_a_recording(filmed: Path, tmp_path: Path) -> None:
    pytest.importorskip("rerun")  # LeRobot's extra `dataset_viz`
    program = Path(sys.executable).parent / "lerobot-dataset-viz"
    options = ["--repo-id=local/pick", f"--root={filmed}", "--episode-index=0", "--num-workers=0"]
    subprocess.run([program, *options, "--save=1", f"--output-dir={tmp_path}"], check=True)
    assert list(tmp_path.glob("*.rrd"))
