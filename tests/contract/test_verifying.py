"""The judge of datasets: every fault that is planted is found, and nothing else is called one."""

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from lerobot.datasets.dataset_tools import delete_episodes, recompute_stats, split_dataset
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from numpy.typing import NDArray

from labutopia_lerobot.cli import verify as command
from labutopia_lerobot.datasets.description import (
    RECORDING,
    STATISTICS,
    DamagedDatasetError,
    read_recording,
    read_statistics,
)
from labutopia_lerobot.datasets.replay import ForeignDatasetError, replay
from labutopia_lerobot.datasets.tables import DRAWN, OUTCOME
from labutopia_lerobot.datasets.verification import environment
from labutopia_lerobot.datasets.verification.environment import ALL
from labutopia_lerobot.datasets.verify import Verdict, find_problems, require_intact, verify
from labutopia_lerobot.runtime.video import VideoWriter, read_frames, video_size_and_frames
from recordings import edit_table, recording

Picture = NDArray[np.uint8]


def edit_video(root: Path, camera: str, edit: Callable[[list[Picture]], list[Picture]]) -> None:
    path = next(root.glob(f"videos/observation.images.{camera}/*/*.mp4"))
    width, height, frames = video_size_and_frames(path)
    pictures = edit([picture for _, picture in read_frames(path, 0, range(frames))])
    with VideoWriter(path, width, height) as video:
        for picture in pictures:
            video.add(picture)


@pytest.mark.parametrize("fixture", ["picked", "filmed"])
def test_a_finished_dataset_is_whole_and_what_the_environment_does(
    fixture: str, request: pytest.FixtureRequest
) -> None:
    assert verify(request.getfixturevalue(fixture)) == Verdict([], [])


def test_an_episode_whose_outcome_is_not_written_is_to_succeed_again(
    picked: Path, tmp_path: Path
) -> None:
    root = Path(shutil.copytree(picked, tmp_path / "copy"))
    path = next((root / "meta/episodes").glob("*/*.parquet"))
    pq.write_table(pq.read_table(path).drop_columns([OUTCOME]), path)
    assert all(played.faithful for played in replay(root))


@pytest.mark.parametrize("kept", [0.0, 0.5, 0.999])
def test_a_video_cut_short_is_found(kept: float, copied: Path) -> None:
    video = next(copied.glob("videos/observation.images.front/*/*.mp4"))
    os.truncate(video, int(kept * video.stat().st_size))
    with pytest.raises(DamagedDatasetError, match=r"observation\.images\.front/.*mp4"):
        require_intact(copied)


@pytest.mark.parametrize("pattern", ["videos/*/*/*.mp4", "data/*/*", "meta/*", "meta/episodes/*/*"])
def test_a_missing_file_is_found(pattern: str, copied: Path) -> None:
    files = [path for path in copied.glob(pattern) if path.is_file()]
    for path in files:
        if path.name == "labutopia.json":
            continue
        content = path.read_bytes()
        path.unlink()
        assert find_problems(copied)
        path.write_bytes(content)
    assert files
    assert find_problems(copied) == []


def test_lost_rows_are_found(copied: Path) -> None:
    path = next(copied.glob("data/*/*.parquet"))
    pq.write_table(pq.read_table(path).slice(1), path)
    assert any(problem.startswith("data") for problem in find_problems(copied))


@pytest.mark.parametrize("fixture", ["picked", "filmed"])
def test_replayed_it_succeeds_through_identical_states(
    fixture: str, request: pytest.FixtureRequest
) -> None:
    replays = list(replay(request.getfixturevalue(fixture)))
    assert len(replays) == (3 if fixture == "picked" else 2)
    assert all(played.faithful for played in replays)


def test_a_changed_action_is_found(copied: Path) -> None:
    def change(actions: list[list[float]]) -> None:
        actions[50][0] += 0.01

    edit_table(copied, "data", "action", change)
    first, second = replay(copied)
    assert first.first_difference == 50
    assert second.faithful
    assert any(
        "episode 0: replayed it differs from frame 50 on, first in action" in fault
        for fault in verify(copied, 0).faults
    )


