import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from torch.nn import Module

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.checkpoint import CheckpointError, open_checkpoint
from labutopia_lerobot.evaluation.find_checkpoint import find_checkpoint
from labutopia_lerobot.evaluation.jobs import EvaluationJob, trained_elsewhere
from labutopia_lerobot.evaluation.learned_policy import LearnedPolicy, UnusableWeightsError
from labutopia_lerobot.evaluation.policies import Action
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import Setting

from .conftest import Saver

TASK = "level1/pick"
SETTING = Setting(TASK, obs="state")


def test_a_checkpoint_plays_the_same_episode_twice(save_checkpoint: Saver) -> None:
    checkpoint = open_checkpoint(save_checkpoint(), "act", SETTING, device="cpu")
    first, second = (
        play(EvaluationJob(SETTING, "act", maker), 100_000)
        for maker in (checkpoint, open_checkpoint(checkpoint.folder, "act", SETTING, device="cpu"))
    )
    assert first.row == second.row
    assert (first.row.renderer, first.row.device) == (None, "cpu")


def test_a_policy_of_pictures_gets_its_own_cameras_in_its_own_size(save_checkpoint: Saver) -> None:
    checkpoint = open_checkpoint(save_checkpoint(cameras=("wrist", "top")), "act", SETTING)
    seen = checkpoint.setting
    assert (seen.obs, seen.width, seen.height) == ("pixels", 64, 64)
    assert sorted(seen.cameras) == ["top", "wrist"]


@pytest.mark.parametrize("depth", [0, 1, 3])
def test_a_checkpoint_step_or_output_folder_will_do(save_checkpoint: Saver, depth: int) -> None:
    folder = save_checkpoint()
    given = [folder, *folder.parents][depth]
    assert open_checkpoint(given, "act", SETTING).folder == folder


def test_a_folder_may_hold_one_policy_per_task(save_checkpoint: Saver, tmp_path: Path) -> None:
    output_dir = save_checkpoint().parents[2]
    (tmp_path / "many" / "level1").mkdir(parents=True)
    output_dir.rename(tmp_path / "many" / TASK)
    assert (tmp_path / "many" / TASK) in open_checkpoint(
        tmp_path / "many", "act", SETTING
    ).folder.parents


@pytest.mark.parametrize(
    ("features", "message"),
    [
        ({"action": 7}, r"`action` has 8 elements.* Choose the robot= of its dataset"),
        ({"state": 6}, "`observation.state` has 8 elements"),
        ({"privileged": 12}, "`observation.environment_state` has 13 elements"),
        ({"cameras": ("side",)}, "observation.images.side.*observation.images.front"),
    ],
)
def test_a_foreign_checkpoint_is_refused(
    save_checkpoint: Saver, features: dict[str, object], message: str
) -> None:
    with pytest.raises(CheckpointError, match=message):
        open_checkpoint(save_checkpoint(**features), "act", SETTING)


def test_other_observations_than_those_of_training_are_refused(save_checkpoint: Saver) -> None:
    with pytest.raises(CheckpointError, match="trained with obs=state"):
        open_checkpoint(save_checkpoint(), "act", SETTING, obs="pixels")


def test_another_type_of_policy_is_refused(save_checkpoint: Saver) -> None:
    with pytest.raises(CheckpointError, match="type 'act'"):
        open_checkpoint(save_checkpoint(), "diffusion", SETTING)


