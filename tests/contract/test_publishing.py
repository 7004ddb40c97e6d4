"""Publishing: what arrives on the Hub, what readers make of it, what is said when it does not."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from huggingface_hub import constants

from labutopia_lerobot.cli import publish as program
from labutopia_lerobot.hub.dataset import dataset_repository
from labutopia_lerobot.hub.envhub.env import make_env
from labutopia_lerobot.hub.environment_repository import environment_repository
from labutopia_lerobot.hub.hub_errors import HubError
from labutopia_lerobot.hub.publish import OccupiedRepositoryError, RepoIdError, publish
from labutopia_lerobot.hub.repository import CARD, Repository
from loopback_hub import TOKEN, Fault, LoopbackHub

SMALL = Repository(
    "model", {CARD: b"---\nlicense: mit\n---\n", "a.safetensors": b"a", "b.safetensors": b"b"}, "v1"
)
ME = "me/thing"


@pytest.fixture
def hub(monkeypatch: pytest.MonkeyPatch) -> Iterator[LoopbackHub]:
    """A Hub that this process talks to."""
    with LoopbackHub() as hub:
        monkeypatch.setenv("HF_TOKEN", TOKEN)
        monkeypatch.setattr(constants, "ENDPOINT", hub.endpoint)
        monkeypatch.setattr(constants, "HF_HUB_DISABLE_XET", True)
        monkeypatch.setattr(constants, "HF_HUB_OFFLINE", False)
        yield hub


def send(repository: Repository = SMALL, private: bool = False, replace: bool = False) -> str:
    return publish(repository, ME, private=private, replace=replace)


def run(hub: LoopbackHub, home: Path, *command: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, *command],
        env=os.environ | hub.environment(home),
        capture_output=True,
        text=True,
        check=False,
    )


READ_BACK = """
import sys
import datasets, torch
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.datasets.streaming_dataset import StreamingLeRobotDataset