def test_a_changed_command_is_found(copied: Path) -> None:
    def change(commands: list[list[float]]) -> None:
        commands[50][0] += 0.01

    edit_table(copied, "data", "commanded_action", change)
    assert any("differs from frame 50 on, first in action" in f for f in verify(copied, 0).faults)


def test_a_shuffled_episode_is_found(copied: Path) -> None:
    def swap(rows: list[list[float]]) -> None:
        rows[40], rows[60] = rows[60], rows[40]

    for key in ("observation.state", "action", "commanded_action"):
        edit_table(copied, "data", key, swap)
    assert find_problems(copied) == []
    faults = verify(copied, 0).faults
    assert [fault for fault in faults if "from frame 40 on" in fault]


def test_a_frame_dropped_from_a_video_is_found(copied: Path) -> None:
    edit_video(copied, "front", lambda pictures: [*pictures[:80], *pictures[81:]])
    assert any("frames, but the table has" in problem for problem in find_problems(copied))


def test_a_frame_dropped_from_the_table_is_found(copied: Path) -> None:
    path = next(copied.glob("data/*/*.parquet"))
    table = pq.read_table(path)
    pq.write_table(pa.concat_tables([table.slice(0, 80), table.slice(81)]), path)
    assert find_problems(copied)


@pytest.mark.slow
def test_videos_that_run_behind_are_found_where_all_pictures_are_compared(copied: Path) -> None:
    edit_video(copied, "front", lambda pictures: [*[pictures[0]] * 8, *pictures[:-8]])
    assert find_problems(copied) == []
    assert any(
        "observation.images.front is not what the camera sees" in fault
        for fault in verify(copied, ALL).faults
    )


def test_a_flipped_camera_is_found(copied: Path) -> None:
    edit_video(copied, "wrist", lambda pictures: [picture[:, ::-1] for picture in pictures])
    assert find_problems(copied) == []
    faults = verify(copied).faults
    assert len(faults) == 2
    assert all("observation.images.wrist is not what the camera sees" in f for f in faults)


def test_a_dimmed_camera_is_found(copied: Path) -> None:
    edit_video(copied, "front", lambda pictures: [(0.93 * p).astype(np.uint8) for p in pictures])
    assert find_problems(copied) == []
    faults = verify(copied).faults
    assert len(faults) == 2
    assert all("observation.images.front is not what the camera sees" in f for f in faults)


def test_a_bright_button_that_compression_dulls_is_no_fault(tmp_path: Path) -> None:
    small = ("obs=pixels", "cameras=[front,wrist]", "width=96", "height=96")
    root = recording(tmp_path / "press", "task=level1/press", "seed=74", "episodes=1", *small)
    assert verify(root, ALL) == Verdict([], [])  # its red is off by 13 levels, beside a dark panel


def test_a_wrong_instruction_is_found(copied: Path) -> None:
    table = pq.read_table(copied / "meta/tasks.parquet").to_pandas()
    table.index = ["Throw the flask."]
    table.index.name = "task"
    table.to_parquet(copied / "meta/tasks.parquet")
    assert any("is not there" in problem for problem in find_problems(copied))

    def rename(rows: list[list[str]]) -> None:
        rows[:] = [["Throw the flask."]] * len(rows)

    edit_table(copied, "meta/episodes", "tasks", rename)
    assert find_problems(copied) == []
    assert any("the environment says 'Pick up" in fault for fault in verify(copied, 0).faults)


@pytest.mark.parametrize("statistic", ["mean", "std", "max", "q50"])
@pytest.mark.parametrize("key", ["action", "observation.images.front"])
def test_wrong_statistics_are_found(key: str, statistic: str, copied: Path) -> None:
    statistics = read_statistics(copied)
    values = np.array(statistics[key][statistic])
    statistics[key][statistic] = (values + 0.02).tolist()
    (copied / STATISTICS).write_text(json.dumps(statistics))
    of = "the frames" if key == "action" else "its episodes"
    assert verify(copied, 0).faults == [f"{STATISTICS}: {statistic} of {key} is not that of {of}"]


def test_wrong_statistics_of_an_episode_are_found(copied: Path) -> None:
    def change(means: list[list[float]]) -> None:
        means[1][3] += 0.01

    edit_table(copied, "meta/episodes", "stats/action/mean", change)
    faults = verify(copied, 0).faults
    assert faults == ["meta/episodes: episode 1: mean of action is not that of its frames"]


