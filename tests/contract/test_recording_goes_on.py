"""A recording that is killed, stopped or extended: nothing is lost, nothing is mixed."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from killing import killed_at_any_moment
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.description import read_recording, read_statistics
from labutopia_lerobot.datasets.recording_folder import RecordingFolderError
from labutopia_lerobot.datasets.tables import SEED, read_episodes, read_frames
from labutopia_lerobot.datasets.verify import find_problems
from labutopia_lerobot.runtime.video import video_size_and_frames
from recordings import FILM, MOODY_TASK, PICK, StoppedError, Watch, assert_same_dataset, recording


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.mark.slow
def test_stopped_while_assembling_it_resumes(filmed: Path, tmp_path: Path) -> None:
    root = tmp_path / "dataset"
    with pytest.raises(StoppedError):
        recording(root, *FILM, watch=Watch(assembled=1))
    assert_same_dataset(filmed, recording(root, *FILM))


@pytest.mark.slow
@pytest.mark.parametrize(
    "moved", [["videos"], ["videos", "data"], ["videos", "data", "meta"]], ids="-".join
)
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


@pytest.mark.slow
@pytest.mark.parametrize("fixture", ["picked", "stopped"])
def test_another_recording_is_refused_with_the_difference(
    fixture: str, request: pytest.FixtureRequest
) -> None:
    root = request.getfixturevalue(fixture)
    with pytest.raises(RecordingFolderError) as refusal:
        recording(root, "task=level1/pick", "obs=state", "episodes=1", "seed=20")
    assert f"episodes: {3 if fixture == 'picked' else 2} there, 1 here" in str(refusal.value)
    assert ("obs: 'pixels' there, 'state' here" in str(refusal.value)) == (fixture == "stopped")


@pytest.mark.slow
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
    reported = read_recording(recording(root, *overrides))
    assert {part: reported[part] for part in began} == began


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


@pytest.mark.slow  # the next one extends as well
def test_a_finished_recording_is_extended_to_the_one_that_is_longer(
    filmed: Path, tmp_path: Path
) -> None:
    longer = [*FILM, "episodes=3"]
    root, watch = Path(shutil.copytree(filmed, tmp_path / "dataset")), Watch()
    recording(root, *longer, watch=watch)
    assert watch.new == [2]
    at_once = recording(tmp_path / "at_once", *longer)
    assert read_frames(at_once).equals(read_frames(root))
    assert read_statistics(at_once) == read_statistics(root)
    # The same pictures, as their statistics tell; the encoder may pack them in other bytes.
    for film in at_once.rglob("*.mp4"):
        other = root / film.relative_to(at_once)
        assert video_size_and_frames(film) == video_size_and_frames(other)


@pytest.mark.slow
def test_an_extension_that_is_stopped_leaves_the_dataset_and_goes_on(
    picked: Path, tmp_path: Path
) -> None:
    longer = [*PICK, "episodes=4"]
    root = Path(shutil.copytree(picked, tmp_path / "dataset"))
    with pytest.raises(StoppedError):
        recording(root, *longer, watch=Watch(assembled=4))
    assert find_problems(root) == []
    assert len(read_episodes(root)) == 3
    watch = Watch()
    recording(root, *longer, watch=watch)
    assert watch.new == []
    assert [row[SEED] for row in read_episodes(root)] == [20, 21, 22, 23]


@pytest.mark.slow
def test_killed_at_ten_moments_it_ends_in_the_same_bytes(tmp_path: Path) -> None:
    program = [sys.executable, "-m", "labutopia_lerobot.cli.record", *FILM, "episodes=4"]
    whole, root = tmp_path / "whole", tmp_path / "dataset"
    begun = time.monotonic()
    subprocess.run([*program, f"root={whole}", "workers=2"], check=True)
    within = time.monotonic() - begun
    command = [*program, f"root={root}", "workers=2"]
    for _ in killed_at_any_moment(command, times=10, within=within, folder=tmp_path):
        assert_same_dataset(whole, root)
        shutil.rmtree(root)