here = LeRobotDataset("local/pick", root=sys.argv[1], video_backend="pyav")
there = LeRobotDataset("me/pick", video_backend="pyav")
assert there.root != here.root and len(there) == len(here)
for index in (0, len(here) // 2, len(here) - 1):
    for key, value in here[index].items():
        same = torch.equal(value, there[index][key]) if torch.is_tensor(value) else (
            value == there[index][key])
        assert same, key
table = datasets.load_dataset("me/pick", split="train")
assert table.num_rows == len(here) and table[0]["action"] == here[0]["action"].tolist()
sent = LeRobotDataset("me/sent")  # LeRobot needs FFmpeg's libraries to stream pictures
streamed = next(iter(StreamingLeRobotDataset("me/sent", shuffle=False)))
assert torch.equal(streamed["observation.environment_state"],
                   sent[int(streamed["index"])]["observation.environment_state"])
"""


@pytest.mark.slow
def test_a_published_dataset_is_read_back_from_the_hub(
    filmed: Path,
    picked: Path,
    tmp_path: Path,
    hub: LoopbackHub,
    monkeypatch: pytest.MonkeyPatch,
    capsys,
) -> None:
    monkeypatch.setattr(sys, "argv", ["labutopia-publish", str(filmed), "--repo-id", "me/pick"])
    program.main()
    assert f"{hub.endpoint}/datasets/me/pick/commit/" in capsys.readouterr().out
    repo = hub.repos["datasets", "me/pick"]
    here = {str(p.relative_to(filmed)): p for p in filmed.rglob("*") if p.is_file()}
    assert repo.files.keys() - here.keys() == {".gitattributes", CARD, "assets/strip.jpg"}
    assert all(repo.files[path].data == file.read_bytes() for path, file in here.items())
    assert repo.tags == {"v3.0": repo.refs["main"]}
    assert not repo.private
    program.publish(
        dataset_repository(picked, "me/sent", ()), "me/sent", private=True, replace=False
    )
    read = run(hub, tmp_path, "-c", READ_BACK, str(filmed))
    assert read.returncode == 0, read.stderr


def test_a_damaged_dataset_is_not_published(
    filmed: Path, tmp_path: Path, hub: LoopbackHub, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    (tmp_path / "meta").mkdir()
    (tmp_path / "meta/info.json").write_bytes((filmed / "meta/info.json").read_bytes())
    monkeypatch.setattr(sys, "argv", ["labutopia-publish", str(tmp_path), "--repo-id", ME])
    with pytest.raises(SystemExit, match="2"):
        program.main()
    assert "meta/episodes" in capsys.readouterr().err
    assert not hub.requests


def test_a_dry_run_lists_every_file_and_asks_nothing(
    filmed: Path, hub: LoopbackHub, monkeypatch: pytest.MonkeyPatch, capsys, tmp_path: Path
) -> None:
    card = tmp_path / "cards/pick.md"
    arguments = ["labutopia-publish", str(filmed), "--repo-id", ME, "--private", "--dry-run"]
    monkeypatch.setattr(sys, "argv", [*arguments, "--card", str(card)])
    program.main()
    *files, reported = capsys.readouterr().out.splitlines()
    sizes = {line.split()[1]: int(line.split()[0].replace(",", "")) for line in files}
    for file in filmed.rglob("*"):
        if file.is_file():
            assert sizes.pop(str(file.relative_to(filmed))) == file.stat().st_size
    assert sizes.keys() == {CARD, "assets/strip.jpg"}
    assert sizes[CARD] == card.stat().st_size
    assert "# LabUtopia level1/pick" in card.read_text()
    assert f"{len(files)} files" in reported
    assert f"dataset {ME} (private), tag v3.0. Nothing was sent" in reported
    assert not hub.requests


@pytest.mark.parametrize("private", [False, True])
def test_it_is_public_unless_private_is_asked_for(hub: LoopbackHub, private: bool) -> None:
    send(private=private)
    assert hub.repos["models", ME].private == private


def test_what_everybody_sees_does_not_take_what_is_private(hub: LoopbackHub) -> None:
    send()
    with pytest.raises(OccupiedRepositoryError, match="everybody sees it"):
        send(private=True)


def test_something_else_is_replaced_only_when_asked(hub: LoopbackHub) -> None:
    send(Repository("model", {CARD: SMALL.files[CARD], "b.safetensors": b"!", "c.json": b"{}"}))
    with pytest.raises(OccupiedRepositoryError, match=r"c\.json, b\.safetensors of something else"):
        send()
    send(replace=True)
    repo = hub.repos["models", ME]
    assert repo.files.keys() == SMALL.files.keys() | {".gitattributes"}
    assert repo.files["b.safetensors"].data == b"b"


@pytest.mark.parametrize(
    ("pattern", "status", "reported"),
    [
        ("create", 401, "does not accept the token.*hf auth login"),
        ("create", 403, "may not write to me/thing.*another --repo-id"),
        ("commit", 409, "taken, or somebody else"),
        ("commit", 412, "somebody else is changing it"),
        ("commit", 429, "fewer requests.*what has arrived is not sent again"),
        ("commit", 500, "trouble of its own.*what has arrived is not sent again"),
        ("commit", None, "does not answer.*what has arrived is not sent again"),
    ],
)
def test_a_refusal_of_the_hub_is_reported_with_its_cure(
    hub: LoopbackHub, pattern: str, status: int | None, reported: str
) -> None:
    hub.faults = [Fault(pattern, status)]
    with pytest.raises(HubError, match=f"(?s){reported}"):
        send()
    send()
    assert hub.repos["models", ME].files.keys() > SMALL.files.keys()


def test_an_upload_that_fails_is_reported_as_what_it_is(hub: LoopbackHub) -> None:
    hub.faults = [Fault("PUT /lfs", 403)]
    with pytest.raises(HubError, match="may not write"):
        send()


def test_one_hiccup_of_the_hub_is_survived(hub: LoopbackHub) -> None:
    hub.faults = [Fault("PUT /lfs", 500)]
    send()


def test_what_has_arrived_is_not_sent_again(hub: LoopbackHub) -> None:
    hub.faults = [Fault("commit", None)]
    with pytest.raises(HubError):
        send()
    sent = [request for request in hub.requests if request.startswith("PUT")]
    assert len(sent) == 2
    assert hub.repos["models", ME].files.keys() == {".gitattributes"}
    send()
    assert [request for request in hub.requests if request.startswith("PUT")] == sent


def test_an_interruption_before_the_tag_is_made_good(hub: LoopbackHub) -> None:
    hub.faults = [Fault("POST .*/tag", 500)]
    with pytest.raises(HubError):
        send()
    repo = hub.repos["models", ME]
    assert repo.tags == {}
    send()
    assert repo.tags == {"v1": repo.refs["main"]}


def test_without_a_token_nothing_is_asked(
    hub: LoopbackHub, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("HF_TOKEN")
    monkeypatch.setattr(constants, "HF_TOKEN_PATH", str(tmp_path / "none"))
    with pytest.raises(HubError, match="hf auth login"):
        send()
    assert not hub.requests


def test_no_network_is_reported(hub: LoopbackHub, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(constants, "ENDPOINT", "http://127.0.0.1:9")
    with pytest.raises(HubError, match=r"127\.0\.0\.1:9 does not answer"):
        send()
    monkeypatch.setattr(constants, "HF_HUB_OFFLINE", True)
    with pytest.raises(HubError, match="HF_HUB_OFFLINE=1"):
        send()


@pytest.mark.parametrize("name", ["thing", "me/a/b", "me/..", "me/thing.git"])
def test_an_impossible_name_is_refused(name: str) -> None:
    with pytest.raises(RepoIdError, match="--repo-id"):
        publish(SMALL, name, private=False, replace=False)


MAKE = """
from lerobot.envs import make_env

suites = make_env("me/labutopia-env", n_envs=1, trust_remote_code=True)
assert len(suites["level1"]) == 10, suites.keys()
envs = suites["level1"]["press"]
observation, info = envs.reset(seed=[7])
assert observation["pixels"]["front"].shape == (1, 256, 256, 3)
assert set(envs.call("task")) == {"Press the red button on the control panel and keep it pressed."}
"""


@pytest.mark.slow
def test_lerobot_makes_our_environments_from_the_hub(hub: LoopbackHub, tmp_path: Path) -> None:
    repository = environment_repository("me/labutopia-env")
    publish(repository, "me/labutopia-env", private=False, replace=False)
    made = run(hub, tmp_path, "-c", MAKE)
    assert made.returncode == 0, made.stderr


def test_the_environments_of_a_configuration_are_those_it_names() -> None:
    suites = make_env(cfg=SimpleNamespace(task="level1/pick,level1/press", obs="pixels", width=64))
    assert {level: list(envs) for level, envs in suites.items()} == {"level1": ["pick", "press"]}
    assert suites["level1"]["pick"].single_observation_space["pixels"]["top"].shape == (256, 64, 3)
