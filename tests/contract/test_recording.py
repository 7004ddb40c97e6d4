"""Recording, as LeRobot and as the user see it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from lerobot.datasets.lerobot_dataset import LeRobotDataset

from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.datasets.declaration import dataset_features
from labutopia_lerobot.datasets.description import read_recording
from labutopia_lerobot.datasets.disk_space import NoSpaceError
from labutopia_lerobot.datasets.frames import Frames
from labutopia_lerobot.datasets.tables import (
    CAUSE,
    OUTCOME,
    SEED,
    SETTING,
    column,
    read_episodes,
    read_frames,
)
from labutopia_lerobot.datasets.trials import HopelessExpertError
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments.recipe import training_command
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from recordings import MOODY_TASK, PICK, Watch, assert_same_dataset, recording


@pytest.mark.parametrize(("fixture", "obs"), [("picked", "state"), ("filmed", "pixels")])
def test_lerobot_loads_it_with_the_declared_features(
    fixture: str, obs: str, request: pytest.FixtureRequest
) -> None:
    root = request.getfixturevalue(fixture)
    setting = Setting("level1/pick", obs, ("wrist", "front"), width=64, height=48)
    dataset = LeRobotDataset("local/pick", root=root)
    declared = dataset_features(setting)
    for key, feature in declared.items():
        assert tuple(dataset.features[key]["shape"]) == feature["shape"]
        assert dataset.features[key]["names"] == feature["names"]
        assert (key in dataset.meta.stats) == (feature["dtype"] != "string")  # words have none
    generated = {"timestamp", "frame_index", "episode_index", "index", "task_index"}
    assert dataset.features.keys() == declared.keys() | generated
    assert dataset.fps == 30
    assert len(dataset) == dataset.meta.total_frames > 300
    assert dataset[len(dataset) - 1]["task"] == canonical_task(setting).instruction


def test_exactly_the_wanted_successes_are_stored(picked: Path) -> None:
    rows = read_episodes(picked)
    assert [row[SEED] for row in rows] == [20, 21, 22]
    assert not (picked / ".recording").exists()


@pytest.mark.slow
def test_the_same_command_makes_the_same_bytes_in_whatever_order_python_keeps_its_sets(
    picked: Path, tmp_path: Path
) -> None:
    other = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    program = [sys.executable, "-m", "labutopia_lerobot.cli.record", *PICK, "workers=1"]
    environment = os.environ | {"PYTHONHASHSEED": other}
    subprocess.run([*program, f"root={tmp_path / 'dataset'}"], env=environment, check=True)
    assert_same_dataset(picked, tmp_path / "dataset")


def test_each_picture_shows_the_state_of_its_row(filmed: Path) -> None:
    dataset = LeRobotDataset("local/pick", root=filmed, video_backend="pyav")
    second = dataset.meta.episodes[1]
    env = LabEnv(Setting("level1/pick", width=64, height=48, cameras=("wrist",), split="train"))
    observation, _ = env.reset(seed=second[SEED])
    drawn, actions = [], []
    for index in range(second["dataset_from_index"], second["dataset_to_index"]):
        drawn.append(observation["pixels"]["wrist"] / 255.0)
        actions.append(dataset.hf_dataset[index]["action"].numpy())
        observation, *_ = env.step(actions[-1])
    env.close()
    moving = 100  # in mid-lift, where neighbouring frames differ
    stored = dataset[second["dataset_from_index"] + moving]["observation.images.wrist"]
    distance = [np.abs(stored.permute(1, 2, 0).numpy() - picture).mean() for picture in drawn]
    assert int(np.argmin(distance)) == moving
    assert distance[moving] < 0.02


def test_a_full_disk_is_reported_before_anything_is_played(tmp_path: Path) -> None:
    root, watch = tmp_path / "dataset", Watch()
    with pytest.raises(NoSpaceError, match=r"takes about \d+\.\d GB, but .* GB free"):
        recording(root, "task=level1/pick", "episodes=100000000", watch=watch)
    assert watch.indices == []


@pytest.mark.slow
def test_failures_are_kept_with_their_causes(tmp_path: Path) -> None:
    (tmp_path / "level1").mkdir()
    (tmp_path / "level1" / "moody.py").write_text(MOODY_TASK.format(limit=0.0))
    overrides = ["task=level1/moody", f"tasks_dir={tmp_path}", "obs=state", "episodes=2"]
    root = recording(tmp_path / "dataset", *overrides, "keep=failures")
    rows = read_episodes(root)
    causes = {row[OUTCOME]: row[CAUSE] for row in rows}
    assert causes == {"success": "", "expert failed": "sulk/sulk not done after 0.1 s"}
    assert [row[SEED] for row in rows] == list(range(len(rows)))
    assert sum(row[OUTCOME] == "success" for row in rows) == 2
    assert verify(root).faults == []


@pytest.mark.slow
def test_one_step_is_recorded_from_where_the_expert_comes_to_it(tmp_path: Path) -> None:
    overrides = ["task=level2/operate_drawer", "step=close", "obs=state", "episodes=1"]
    (config,) = parse(overrides).datasets()
    assert config.root == "outputs/datasets/level2/operate_drawer-close"
    root = recording(tmp_path / "dataset", *overrides)
    steps = column(read_frames(root), "annotation.step").tolist()
    assert set(steps) == {"close", ""}
    assert read_recording(root)["config"]["step"] == "close"
    (row,) = read_episodes(root)
    assert json.loads(row[SETTING])["step"] == "close"
    verdict = verify(root)
    assert (verdict.faults, verdict.unchecked) == ([], [])
    command = training_command("act", root, None, None, None)
    assert "--output_dir=outputs/train/act/level2/operate_drawer/close" in command
    with pytest.raises(UserError, match=r"no step 'shut'\. Steps of this task: open, close"):
        recording(tmp_path / "other", *overrides, "step=shut")


def test_every_frame_says_what_came_of_it_and_what_was_being_done(picked: Path) -> None:
    frames, (row, *_) = read_frames(picked), read_episodes(picked)
    last = row["length"] - 1
    for key in ("next.reward", "next.done", "next.success"):
        values = column(frames, key)[: last + 1, 0]
        assert np.flatnonzero(values).tolist() == [last]
    steps = column(frames, "annotation.step")[: last + 1].tolist()
    substeps = column(frames, "annotation.substep")[: last + 1].tolist()
    phases = column(frames, "annotation.phase")[: last + 1].tolist()
    assert list(dict.fromkeys(steps)) == ["pick", ""]
    assert list(dict.fromkeys(substeps)) == ["", "gripped", "lifted"]
    assert steps.index("") == substeps.index("lifted")
    labels = ["hover", "lower", "reach", "settle", "close", "lift", "hold"]
    assert list(dict.fromkeys(phases)) == [f"pick/{label}" for label in labels]


def test_a_command_beyond_the_limits_stands_beside_what_acted() -> None:
    env = LabEnv(Setting("level1/pick", obs="state"))
    observation, _ = env.reset(seed=0)
    frames, wild = Frames(env, "pixels"), np.full(8, 9.0, dtype=np.float32)
    frames.begin(observation)
    _, reward, terminated, truncated, info = env.step(wild)
    frames.end(wild, reward, terminated or truncated, info)
    columns = frames.columns()
    np.testing.assert_array_equal(columns["commanded_action"], [wild])
    np.testing.assert_array_equal(columns["action"], [info["applied_action"]])
    assert (columns["action"] < 9.0).all()


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_failures_are_listed_and_the_lowest_successes_stored(workers: int, tmp_path: Path) -> None:
    (tmp_path / "level1").mkdir()
    (tmp_path / "level1" / "moody.py").write_text(MOODY_TASK.format(limit=0.0))
    overrides = ["task=level1/moody", f"tasks_dir={tmp_path}", "obs=state", "episodes=3"]
    watch = Watch()
    root = recording(tmp_path / "dataset", *overrides, workers=workers, watch=watch)
    stored = [row[SEED] for row in read_episodes(root)]
    failed = read_recording(root)["failures"]
    env = LabEnv(Setting("level1/moody", obs="state", split="train", tasks_dir=tmp_path))
    sulks = []
    for seed in range(stored[-1] + 1):
        env.reset(seed=seed)
        sulks.append(env.workcell.world.frame("flask_rim").position_w[1] > 0.0)
    assert [seed for seed, sulk in enumerate(sulks) if not sulk] == stored
    assert [failure["seed"] for failure in failed] == np.flatnonzero(sulks).tolist()
    assert len(failed) > 0
    assert {failure["cause"] for failure in failed} == {"sulk/sulk not done after 0.1 s"}
    assert sorted(watch.indices) == list(range(stored[-1] + 1))


@pytest.mark.slow
def test_a_hopeless_expert_ends_the_recording(tmp_path: Path) -> None:
    (tmp_path / "level1").mkdir()
    (tmp_path / "level1" / "moody.py").write_text(MOODY_TASK.format(limit=-1.0))
    overrides = ["task=level1/moody", f"tasks_dir={tmp_path}", "obs=state"]
    with pytest.raises(HopelessExpertError, match="sulk/sulk not done after"):
        recording(tmp_path / "dataset", *overrides)


@pytest.mark.parametrize(
    ("overrides", "message"),
    [
        ([], "Name a task, such as task=level1/pick, or a level"),
        (["task=level1/pick", "episods=3"], "Did you mean 'episodes='?"),
        (["task=level1/pick", "episodes=many"], "'many'"),
        (["task=level1/pick", "+liquid=on"], "is no option"),
    ],
)
def test_a_wrong_override_is_explained(overrides: list[str], message: str) -> None:
    with pytest.raises(UserError, match=message.replace("?", r"\?")):
        parse(overrides)


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("task=level1/pik", "Did you mean 'level1/pick'"),
        ("obs=pictures", "pixels, state"),
        ("cameras=[wrist,side]", "front, top, wrist"),
        ("cameras=[top,top]", "twice"),
        ("episodes=0", "at least 1"),
        ("width=255", "even"),
    ],
)
def test_an_impossible_value_is_explained(override: str, message: str, tmp_path: Path) -> None:
    root = tmp_path / "dataset"
    with pytest.raises(UserError, match=message):
        recording(root, "task=level1/pick", override)
    assert not root.exists()


def test_the_command_line_has_no_traceback_and_leaves_no_litter(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "labutopia_lerobot.cli.record", "tusk=level1/pick"]
    wrong = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert wrong.returncode == 2
    assert "Did you mean 'task='?" in wrong.stderr
    assert "Traceback" not in wrong.stderr
    assert list(tmp_path.iterdir()) == []
