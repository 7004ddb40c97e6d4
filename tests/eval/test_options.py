"""What the command line of the evaluator means."""

from io import StringIO

import pytest
from rich.console import Console

from labutopia_lerobot.cli.evaluate import parse
from labutopia_lerobot.evaluation.config import (
    EvaluationConfig,
    EvaluationOptionError,
    PolicyConfig,
)
from labutopia_lerobot.evaluation.jobs import make_jobs
from labutopia_lerobot.evaluation.run import LiveProgress
from labutopia_lerobot.registry import UnknownTaskError
from labutopia_lerobot.runtime import bars
from labutopia_lerobot.setting import UnknownOptionError

from .test_statistics import row


def test_a_checkpoint_alone_names_the_policy() -> None:
    assert parse(["policy.path=org/name", "task=level1/pick"]).policy == PolicyConfig(
        None, "org/name"
    )


def test_keys_are_renamed_on_the_command_line() -> None:
    rename = "policy.rename={observation.images.front: observation/image}"
    config = parse(["policy.path=x", rename])
    assert config.policy.rename == {"observation.images.front": "observation/image"}
    with pytest.raises(EvaluationOptionError, match="is no map of keys"):
        parse(["policy.path=x", "policy.rename=[a,b]"]).check()


def test_a_policy_elsewhere_is_asked_by_one_worker_unless_set_otherwise() -> None:
    remote = ["policy=remote", "policy.address=there:8000"]
    config = parse(remote)
    assert (config.policy.name, config.policy.protocol, config.workers) == ("remote", "lerobot", 1)
    config = parse([*remote, "policy.protocol=openpi", "workers=3", "cameras=front"])
    assert (config.policy.protocol, config.workers) == ("openpi", 3)
    assert getattr(config, "cameras", None) == ["front"]


def test_tasks_are_named_one_by_one_too_each_is_played_once() -> None:
    named = ["level4/clean_beaker", "level1/pick"]
    assert parse([f"task=[{','.join(named)}]", "policy=expert"]).tasks == named
    assert parse(["task=[pick,level1/pick]", "level=1", "policy=expert"]).tasks == ["level1/pick"]
    with pytest.raises(UnknownTaskError, match="level1/pik"):
        _ = parse(["task=[level1/pick,level1/pik]", "policy=expert"]).tasks


@pytest.mark.parametrize("word", ["episodes=3.5", "seed=abc"])
def test_a_value_of_the_wrong_type_is_said_with_its_option(word: str) -> None:
    option = word.partition("=")[0]
    with pytest.raises(EvaluationOptionError, match=rf"^{option}: Value '.*' of type"):
        parse(["task=level1/pick", "policy=expert", word])


def test_what_a_task_does_not_have_is_refused_before_anything_is_played() -> None:
    with pytest.raises(UnknownOptionError, match=r"hidden=\[handles\]: .* has none"):
        make_jobs(parse(["task=level1/press", "policy=expert", "obs=state", "hidden=[handles]"]))


@pytest.fixture
def lines(monkeypatch: pytest.MonkeyPatch) -> StringIO:
    monkeypatch.setattr(bars, "_LOG_S", 0.0)
    return StringIO()


def test_a_log_file_says_rate_time_left_and_running_success(lines: StringIO) -> None:
    jobs = make_jobs(EvaluationConfig(policy=PolicyConfig("still"), task="level1/pick"))
    console = Console(file=lines, width=200)
    with LiveProgress(jobs, 4, console) as progress:
        progress.known([row(0, "success", ever=True, lifted=2.0)])
        progress.played(row(1, "timeout", ever=False, lifted=None))
        progress.played(row(2, "success", ever=True, lifted=2.0))
    first, second = lines.getvalue().splitlines()
    assert first.startswith("Playing 2/4, ")
    assert "episodes/min, 0.0 min left; level1/pick id: 1/2 succeeded, 50 %" in first
    assert second.endswith("level1/pick id: 2/3 succeeded, 67 %")


def test_a_terminal_shows_a_bar_for_every_task(lines: StringIO) -> None:
    jobs = make_jobs(EvaluationConfig(policy=PolicyConfig("still"), task="level1/pick"))
    console = Console(file=lines, force_terminal=True, width=200)
    with LiveProgress(jobs, 1, console) as progress:
        progress.played(row(0, "success", ever=True, lifted=2.0))
    shown = lines.getvalue()
    assert "level1/pick id" in shown
    assert "1/1 succeeded, 100 %" in shown
    assert "episodes/min" in shown
