"""Checkpoints that somebody made to do harm, or that are damaged: nobody is asked, nothing runs."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import tiny_act
from hostile.programs import run

type Damage = Callable[[Path], object]

CONFIG, WEIGHTS = "config.json", "model.safetensors"
BEFORE = "policy_preprocessor.json"
ADAPTER = "adapter_config.json"
LFS = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n"


def config(**changes: Any) -> Damage:
    """Change entries of the configuration."""
    return lambda folder: edit(folder / CONFIG, lambda reported: reported | changes)


def edit(file: Path, change: Callable[[Any], Any]) -> None:
    """Change what a JSON file holds."""
    file.write_text(json.dumps(change(json.loads(file.read_text()))))


def content(name: str, data: bytes) -> Damage:
    """Write something else into a file."""
    return lambda folder: (folder / name).write_bytes(data)


def step(**reported: Any) -> Damage:
    """Put a step before those of the processor."""
    return lambda folder: edit(folder / BEFORE, lambda said: said | {"steps": [reported]})


def adapter(**reported: Any) -> Damage:
    """Say that it is an adapter."""

    def change(folder: Path) -> None:
        said = {"peft_type": "LORA", "base_model_name_or_path": str(folder)} | reported
        (folder / ADAPTER).write_text(json.dumps(said))
        (folder / "adapter_model.safetensors").write_bytes(b"")

    return change


def fifo(name: str) -> Damage:
    """Put a pipe that nobody writes into in the place of a file."""

    def change(folder: Path) -> None:
        (folder / name).unlink()
        os.mkfifo(folder / name)

    return change


DAMAGED: dict[str, Damage] = {
    "no weights": lambda folder: (folder / WEIGHTS).unlink(),
    "empty weights": content(WEIGHTS, b""),
    "weights cut short": lambda folder: os.truncate(folder / WEIGHTS, 1000),
    "a pointer instead of weights": content(WEIGHTS, LFS),
    "the configuration is no JSON": content(CONFIG, b"{"),
    "the configuration is a list": content(CONFIG, b"[]"),
    "the configuration is nested without end": content(CONFIG, b"[" * 100_000),
    "the configuration is a pipe": fifo(CONFIG),
    "the type is a list": config(type=[]),
    "the type is unknown": config(type="wizard"),
    "the type runs other code": config(type="groot"),
    "other code is trusted": config(vision={"trust_remote_code": True}),
    "a thousand million layers": config(n_encoder_layers=10**9),
    "layers without end": config(n_encoder_layers=1e999),
    "a dimension of x": config(dim_model="x"),
    "inputs are a list": config(input_features=[]),
    "inputs have no shape": config(input_features={"observation.state": 5}),
    "an unknown entry": config(wizardry=1),
    "a step by its class": step(**{"class": "os.system", "registry_name": "x"}),
    "a step that is unknown": step(registry_name="wizard", config={}),
    "a step elsewhere": step(registry_name="normalizer_processor", state_file="../x.safetensors"),
    "a step that is pickled": step(registry_name="normalizer_processor", state_file="x.bin"),
    "a tokenizer of a stranger": step(
        registry_name="tokenizer_processor", config={"tokenizer_name": "evil-org/evil-tok"}
    ),
    "a tokenizer of 5": step(registry_name="tokenizer_processor", config={"tokenizer_name": 5}),
    "steps are a number": content(BEFORE, b'{"steps": 5}'),
    "an adapter that imports": adapter(megatron_config={"x": 1}),
    "an adapter of another kind": adapter(peft_type="ADALORA"),
    "an adapter of a stranger": adapter(base_model_name_or_path="evil-org/evil-base"),
    "an adapter of nobody": adapter(base_model_name_or_path=None),
    "a pattern that explodes": adapter(target_modules="(([a-z_.0-9]+)*)+!"),
    "a pattern that takes minutes": adapter(target_modules=".*.*.*.*.*.*x"),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A checkpoint that would play press in its privileged state."""
    return tiny_act.save(tmp_path / "policy", privileged=21)


FOUND_BY_A_WORKER = (
    "the type is unknown",
    "a dimension of x",
    "an unknown entry",
    "a step that is unknown",
)
"""Damage that LeRobot finds in a process that has yet to load it, as it does missing weights: it
takes 20 s to say so, and `make test` tries one of its kind."""


@pytest.mark.parametrize(
    "damage",
    [
        pytest.param(damage, id=name, marks=[pytest.mark.slow] * (name in FOUND_BY_A_WORKER))
        for name, damage in DAMAGED.items()
    ],
)
@pytest.mark.parametrize("program", ["evaluate", pytest.param("publish", marks=pytest.mark.slow)])
def test_a_damaged_checkpoint_is_refused(
    damage: Damage, program: str, folder: Path, tmp_path: Path
) -> None:
    damage(folder)
    ended = run(program, *arguments(program), folder=tmp_path, limit_s=60.0)
    assert ended.harmless, ended
    assert "Traceback" not in ended.output, ended
    if program == "evaluate":
        assert ended.refused, ended


def arguments(program: str) -> tuple[str, ...]:
    if program == "publish":
        return "policy", "--repo-id", "me/it", "--dry-run"
    played = ("task=level1/press", "policy.path=policy", "episodes=1", "workers=1", "videos=0")
    return (*played, "out=out", "policy.device=cpu")


def test_nothing_else_that_lies_there_is_sent(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "secret.json").write_text('{"token": "secret"}')
    (folder / "token.json").symlink_to(tmp_path / "secret.json")
    (folder / "train_config.json").write_text(
        json.dumps(
            {"output_dir": "/home/me/out", "dataset": {"root": "/home/me", "repo_id": "a/b"}}
        )
    )
    ended = run("publish", *arguments("publish"), folder=tmp_path)
    assert ended.status == 0, ended
    assert "token.json" not in ended.output
    assert "train_config.json" in ended.output


def test_a_published_policy_names_no_folder_of_the_machine(folder: Path) -> None:
    from labutopia_lerobot.hub.policy import policy_repository

    training = {"output_dir": "/home/me/out", "steps": 5, "dataset": {"root": "/home/me"}}
    (folder / "train_config.json").write_text(json.dumps(training))
    sent = policy_repository(folder, "me/it", []).files["train_config.json"]
    assert isinstance(sent, bytes)
    reported = {"output_dir": None, "steps": 5, "dataset": {"root": None}}
    assert json.loads(sent) == reported