def test_an_edited_draw_is_found(copied: Path) -> None:
    def change(drawn: list[str]) -> None:
        drawn[1] = json.dumps({"light": 1.1})

    edit_table(copied, "meta/episodes", DRAWN, change)
    (fault,) = verify(copied, 0).faults
    assert "episode 1: labutopia/drawn is {'light': 1.1}" in fault


@pytest.mark.slow
def test_several_processes_come_to_the_same_verdict(
    copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(environment, "_SHARE", 1)
    assert verify(copied, workers=2) == Verdict([], [])

    def change(drawn: list[str]) -> None:
        drawn[1] = json.dumps({"light": 1.1})

    edit_table(copied, "meta/episodes", DRAWN, change)
    verdict = verify(copied, workers=2)
    assert verdict == verify(copied)
    (fault,) = verdict.faults
    assert "episode 1: labutopia/drawn is {'light': 1.1}" in fault


def test_on_another_build_it_is_reported_how_far_the_states_are_off(copied: Path) -> None:
    recording = read_recording(copied)
    recording["versions"]["mujoco"] = "of yesterday"
    (copied / RECORDING).write_text(json.dumps(recording))
    assert verify(copied, 0) == Verdict([], [])  # here the other build happens to be the same

    def shift(rows: list[list[float]]) -> None:
        for row in rows:
            row[0] += 1e-6

    edit_table(copied, "data", "privileged.environment_state", shift)
    verdict = verify(copied, 0)
    assert not [fault for fault in verdict.faults if "replayed" in fault]
    (reported,) = verdict.unchecked
    assert "versions.mujoco: 'of yesterday' there" in reported
    assert "first in privileged.environment_state; by at most" in reported


def test_what_lerobot_deletes_splits_or_recomputes_is_read(copied: Path, tmp_path: Path) -> None:
    dataset = LeRobotDataset("local/pick", root=copied)
    recompute_stats(dataset)
    assert verify(copied, 0) == Verdict([], [])
    delete_episodes(dataset, [0], output_dir=tmp_path / "less", repo_id="local/less")
    split_dataset(dataset, {"train": [0], "val": [1]}, output_dir=tmp_path / "split")
    for root in (tmp_path / "less", *sorted((tmp_path / "split").iterdir())):
        verdict = verify(root)
        assert verdict.faults == []
        assert any("no column labutopia/seed" in text for text in verdict.unchecked)


def test_what_lerobot_resumes_is_read(picked: Path, tmp_path: Path) -> None:
    root = Path(shutil.copytree(picked, tmp_path / "dataset"))
    dataset = LeRobotDataset.resume("local/pick", root=root)
    zeros = {
        key: "" if feature["dtype"] == "string" else np.zeros(feature["shape"], feature["dtype"])
        for key, feature in dataset.features.items()
        if key not in ("timestamp", "frame_index", "episode_index", "index", "task_index")
    }
    for _ in range(5):
        dataset.add_frame({**zeros, "task": "Wave."})
    dataset.save_episode()
    dataset.finalize()
    verdict = verify(root)
    assert verdict.faults == []
    assert any("1 of 4 episodes have no labutopia/seed" in text for text in verdict.unchecked)
    assert [played.faithful for played in replay(root)] == [True] * 3


def test_a_dataset_without_seeds_cannot_be_replayed(copied: Path, tmp_path: Path) -> None:
    dataset = LeRobotDataset("local/pick", root=copied)
    delete_episodes(dataset, [0], output_dir=tmp_path / "less", repo_id="local/less")
    with pytest.raises(ForeignDatasetError, match="seeds"):
        list(replay(tmp_path / "less"))


def test_the_command_fails_for_faults_only(
    copied: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["labutopia-verify", str(copied), "--pictures", "0"])
    (copied / RECORDING).unlink()
    command.main()
    assert "Not checked: whether the recording is complete: meta/labutopia.json is missing" in (
        capsys.readouterr().out
    )
    os.truncate(next(copied.glob("videos/*/*/*.mp4")), 200)
    with pytest.raises(SystemExit) as ended:
        command.main()
    assert ended.value.code == 1
    assert "Fault: videos/" in capsys.readouterr().out