def test_pickled_weights_are_refused(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    (folder / "model.safetensors").rename(folder / "pytorch_model.bin")
    with pytest.raises(CheckpointError, match=r"pytorch_model\.bin.*can run any code"):
        open_checkpoint(folder, "act", SETTING)


def test_a_step_does_not_walk_through_the_network_to_say_that_nobody_trains(
    save_checkpoint: Saver, monkeypatch: pytest.MonkeyPatch
) -> None:
    env = LabEnv(SETTING)
    observation, _ = env.reset(seed=0)
    policy = LearnedPolicy(save_checkpoint(), "cpu")
    reported: list[Module] = []
    tell = Module.train

    def train(module: Module, mode: bool = True) -> Module:
        reported.append(module)
        return tell(module, mode)

    monkeypatch.setattr(Module, "train", train)
    policy.start(env, 0)
    action = policy.act(observation)
    assert not reported
    policy._policy.train()  # a policy that does this by itself is brought back by its next step
    policy.start(env, 0)
    assert (policy.act(observation) == action).all()
    assert not any(module.training for module in policy._policy.modules())


def test_what_was_trained_in_half_precision_acts_in_full_on_a_processor(
    save_checkpoint: Saver,
) -> None:
    env = LabEnv(SETTING)
    observation, _ = env.reset(seed=0)
    folder = save_checkpoint()

    def act() -> Action:
        policy = LearnedPolicy(folder, "cpu")
        policy.start(env, 0)
        return policy.act(observation)

    full = act()
    config = json.loads((folder / "config.json").read_text())
    (folder / "config.json").write_text(json.dumps(config | {"use_amp": True}))
    assert act().dtype == np.float32
    assert (act() == full).all()


def test_weights_of_another_size_are_refused(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    config = json.loads((folder / "config.json").read_text())
    (folder / "config.json").write_text(json.dumps(config | {"dim_model": 32}))
    with pytest.raises(UnusableWeightsError, match="size mismatch"):
        LearnedPolicy(folder, "cpu")


def test_an_absent_device_is_refused(save_checkpoint: Saver) -> None:
    with pytest.raises(UnusableWeightsError, match="abacus"):
        LearnedPolicy(save_checkpoint(), "abacus")


@pytest.mark.parametrize("obs", ["state", "pixels"])
@pytest.mark.parametrize("file", ["policy_preprocessor.json", "policy_postprocessor.json"])
def test_a_processor_that_runs_a_program_is_refused_before_it_does(
    save_checkpoint: Saver, tmp_path: Path, file: str, obs: str
) -> None:
    folder = save_checkpoint(cameras=("front",) if obs == "pixels" else ())
    mark = tmp_path / "mark"
    attack = {"class": "subprocess.run", "config": {"args": ["touch", str(mark)]}}
    (folder / file).write_text(json.dumps({"name": "x", "steps": [attack]}))
    with pytest.raises(CheckpointError, match=r"subprocess\.run.*can run any code"):
        open_checkpoint(folder, "act", SETTING)()
    with pytest.raises(CheckpointError, match=r"subprocess\.run.*can run any code"):
        LearnedPolicy(folder, "cpu")
    assert not mark.exists()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"class": "os.system"}, "can run any code"),
        ({"registry_name": None}, "no registry_name"),
        ({"state_file": "/stolen.safetensors"}, "not inside the checkpoint"),
        ({"state_file": "../../stolen.safetensors"}, "not inside the checkpoint"),
        ({"state_file": "statistics.pt"}, "no .safetensors"),
        ({"state_file": "absent.safetensors"}, "is missing"),
        ({"config": {"tokenizer_name": "~/anything"}}, "not inside the checkpoint"),
        ({"config": {"nested": [{"path": "..\\up"}]}}, "not inside the checkpoint"),
        ({"config": {"trust_remote_code": True}}, "code from elsewhere"),
    ],
)
def test_a_step_that_reaches_beyond_the_checkpoint_is_refused(
    save_checkpoint: Saver, change: dict[str, object], message: str
) -> None:
    folder = save_checkpoint()
    file = folder / "policy_postprocessor.json"
    content = json.loads(file.read_text())
    content["steps"][0] |= change
    file.write_text(json.dumps(content))
    with pytest.raises(CheckpointError, match=message):
        open_checkpoint(folder, "act", SETTING)


