"""The READMEs of the vision-language-action models: their commands, on tiny models of those names.

What is changed in a command is in `BRIEF`: fewer episodes, smaller pictures, fewer steps.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import torch
from huggingface_hub import constants
from safetensors.torch import load_file, save_file

import tiny_vla
from labutopia_lerobot.evaluation.checkpoint import open_checkpoint
from labutopia_lerobot.setting import Setting

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
LAST = "checkpoints/last/pretrained_model"
IMAGES = "observation.images."

BRIEF = {
    r"episodes=100": "episodes=2 width=64 height=64",
    r"--epochs 200\)": "--epochs 200) --steps=2 --batch_size=2 --num_workers=0 --eval_steps=0",
    r"(python eval/run.py .*)": r"\1 episodes=1 videos=0 workers=1",
}
RECORD, TRAIN, PLAY = range(3)


def commands(policy: str) -> list[str]:
    """Return the first block of a policy's README: record, train, play."""
    page = (ROOT / "policies" / policy / "README.md").read_text()
    block = page.split("```")[1].strip()
    for pattern, replacement in BRIEF.items():
        block, count = re.subn(pattern, replacement, block)
        assert count == 1, pattern
    return block.splitlines()


class Workshop:
    """A folder in which the commands are typed, with the tiny models in the cache of the Hub."""

    def __init__(self, folder: Path, home: Path) -> None:
        self.folder = folder
        programs = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        self.environment = {**tiny_vla.environment(home), "PATH": programs}
        (folder / "eval").symlink_to(ROOT / "eval")

    def type(self, command: str) -> "subprocess.CompletedProcess[str]":
        call = ["bash", "-c", command]
        return subprocess.run(
            call, cwd=self.folder, env=self.environment, capture_output=True, text=True
        )

    def run(self, command: str) -> None:
        done = self.type(command)
        assert done.returncode == 0, f"{command}\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}"

    def train(self, policy: str, out: str, *options: str) -> Path:
        """Run the training of a README with options added; return the checkpoint's folder."""
        self.run(" ".join([commands(policy)[TRAIN], f"--output_dir={out}", *options]))
        return self.folder / out / LAST

    def play(self, checkpoint: Path, out: str) -> list[dict[str, object]]:
        """Play a checkpoint by its path alone; return the rows."""
        brief = "episodes=1 videos=0 workers=1"
        self.run(f"python eval/run.py task=level1/pick policy.path={checkpoint} {brief} out={out}")
        return self.rows(self.folder / out)

    def rows(self, out: Path) -> list[dict[str, object]]:
        return [json.loads(line) for line in (out / "rows.jsonl").read_text().splitlines()]


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory, tiny_hub: Path) -> Workshop:
    workshop = Workshop(tmp_path_factory.mktemp("workshop"), tiny_hub)
    workshop.run(commands("smolvla")[RECORD])
    return workshop


def rename_map(checkpoint: Path) -> dict[str, str]:
    steps = json.loads((checkpoint / "policy_preprocessor.json").read_text())["steps"]
    (step,) = [s for s in steps if s["registry_name"] == "rename_observations_processor"]
    renames: dict[str, str] = step["config"]["rename_map"]
    return renames


def assert_played(row: dict[str, object]) -> None:
    """An episode ran, and what was commanded were numbers."""
    assert isinstance(row["steps"], int)
    assert row["steps"] > 0
    assert row["nonfinite_actions"] == 0


@pytest.fixture(scope="module")
def trained(workshop: Workshop) -> dict[str, Path]:
    """What the trainings of the READMEs, as they stand there, leave where `policy=` looks."""
    assert commands("pi0")[RECORD] == commands("smolvla")[RECORD]
    for policy in ("smolvla", "pi0"):
        workshop.run(commands(policy)[TRAIN])
    train = workshop.folder / "outputs" / "train"
    return {policy: train / policy / "level1/pick" / LAST for policy in ("smolvla", "pi0")}


@pytest.mark.parametrize("policy", ["smolvla", "pi0"])
def test_the_commands_of_the_readme_record_train_and_play(
    workshop: Workshop, trained: dict[str, Path], policy: str
) -> None:
    recipe = json.loads((ROOT / "policies" / policy / "train.json").read_text())
    assert rename_map(trained[policy]) == recipe["rename_map"]
    workshop.run(f"{commands(policy)[PLAY]} out={policy}")
    (row,) = workshop.rows(workshop.folder / policy)
    assert row["policy"] == policy
    assert_played(row)


