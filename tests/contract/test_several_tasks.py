"""Datasets of several tasks: recorded together, or merged by LeRobot's own tools."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from lerobot.datasets.aggregate import aggregate_datasets
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.datasets.multi_dataset import MultiLeRobotDataset

from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.datasets.declaration import (
    PRIVILEGED_SIZE,
    PRIVILEGED_STATE,
    PrivilegedSizeError,
    privileged_state,
    same_features,
)
from labutopia_lerobot.datasets.recording_config import RecordingOptionError
from labutopia_lerobot.datasets.replay import replay
from labutopia_lerobot.datasets.tables import (
    PRIVILEGED,
    SEED,
    column,
    episode_setting,
    read_episodes,
    read_frames,
)
from labutopia_lerobot.datasets.verify import Verdict, verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.registry import task_files, tasks_of_levels
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import Setting
from recordings import recording

TASKS = ["level1/open_drawer", "level1/pick"]
SMALL = ["episodes=1", "width=64", "height=48", "cameras=[front]"]


@pytest.fixture(scope="module")
def together(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two tasks recorded into one dataset."""
    root = tmp_path_factory.mktemp("together") / "dataset"
    return recording(root, f"task=[{','.join(TASKS)}]", "together=true", *SMALL)


@pytest.fixture(scope="module")
def apart(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same tasks, each in its own dataset, below one folder."""
    root = tmp_path_factory.mktemp("apart")
    for task in TASKS:
        recording(root / task, f"task={task}", *SMALL)
    return root


@pytest.mark.slow
def test_tasks_recorded_together_are_one_dataset(together: Path) -> None:
    assert verify(together) == Verdict([], [])
    dataset = LeRobotDataset("local/together", root=together)
    instructions = [canonical_task(Setting(task)).instruction for task in TASKS]
    assert dataset[0]["task"] == instructions[0]
    assert dataset[len(dataset) - 1]["task"] == instructions[1]
    settings = [episode_setting(row) for row in read_episodes(together)]
    assert [setting.task for setting in settings if setting is not None] == TASKS


@pytest.mark.slow
def test_their_frames_are_those_of_each_task_alone(together: Path, apart: Path) -> None:
    frames = read_frames(together)
    for row, task in zip(read_episodes(together), TASKS, strict=True):
        alone = read_frames(apart / task)
        part = frames.slice(row["dataset_from_index"], row["length"])
        for key in ("action", "observation.state", PRIVILEGED_STATE, "annotation.phase"):
            assert part[key].combine_chunks().equals(alone[key].combine_chunks()), key


def test_lerobot_merges_sets_of_different_tasks(apart: Path, tmp_path: Path) -> None:
    names = [f"local/{task.rpartition('/')[2]}" for task in TASKS]
    roots = [apart / task for task in TASKS]
    merged = tmp_path / "merged"
    aggregate_datasets(names, "local/merged", roots=roots, aggr_root=merged)
    verdict = verify(merged)
    assert verdict.faults == []
    assert verdict.unchecked == [
        "whether the recording is complete: meta/labutopia.json is missing"
    ]
    assert [row[SEED] for row in read_episodes(merged)] == [0, 0]
    assert all(played.faithful for played in replay(merged))


def test_lerobot_reads_sets_of_different_tasks_as_one(apart: Path) -> None:
    several = MultiLeRobotDataset(TASKS, root=apart, video_backend="pyav")
    assert several.disabled_features == set()
    lengths = [read_frames(apart / task).num_rows for task in TASKS]
    assert len(several) == sum(lengths)
    for index, task in ((0, TASKS[0]), (lengths[0], TASKS[1])):
        assert several[index]["task"] == canonical_task(Setting(task)).instruction


def test_privileged_state_is_that_of_the_environment_and_is_named(together: Path) -> None:
    row = read_episodes(together)[1]
    env = LabEnv(Setting("level1/pick", obs="state", split="train"))
    observation, _ = env.reset(seed=row[SEED])
    state = observation["environment_state"]
    stored = column(read_frames(together), PRIVILEGED_STATE)[row["dataset_from_index"]]
    np.testing.assert_array_equal(stored[: len(state)], state)
    assert not stored[len(state) :].any()
    assert stored.shape == (PRIVILEGED_SIZE,)
    names = environment_state_names(env.workcell.task)
    assert json.loads(row[PRIVILEGED]) == list(names)


def test_every_task_of_a_robot_fits_into_the_same_features() -> None:
    settings = [Setting(task) for task in task_files()]
    for robot in {setting.robot for setting in settings}:
        assert same_features([setting for setting in settings if setting.robot == robot])
    for task in task_files():
        state = np.zeros(len(environment_state_names(canonical_task(Setting(task)))), np.float32)
        privileged_state(state, "pixels")
    with pytest.raises(PrivilegedSizeError, match="obs=state"):
        privileged_state(np.zeros(PRIVILEGED_SIZE + 1, np.float32), "pixels")


def test_a_level_becomes_one_dataset_for_each_task() -> None:
    datasets = list(parse(["level=1", "obs=state", "root=/data"]).datasets())
    assert [dataset.tasks for dataset in datasets] == [[task] for task in tasks_of_levels([1])]
    assert [dataset.root for dataset in datasets] == [f"/data/{t}" for t in tasks_of_levels([1])]
    assert datasets[0].repo_id == "local/close_door"
    (both,) = parse(["level=[1,2]", "together=true"]).datasets()
    assert both.tasks == tasks_of_levels([1, 2])
    assert both.root == "outputs/datasets/level1+level2"
    (some,) = parse(["level=1", "task=[pick,place]", "together=true"]).datasets()
    assert some.tasks == ["level1/pick", "level1/place"]
    (one,) = parse(["level=1", "task=pick"]).datasets()
    assert (one.task, one.root) == ("level1/pick", "outputs/datasets/level1/pick")


def test_impossible_combinations_are_explained(tmp_path: Path) -> None:
    with pytest.raises(RecordingOptionError, match="obs=state cannot be recorded together"):
        recording(tmp_path / "a", "level=1", "together=true", "obs=state")
    with pytest.raises(RecordingOptionError, match="names one dataset"):
        list(parse(["level=1", "repo_id=me/level1"]).datasets())
    with pytest.raises(UserError, match="local, ray"):
        recording(tmp_path / "a", "task=level1/pick", "launcher=slurm")
    assert not (tmp_path / "a").exists()


def test_every_file_can_be_read_by_the_group(together: Path) -> None:
    mask = os.umask(0)
    os.umask(mask)
    modes = {path.stat().st_mode & 0o777 for path in together.rglob("*") if path.is_file()}
    assert modes == {0o666 & ~mask}