def test_a_processor_file_without_steps_is_refused(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    (folder / "policy_preprocessor.json").write_text('{"steps": {"a": 1}}')
    with pytest.raises(CheckpointError, match=r"steps: .* should be a list"):
        open_checkpoint(folder, "act", SETTING)


@pytest.mark.parametrize("thing", ["flask", "beaker"])
def test_elements_of_a_state_are_compared_by_name_while_the_dataset_is_there(
    save_checkpoint: Saver, tmp_path: Path, thing: str
) -> None:
    folder, root = save_checkpoint(), tmp_path / "dataset"
    names = [
        name.replace("flask", thing) for name in environment_state_names(canonical_task(SETTING))
    ]
    features = {"observation.environment_state": {"names": names}}
    (root / "meta").mkdir(parents=True)
    (root / "meta" / "info.json").write_text(json.dumps({"features": features}))
    dataset = {"repo_id": "local/pick", "root": str(root)}
    (folder / "train_config.json").write_text(json.dumps({"dataset": dataset}))
    if thing == "beaker":
        with pytest.raises(CheckpointError, match=r"has 'beaker\.x' for what is 'flask\.x'"):
            open_checkpoint(folder, "act", SETTING)
        (root / "meta" / "info.json").unlink()
    assert open_checkpoint(folder, "act", SETTING).folder == folder


@pytest.mark.parametrize("kept", [0, 1000])
def test_weights_that_are_cut_short_are_refused_before_anything_is_loaded(
    save_checkpoint: Saver, kept: int
) -> None:
    folder = save_checkpoint()
    os.truncate(folder / "model.safetensors", kept)
    with pytest.raises(CheckpointError, match="is damaged or cut short"):
        open_checkpoint(folder, "act", SETTING)


def test_what_a_training_did_not_see_must_be_hidden_from_it_again(save_checkpoint: Saver) -> None:
    blind = replace(SETTING, hidden=("sizes",))
    names = environment_state_names(canonical_task(SETTING), blind.hidden)
    folder = save_checkpoint(privileged=len(names))
    with pytest.raises(CheckpointError, match="Choose the hidden= of its dataset"):
        open_checkpoint(folder, "act", SETTING)
    assert open_checkpoint(folder, "act", blind).setting.hidden == ("sizes",)


def test_a_policy_of_another_task_says_so_where_its_recording_is_there(
    save_checkpoint: Saver, tmp_path: Path
) -> None:
    folder, root = save_checkpoint(), tmp_path / "dataset"
    dataset = {"repo_id": "local/place", "root": str(root)}
    (folder / "train_config.json").write_text(json.dumps({"dataset": dataset}))
    job = EvaluationJob(SETTING, "act", open_checkpoint(folder, "act", SETTING))
    assert list(trained_elsewhere([job])) == []  # nobody knows
    (root / "meta").mkdir(parents=True)
    for recorded, said in (("level1/place", 1), (TASK, 0), (["level1/place", TASK], 0)):
        (root / "meta" / "labutopia.json").write_text(json.dumps({"config": {"task": recorded}}))
        notes = list(trained_elsewhere([job]))
        assert notes == [f"{TASK}: the policy was trained on level1/place"] * said


def test_a_misspelt_path_asks_for_its_neighbour_and_a_recipe_trains_what_is_missing(
    save_checkpoint: Saver,
) -> None:
    given = save_checkpoint().parents[2].with_name("traind")
    with pytest.raises(
        CheckpointError, match=r"does not exist\. Did you mean 'trained'\?"
    ) as raised:
        find_checkpoint(str(given), None, TASK, None)
    assert "$(labutopia-recipe act outputs/datasets/level1/pick --epochs 200" in str(raised.value)
    with pytest.raises(CheckpointError, match=r"does not exist\. Make one") as raised:
        find_checkpoint("outputs/nothing/like/it", "tdmpc", TASK, None)
    assert "--policy.type=tdmpc --policy.push_to_hub=false " in str(raised.value)


def test_a_policy_with_a_recipe_for_states_alone_is_trained_on_states() -> None:
    with pytest.raises(CheckpointError, match=r"does not exist\. Make one") as raised:
        find_checkpoint("outputs/nothing/like/it", "mlp", TASK, None)
    assert f"labutopia-record task={TASK} obs=state\n  $(labutopia-recipe mlp " in str(raised.value)


def test_a_dataset_is_no_checkpoint_and_nothing_is_trained_into_it(tmp_path: Path) -> None:
    (tmp_path / "meta").mkdir()
    (tmp_path / "meta" / "info.json").write_text("{}")
    for path, what in [(tmp_path, "a dataset"), (tmp_path / "meta" / "info.json", "a file")]:
        with pytest.raises(CheckpointError, match=f"{path}, which is {what}") as raised:
            find_checkpoint(str(path), "act", TASK, "state")
        assert "--out outputs/train/act/level1/pick" in str(raised.value)