def test_training_begins_with_the_base_model(trained: dict[str, Path], tiny_hub: Path) -> None:
    before = load_file(tiny_vla.cached(tiny_hub, tiny_vla.SMOLVLA) / "model.safetensors")
    after = load_file(trained["smolvla"] / "model.safetensors")
    moved = {name for name in before if not torch.equal(before[name], after[name])}
    assert "model.action_out_proj.weight" in moved
    assert not any("vision_model" in name for name in moved)  # frozen, as in the base model
    for name in moved:  # by no more than two steps at a rate of 1e-4 can
        torch.testing.assert_close(after[name], before[name], rtol=0, atol=1e-3)


def test_a_lora_adapter_is_played_on_the_base_model_that_it_names(
    workshop: Workshop, tiny_hub: Path
) -> None:
    adapter = workshop.train("smolvla", "lora", "--peft.method_type=LORA", "--peft.r=16")
    reported = json.loads((adapter / "adapter_config.json").read_text())
    assert (reported["base_model_name_or_path"], reported["r"]) == (tiny_vla.SMOLVLA, 16)
    assert not (adapter / "model.safetensors").exists()
    (row,) = workshop.play(adapter, "played-lora")
    assert_played(row)
    result = json.loads((workshop.folder / "played-lora" / "result.json").read_text())
    (played,) = result["provenance"]["checkpoints"].values()
    assert Path(played["base"]["folder"]) == tiny_vla.cached(tiny_hub, tiny_vla.SMOLVLA)


@pytest.fixture
def tiny_cache(tiny_hub: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let this process find in its cache what the workshop's commands find in theirs."""
    monkeypatch.setattr(constants, "HF_HUB_CACHE", str(tiny_hub / "hub"))


@pytest.mark.usefixtures("tiny_cache")
def test_a_camera_that_was_not_recorded_leaves_its_slot_empty(workshop: Workshop) -> None:
    two = "cameras=[front,top] root=outputs/datasets/two"
    workshop.run(f"{commands('smolvla')[RECORD]} {two}")
    dataset = "--dataset.root=outputs/datasets/two"
    blank = f"--policy.path={tiny_vla.SMOLVLA}", "--policy.empty_cameras=1"
    checkpoint = workshop.train("smolvla", "two", dataset, *blank)
    inputs = json.loads((checkpoint / "config.json").read_text())["input_features"]
    assert {f"{IMAGES}camera3", f"{IMAGES}empty_camera_0"} <= inputs.keys()
    opened = open_checkpoint(checkpoint, None, Setting("level1/pick"))
    assert opened.setting.cameras == ("front", "top")
    (row,) = workshop.play(checkpoint, "played-two")
    assert_played(row)


@pytest.mark.usefixtures("tiny_cache")
def test_a_camera_that_is_mapped_to_itself_leaves_its_slot_empty(workshop: Workshop) -> None:
    itself = json.dumps({f"{IMAGES}wrist": f"{IMAGES}wrist"})  # LeRobot adds it to the recipe's
    checkpoint = workshop.train("smolvla", "itself", f"--rename_map='{itself}'")
    assert rename_map(checkpoint)[f"{IMAGES}front"] == f"{IMAGES}camera1"
    opened = open_checkpoint(checkpoint, None, Setting("level1/pick"))
    assert opened.setting.cameras == ("front", "top")


def test_pi05_is_the_same_with_another_base_model(workshop: Workshop) -> None:
    checkpoint = workshop.train("pi0", "pi05", "--policy.path=lerobot/pi05_base")
    (row,) = workshop.play(checkpoint, "played-pi05")
    assert row["policy"] == "pi05"
    assert_played(row)


def test_weights_that_lerobot_would_silently_do_without_are_refused(
    workshop: Workshop, trained: dict[str, Path]
) -> None:
    broken = shutil.copytree(trained["pi0"].resolve(), workshop.folder / "broken")
    weights = load_file(broken / "model.safetensors")
    weights.pop("model.action_out_proj.weight")
    save_file(weights, broken / "model.safetensors")
    done = workshop.type(f"python eval/run.py task=level1/pick policy.path={broken} episodes=1")
    assert done.returncode == 2
    assert "broken cannot be loaded: Could not load state dict" in done.stderr
    assert "action_out_proj.weight" in done.stderr
