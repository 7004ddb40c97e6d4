"""Recording, as LeRobot and as the user see it."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from lerobot.datasets.lerobot_dataset import LeRobotDataset

from labutopia_lerobot.cli.recipe import training_command
from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.declaration import dataset_features
from labutopia_lerobot.datasets.disk_space import NoSpaceError
from labutopia_lerobot.datasets.frames import Frames
from labutopia_lerobot.datasets.recording_folder import RecordingFolderError
from labutopia_lerobot.datasets.tables import (
    CAUSE,
    OUTCOME,
    RECORDING,
    SEED,
    SETTING,
    column,
    read_episodes,
    read_frames,
    read_json,
)
from labutopia_lerobot.datasets.trials import HopelessExpertError
from labutopia_lerobot.datasets.verify import find_problems, verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.video import video_size_and_frames
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from recordings import FILM, PICK, StoppedError, Watch, assert_same_dataset, recording

MOODY_TASK = """
import dataclasses
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.tasks.level1.pick import pick

class Sulk:
    def phases(self, world):
        if world.frame("flask_rim").position_w[1] > {limit}:
            never = lambda world, target, elapsed: False
            yield Phase("sulk", lambda w: w.gripper, 0.08, never, timeout_s=0.1)

def moody():
    (step,) = pick().steps
    return dataclasses.replace(
        pick(), steps=(dataclasses.replace(step, skills=(Sulk(), *step.skills)),)
    )
"""


@pytest.mark.parametrize(("fixture", "obs"), [("picked", "state"), ("filmed", "pixels")])
def test_lerobot_loads_it_with_the_declared_features(
    fixture: str, obs: str, request: pytest.FixtureRequest
) -> None:
    root = request.getfixturevalue(fixture)
    setting = Setting("level1/pick", obs, ("wrist", "front"), 64, 48)
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


def test_the_number_of_workers_changes_nothing(picked: Path, tmp_path: Path) -> None:
    assert_same_dataset(picked, recording(tmp_path / "one", *PICK, workers=1))


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


def test_killed_while_playing_it_resumes_without_loss(picked: Path, tmp_path: Path) -> None:
    root = tmp_path / "dataset"
    command = [sys.executable, "-m", "labutopia_lerobot.cli.record", *PICK, f"root={root}"]
    process = subprocess.Popen(
        [*command, "workers=2"], start_new_session=True, stderr=subprocess.DEVNULL
    )
    wait_until(lambda: any(root.glob(".recording/candidate_*")))
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert not (root / "meta").exists()
    watch = Watch()
    recording(root, *PICK, watch=watch)
    assert sorted(watch.indices) == [0, 1, 2]
    assert_same_dataset(picked, root)


def test_workers_end_when_the_recorder_is_killed(tmp_path: Path) -> None:
    root = tmp_path / "dataset"
    arguments = ["task=level1/pick", "obs=state", "episodes=1000", f"root={root}", "workers=1"]
    process = subprocess.Popen(
        [sys.executable, "-m", "labutopia_lerobot.cli.record", *arguments],
        start_new_session=True,
        stderr=subprocess.DEVNULL,
    )
    wait_until(lambda: any(root.glob(".recording/candidate_*")))
    process.kill()
    process.wait()
    wait_until(lambda: not group_exists(process.pid))


def group_exists(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def wait_until(condition: Callable[[], bool], seconds: float = 60.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_stopped_while_assembling_it_resumes(filmed: Path, tmp_path: Path) -> None:
    root = tmp_path / "dataset"
    with pytest.raises(StoppedError):
        recording(root, *FILM, watch=Watch(assembled=1))
    assert_same_dataset(filmed, recording(root, *FILM))


@pytest.mark.parametrize("moved", [["videos"], ["videos", "data"], ["videos", "data", "meta"]])
def test_killed_while_moving_it_resumes(
    moved: list[str], filmed: Path, tmp_path: Path, stopped: Path
) -> None:
    root = Path(shutil.copytree(stopped, tmp_path / "dataset"))
    for part in moved:
        shutil.copytree(filmed / part, root / part)
    assert_same_dataset(filmed, recording(root, *FILM))


@pytest.fixture(scope="module")
def stopped(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording with pictures that was stopped when everything was played."""
    root = tmp_path_factory.mktemp("stopped") / "dataset"
    with pytest.raises(StoppedError):
        recording(root, *FILM, watch=Watch(assembled=2))
    return root


def test_a_finished_folder_is_refused(picked: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in picked.rglob("*")}
    with pytest.raises(RecordingFolderError, match="finished"):
        recording(picked, *PICK)
    assert {path: path.stat().st_mtime_ns for path in picked.rglob("*")} == before


