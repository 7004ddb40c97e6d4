"""A policy on the Hub: what plays it, with what it achieved; LeRobot plays it from there."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from huggingface_hub import ModelCard, constants

from labutopia_lerobot.evaluation.checkpoint_security import CheckpointError
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.origin import weight_hashes
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.hub.card import UnfinishedResultError
from labutopia_lerobot.hub.dataset import dataset_repository
from labutopia_lerobot.hub.policy import UnpublishablePolicyError, find_policy, policy_repository
from labutopia_lerobot.hub.publish import publish
from labutopia_lerobot.hub.repository import CARD, Repository
from loopback_hub import TOKEN, LoopbackHub

from .written_rows import written


def played(folder: Path, *rows: Row, finished: bool = True, step: str = "") -> LoadedResult:
    """Return a result that the weights in a folder played, or those of a step of its task."""
    hashes, _ = weight_hashes(folder, None)
    reported = {"folder": str(folder), "type": "act", "step": 700, "sha256": hashes}
    name = "/".join(filter(None, (rows[0].task, step)))
    return LoadedResult(
        Path("out"), finished, rows, {"checkpoints": {name: reported}, "config": {}}
    )


def won(policy: str = "act", **columns: object) -> list[Row]:
    """Return 50 episodes of level1/pick, 40 of which are successes of 6.25 s."""
    rows = written("level1/pick", policy, 1.0, n=50, obs="state")
    times = {"gripped": 2.0, "lifted": 4.0}
    return [
        replace(row, success=index < 40, seconds=6.25, substeps=times, **columns)  # type: ignore[arg-type]
        for index, row in enumerate(rows)
    ]


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


def test_its_card_says_what_it_achieved_to_people_and_to_the_hub(save_checkpoint):
    folder = save_checkpoint()
    reported = card(policy_repository(folder, "me/pick", [played(folder, *won())]))
    assert "| `level1/pick` | ID, state | 40 of 50 (95 %: 67 to 89 %) | 6.2 |" in reported.text
    assert "confidence sequence" not in reported.text
    (result,) = reported.data.eval_results
    assert (result.metric_type, result.metric_value) == ("success_rate", 0.8)
    assert result.dataset_name == "LabUtopia level1/pick, state"
    assert result.metric_config == (
        "task=level1/pick split=id axes=[] play=single step=null after=null liquid=null "
        "particles=null reasoner=null robot=panda room=laboratory obs=state renderer=null "
        "odometry=exact episodes=50"
    )
    assert "Not measured." in card(policy_repository(folder, "me/pick", ())).text


def test_results_under_several_conditions_are_several_results(save_checkpoint):
    folder = save_checkpoint()
    rows = [*won(), *won(split="ood", axes=["light"]), *won(step="pick"), *won(robot="iiwa")]
    result = played(folder, *rows)
    result.provenance["checkpoints"]["level1/pick/pick"] = result.provenance["checkpoints"][
        "level1/pick"
    ]
    reported = card(policy_repository(folder, "me/pick", [result]))
    of = {each.dataset_name: each.metric_config for each in reported.data.eval_results}
    assert of.keys() == {
        "LabUtopia level1/pick, state",
        "LabUtopia level1/pick, OOD light, state",
        "LabUtopia level1/pick, pick alone, state",
        "LabUtopia level1/pick, state, robot=iiwa",
    }
    assert "split=ood axes=[light]" in of["LabUtopia level1/pick, OOD light, state"]


def test_a_run_that_could_stop_early_shows_its_confidence_sequence(save_checkpoint):
    folder = save_checkpoint()
    result = played(folder, *won())
    result.provenance["config"]["until"] = 0.05
    reported = card(policy_repository(folder, "me/pick", [result])).text
    assert "40 of 50 (95 %: 67 to 89 %)" not in reported
    assert "confidence sequences" in reported


def test_what_other_weights_achieved_is_left_out_or_refused(save_checkpoint, tmp_path: Path):
    folder = save_checkpoint()
    own, expert = played(folder, *won()), played(folder, *won("expert"))
    expert.provenance["checkpoints"].clear()
    others = Path(shutil.copytree(folder, tmp_path / "others"))
    with (others / "model.safetensors").open("ab") as weights:
        weights.write(b" ")
    theirs = played(others, *won())
    reported = card(policy_repository(folder, "me/pick", [theirs, own, expert]))
    assert len(reported.data.eval_results) == 1
    staged = played(folder, *(replace(row, play="staged") for row in won()))
    with pytest.raises(UnpublishablePolicyError, match=r"nothing that the weights .* \(out: act;"):
        policy_repository(folder, "me/pick", [theirs, staged, expert])


def test_a_result_that_is_not_finished_is_on_no_card(save_checkpoint):
    folder = save_checkpoint()
    with pytest.raises(UnfinishedResultError, match=r"out is not finished \(50 episodes so far\)"):
        policy_repository(folder, "me/pick", [played(folder, *won(), finished=False)])


def test_a_result_that_is_not_finished_is_on_no_card_of_a_dataset_either(
    save_checkpoint, tmp_path: Path
):
    unfinished = played(save_checkpoint(), *won("expert"), finished=False)
    with pytest.raises(UnfinishedResultError, match="out is not finished"):
        dataset_repository(tmp_path, "me/pick", [unfinished])


def test_half_a_checkpoint_and_one_that_runs_code_are_refused(save_checkpoint):
    folder = save_checkpoint()
    steps = {"name": "x", "steps": [{"class": "os.system", "config": {}}]}
    (folder / "policy_preprocessor.json").write_text(json.dumps(steps))
    with pytest.raises(CheckpointError, match="refused"):
        policy_repository(folder, "me/pick", ())
    (folder / "model.safetensors").unlink()
    with pytest.raises(CheckpointError, match=r"lacks model\.safetensors"):
        policy_repository(folder, "me/pick", ())


@pytest.mark.slow
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
