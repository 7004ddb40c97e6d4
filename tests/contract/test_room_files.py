"""A room in a file is played in like one of the package; nothing that is written holds its path."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from labutopia_lerobot.cli import publish, replay, verify
from labutopia_lerobot.cli.evaluate import parse as evaluated
from labutopia_lerobot.datasets.description import read_recording
from labutopia_lerobot.datasets.tables import read_episodes, setting_column
from labutopia_lerobot.datasets.verification.environment import _replay
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.origin import origin
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.scenario.own_files import OwnFiles
from labutopia_lerobot.scenes import NoWorkPlaceError, UnknownRoomError, load_room, room_files
from labutopia_lerobot.scenes.plans import PlanError, text_of
from labutopia_lerobot.setting import Setting
from recordings import recording
from small_room import ROOM

PRESS = "level1/press"


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rooms") / "mine.json"
    path.write_text(text_of(ROOM))
    return path


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory, file: Path) -> Path:
    root = tmp_path_factory.mktemp("datasets") / "press"
    return recording(root, f"task={PRESS}", "obs=state", "episodes=1", f"room={file}", workers=1)


def described_room(room: Path | str) -> str:
    """Return what a dataset calls a room."""
    return json.loads(setting_column(Setting(PRESS, room=str(room))))["room"]


@pytest.fixture
def stranger(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that has not read the file."""
    monkeypatch.setattr(room_files, "_read", {})
    room_files._label.cache_clear()


def test_an_environment_stands_in_the_room_of_a_file(file: Path) -> None:
    env = LabEnv(Setting(PRESS, obs="state", room=str(file)))
    env.reset(seed=0)
    assert env.workcell.simulation.scene.room.name == ROOM.name


def test_rooms_in_files_are_called_by_their_content(file: Path, tmp_path: Path) -> None:
    label = described_room(file)
    assert re.fullmatch(r"mine@[0-9a-f]{8}", label)
    elsewhere, other = tmp_path / "mine.json", tmp_path / "other" / "mine.json"
    elsewhere.write_text(file.read_text())
    other.parent.mkdir()
    other.write_text(text_of(replace(ROOM, wall="cream")))
    assert described_room(elsewhere) == label
    assert described_room(other) != label
    assert described_room("organic_7") == "organic_7"


def test_an_evaluation_writes_no_path(file: Path) -> None:
    config = evaluated([PRESS, "policy=expert", f"room={file}"])
    jobs = make_jobs(config)
    label = room_files.room_label(str(file))
    assert jobs[0].condition.room == label
    assert origin(config, jobs)["config"]["room"] == label


def test_a_dataset_holds_no_path_and_is_replayed_with_the_file(
    file: Path,
    dataset: Path,
    stranger: None,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    label = read_recording(dataset)["config"]["room"]
    (episode,) = read_episodes(dataset)
    assert str(file) not in json.dumps(episode)
    assert label in json.dumps(episode)
    monkeypatch.setattr("sys.argv", ["labutopia-replay", str(dataset)])
    with pytest.raises(SystemExit, match="2"):
        replay.main()
    reported = capsys.readouterr().err
    assert f"room='{label}' is a room of somebody's own" in reported
    assert "--room FILE.json" in reported
    monkeypatch.setattr("sys.argv", ["labutopia-replay", str(dataset), f"room={file}"])
    with pytest.raises(SystemExit, match="False"):
        replay.main()
    assert "1 of 1 ended as they were recorded" in capsys.readouterr().out
    monkeypatch.setattr("sys.argv", ["labutopia-verify", str(dataset), "--room", str(file)])
    verify.main()
    subject = VerifiedDataset.of(dataset, own_files=OwnFiles(room=str(file)))
    assert list(in_processes(_replay, [(subject, 0)], 1)) == [[(0, [])]]


def test_a_dataset_in_a_room_of_ones_own_is_not_published(
    dataset: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    line = ["labutopia-publish", str(dataset), "repo_id=me/press", "dry_run=true"]
    monkeypatch.setattr("sys.argv", line)
    with pytest.raises(SystemExit, match="2"):
        publish.main()
    assert "was recorded in a room of your own, mine@" in capsys.readouterr().err


def test_what_is_no_room_is_reported(tmp_path: Path) -> None:
    with pytest.raises(UnknownRoomError, match=r"A room of your own: room=FILE\.json"):
        load_room("organic_42")
    with pytest.raises(PlanError, match=r"none\.json cannot be read"):
        load_room(str(tmp_path / "none.json"))
    empty = tmp_path / "empty.json"
    empty.write_text(text_of(replace(ROOM, work_places=())))
    with pytest.raises(NoWorkPlaceError, match="has no work place"):
        load_room(str(empty))