def test_a_leftover_of_a_finished_recording_is_cleaned_away(picked: Path, tmp_path: Path) -> None:
    root = Path(shutil.copytree(picked, tmp_path / "dataset"))
    (root / ".recording.discarded").mkdir()
    with pytest.raises(RecordingFolderError, match="finished"):
        recording(root, *PICK)
    assert not (root / ".recording.discarded").exists()


@pytest.mark.parametrize("fixture", ["picked", "stopped"])
def test_another_recording_is_refused_with_the_difference(
    fixture: str, request: pytest.FixtureRequest
) -> None:
    root = request.getfixturevalue(fixture)
    with pytest.raises(RecordingFolderError) as refusal:
        recording(root, "task=level1/pick", "obs=state", "episodes=1", "seed=20")
    assert f"episodes: {3 if fixture == 'picked' else 2} there, 1 here" in str(refusal.value)
    assert ("obs: 'pixels' there, 'state' here" in str(refusal.value)) == (fixture == "stopped")


def test_other_code_does_not_go_on_with_a_recording(tmp_path: Path) -> None:
    (tmp_path / "level1").mkdir()
    task = tmp_path / "level1" / "moody.py"
    task.write_text(MOODY_TASK.format(limit=9.0))
    overrides = ["task=level1/moody", f"tasks_dir={tmp_path}", "obs=state", "episodes=2"]
    root = tmp_path / "dataset"
    with pytest.raises(StoppedError):
        recording(root, *overrides, workers=1, watch=Watch(played=1))
    task.write_text(MOODY_TASK.format(limit=8.0))
    with pytest.raises(RecordingFolderError, match=r"code\.tasks\.level1/moody: '\w{64}' there"):
        recording(root, *overrides)
    task.write_text(MOODY_TASK.format(limit=9.0))
    manifest = root / ".recording" / "recording.json"
    began = json.loads(manifest.read_text())
    for part, name in (
        ("code", "commit"),
        ("code", "sources"),
        ("versions", "scipy"),
        ("versions", "mujoco"),
    ):
        other = began | {part: began[part] | {name: "of yesterday"}}
        manifest.write_text(json.dumps(other))
        with pytest.raises(RecordingFolderError, match=rf"{part}\.{name}: 'of yesterday' there"):
            recording(root, *overrides)
    manifest.write_text(json.dumps(began))
    told = read_json(recording(root, *overrides), RECORDING)
    assert {part: told[part] for part in began} == began


def test_a_foreign_folder_is_refused_and_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(RecordingFolderError, match=r"thesis\.txt"):
        recording(tmp_path, *PICK)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_folder_being_recorded_is_refused(tmp_path: Path) -> None:
    class Second(Watch):
        def resumed(self, candidates: Sequence[Candidate]) -> None:
            recording(tmp_path / "dataset", *PICK)

    with pytest.raises(RecordingFolderError, match="in use by another process"):
        recording(tmp_path / "dataset", *PICK, watch=Second())


def test_a_finished_recording_is_extended_to_the_one_that_is_longer(
    filmed: Path, tmp_path: Path
) -> None:
    longer = [*FILM, "episodes=3"]
    root, watch = Path(shutil.copytree(filmed, tmp_path / "dataset")), Watch()
    recording(root, *longer, watch=watch)
    assert watch.new == [2]
    at_once = recording(tmp_path / "at_once", *longer)
    assert read_frames(at_once).equals(read_frames(root))
    assert read_json(at_once, "meta/stats.json") == read_json(root, "meta/stats.json")
    # The same pictures, as their statistics tell; the encoder may pack them in other bytes.
    for film in at_once.rglob("*.mp4"):
        other = root / film.relative_to(at_once)
        assert video_size_and_frames(film) == video_size_and_frames(other)


def test_an_extension_that_is_stopped_leaves_the_dataset_and_goes_on(
    picked: Path, tmp_path: Path
) -> None:
    longer = [*PICK, "episodes=4"]
    root = Path(shutil.copytree(picked, tmp_path / "dataset"))
    with pytest.raises(StoppedError):
        recording(root, *longer, watch=Watch(assembled=1))
    assert find_problems(root) == []
    assert len(read_episodes(root)) == 3
    watch = Watch()
    recording(root, *longer, watch=watch)
    assert watch.new == []
    assert [row[SEED] for row in read_episodes(root)] == [20, 21, 22, 23]


