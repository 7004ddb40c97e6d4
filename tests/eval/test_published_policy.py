"""A policy on the Hub: what plays it, with what it achieved; LeRobot plays it from there."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from huggingface_hub import ModelCard, constants

from labutopia_lerobot.evaluation.harmless import CheckpointError
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.evaluation.uncertainty.proportion import wilson
from labutopia_lerobot.hub.policy import UnpublishablePolicyError, find_policy, policy_repository
from labutopia_lerobot.hub.publish import publish
from labutopia_lerobot.hub.repository import CARD, Repository
from loopback_hub import TOKEN, LoopbackHub


def summary(policy: str = "act") -> Summary:
    return Summary(
        task="level1/pick",
        split="id",
        policy=policy,
        play="single",
        obs="state",
        liquid=None,
        n=50,
        successes=40,
        rate=0.8,
        wilson95=wilson(40, 50),
        ever_rate=0.9,
        substep_rates={},
        mean_seconds_to_success=6.25,
        outcomes={"success": 40, "timeout": 10},
    )


def card(repository: Repository) -> ModelCard:
    content = repository.files[CARD]
    assert isinstance(content, bytes)
    return ModelCard(content.decode())


def test_a_policy_is_sent_without_what_only_training_needs(save_checkpoint):
    folder = save_checkpoint()
    (folder / "optimizer.pt").write_bytes(b"secret")
    assert find_policy(folder.parents[2]) == folder.parents[2] / "checkpoints/last/pretrained_model"
    names = policy_repository(folder, "me/pick", ()).files.keys()
    assert {"config.json", "model.safetensors", "policy_preprocessor.json", CARD} <= names
    assert "optimizer.pt" not in names


def test_its_card_tells_what_it_achieved_to_people_and_to_the_hub(save_checkpoint):
    told = card(policy_repository(save_checkpoint(), "me/pick", [summary(), summary("expert")]))
    assert "| `level1/pick` | id | state | none | 40 of 50 (95 %: 67 to 89 %) | 6.2 |" in told.text
    (result,) = told.data.eval_results
    assert (result.metric_type, result.metric_value) == ("success_rate", 0.8)
    assert result.dataset_name == "LabUtopia level1/pick"
    assert "Not measured." in card(policy_repository(save_checkpoint(), "me/pick", ())).text


def test_results_of_another_policy_are_refused(save_checkpoint):
    with pytest.raises(UnpublishablePolicyError, match=r"of expert, and .* of type act"):
        policy_repository(save_checkpoint(), "me/pick", [summary("expert")])


def test_half_a_checkpoint_and_one_that_runs_code_are_refused(save_checkpoint):
    folder = save_checkpoint()
    steps = {"name": "x", "steps": [{"class": "os.system", "config": {}}]}
    (folder / "policy_preprocessor.json").write_text(json.dumps(steps))
    with pytest.raises(CheckpointError, match="refused"):
        policy_repository(folder, "me/pick", ())
    (folder / "model.safetensors").unlink()
    with pytest.raises(CheckpointError, match=r"lacks model\.safetensors"):
        policy_repository(folder, "me/pick", ())


def test_lerobot_plays_it_from_the_hub(save_checkpoint, tmp_path: Path, monkeypatch):
    with LoopbackHub() as hub:
        monkeypatch.setenv("HF_TOKEN", TOKEN)
        monkeypatch.setattr(constants, "ENDPOINT", hub.endpoint)
        monkeypatch.setattr(constants, "HF_HUB_DISABLE_XET", True)
        monkeypatch.setattr(constants, "HF_HUB_OFFLINE", False)
        repository = policy_repository(save_checkpoint(), "me/pick", ())
        publish(repository, "me/pick", private=True, replace=False)
        program = Path(sys.executable).parent / "lerobot-eval"
        done = subprocess.run(
            [
                *(program, "--policy.path=me/pick", "--policy.device=cpu"),
                *("--env.type=labutopia", "--env.task=level1/pick", "--env.obs=state"),
                *("--eval.n_episodes=1", "--eval.batch_size=1", f"--output_dir={tmp_path}/eval"),
            ],
            env=os.environ | hub.environment(tmp_path / "home"),
            capture_output=True,
            text=True,
            check=False,
        )
    assert done.returncode == 0, done.stderr[-3000:]
    assert json.loads((tmp_path / "eval/eval_info.json").read_text())["overall"]["n_episodes"] == 1