def test_a_full_disk_is_told_before_anything_is_played(tmp_path: Path) -> None:
    root, watch = tmp_path / "dataset", Watch()
    with pytest.raises(NoSpaceError, match=r"takes about \d+\.\d GB, but .* GB free"):
        recording(root, "task=level1/pick", "episodes=100000000", watch=watch)
    assert watch.indices == []


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


def test_one_step_is_recorded_from_where_the_expert_comes_to_it(tmp_path: Path) -> None:
    overrides = ["task=level2/operate_drawer", "step=close", "obs=state", "episodes=1"]
    (config,) = parse(overrides).datasets()
    assert config.root == "outputs/datasets/level2/operate_drawer-close"
    root = recording(tmp_path / "dataset", *overrides)
    steps = column(read_frames(root), "annotation.step").tolist()
    assert set(steps) == {"close", ""}
    assert read_json(root, RECORDING)["config"]["step"] == "close"
    (row,) = read_episodes(root)
    assert json.loads(row[SETTING])["step"] == "close"
    verdict = verify(root)
    assert (verdict.faults, verdict.unchecked) == ([], [])
    assert "--output_dir=outputs/train/act/" + f"{tmp_path.name}/dataset/close" in training_command(
        "act", root, None, None, None
    )
    with pytest.raises(UserError, match=r"no step 'shut'\. Steps of this task: open, close"):
        recording(tmp_path / "other", *overrides, "step=shut")


def test_every_frame_tells_what_came_of_it_and_what_was_being_done(picked: Path) -> None:
    frames, (row, *_) = read_frames(picked), read_episodes(picked)
    last = row["length"] - 1
    for key in ("next.reward", "next.done", "next.success"):
        values = column(frames, key)[: last + 1, 0]
        assert np.flatnonzero(values).tolist() == [last]
    steps = column(frames, "annotation.step")[: last + 1].tolist()
    milestones = column(frames, "annotation.milestone")[: last + 1].tolist()
    phases = column(frames, "annotation.phase")[: last + 1].tolist()
    assert list(dict.fromkeys(steps)) == ["pick", ""]
    assert list(dict.fromkeys(milestones)) == ["", "gripped", "lifted"]
    assert steps.index("") == milestones.index("lifted")
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
def test_killed_at_ten_moments_it_ends_in_the_same_bytes(tmp_path: Path) -> None:
    options = [*FILM, "episodes=4"]
    whole = recording(tmp_path / "whole", *options)
    root, rng = tmp_path / "dataset", np.random.default_rng(0)
    command = [sys.executable, "-m", "labutopia_lerobot.cli.record", *options, f"root={root}"]
    kills = 0
    while not (root / RECORDING).exists() or (root / ".recording").exists():
        before = time.monotonic()
        process = subprocess.Popen(
            [*command, "workers=2"], start_new_session=True, stderr=subprocess.DEVNULL
        )
        if kills == 10:
            assert process.wait() == 0
            break
        # At any moment: before, while candidates are played, while they are put together.
        patience = rng.uniform(0.0, 30.0)
        while process.poll() is None and time.monotonic() - before < patience:
            time.sleep(0.05)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            kills += 1
    assert kills > 0
    assert_same_dataset(whole, root)


@pytest.mark.parametrize("workers", [1, 3])
def test_failures_are_listed_and_the_lowest_successes_stored(workers: int, tmp_path: Path) -> None:
    (tmp_path / "level1").mkdir()
    (tmp_path / "level1" / "moody.py").write_text(MOODY_TASK.format(limit=0.0))
    overrides = ["task=level1/moody", f"tasks_dir={tmp_path}", "obs=state", "episodes=3"]
    watch = Watch()
    root = recording(tmp_path / "dataset", *overrides, workers=workers, watch=watch)
    stored = [row[SEED] for row in read_episodes(root)]
    failed = read_json(root, RECORDING)["failures"]
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
    command = [sys.executable, "-m", "labutopia_lerobot.cli.record"]
    wrong = subprocess.run(
        [*command, "tusk=level1/pick"], cwd=tmp_path, capture_output=True, text=True
    )
    assert wrong.returncode == 2
    assert "Did you mean 'task='?" in wrong.stderr
    assert "Traceback" not in wrong.stderr
    assert list(tmp_path.iterdir()) == []
    right = [*command, "task=level1/pick", "episodes=1", "obs=state", "workers=1"]
    subprocess.run(right, cwd=tmp_path, check=True)
    assert [path.name for path in tmp_path.iterdir()] == ["outputs"]
    assert find_problems(tmp_path / "outputs/datasets/level1/pick") == []
