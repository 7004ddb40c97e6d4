"""Whatever LeRobot loads is played: other types, adapters, models of the Hub, slots left empty."""

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import huggingface_hub.constants
import numpy as np
import pytest
import torch
from lerobot.configs import FeatureType, PolicyFeature
from lerobot.policies import make_pre_post_processors
from lerobot.policies.act.modeling_act import ACTPolicy
from lerobot.policies.vqbet.configuration_vqbet import VQBeTConfig
from lerobot.policies.vqbet.modeling_vqbet import VQBeTPolicy
from safetensors.torch import load_file, save_file

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.checkpoint import Checkpoint, open_checkpoint
from labutopia_lerobot.evaluation.checkpoint_security import FOREIGN_CODE, CheckpointError
from labutopia_lerobot.evaluation.policies import Action
from labutopia_lerobot.setting import Setting

from .conftest import Saver

STATE = Setting("level1/pick", obs="state")


def first_action(checkpoint: Checkpoint) -> Action:
    env = LabEnv(checkpoint.setting)
    observation, _ = env.reset(seed=0)
    policy = checkpoint()
    policy.start(env, 0)
    return policy.act(observation)


def edit(file: Path, **changes: object) -> None:
    file.write_text(json.dumps(json.loads(file.read_text()) | changes))


def test_the_type_stands_in_the_checkpoint(save_checkpoint: Saver) -> None:
    assert open_checkpoint(save_checkpoint(), None, STATE).type == "act"


def test_vqbet_is_played(tmp_path: Path) -> None:
    inputs = {
        "observation.state": PolicyFeature(FeatureType.STATE, (8,)),
        "observation.images.front": PolicyFeature(FeatureType.VISUAL, (3, 64, 64)),
    }
    config = VQBeTConfig(
        input_features=inputs,
        output_features={"action": PolicyFeature(FeatureType.ACTION, (8,))},
        device="cpu",
        push_to_hub=False,
        pretrained_backbone_weights=None,
        n_obs_steps=2,
        crop_shape=(56, 56),
        gpt_input_dim=32,
        gpt_output_dim=32,
        gpt_hidden_dim=32,
        gpt_n_layer=1,
        gpt_n_head=2,
        vqvae_embedding_dim=16,
        vqvae_enc_hidden_dim=16,
    )
    statistics = {
        "observation.state": {"min": -torch.ones(8), "max": torch.ones(8)},
        "action": {"min": -torch.ones(8), "max": torch.ones(8)},
    }
    VQBeTPolicy(config).save_pretrained(tmp_path)
    for processor in make_pre_post_processors(config, dataset_stats=statistics):
        processor.save_pretrained(tmp_path)
    checkpoint = open_checkpoint(tmp_path, None, Setting("level1/pick"), device="cpu")
    assert (checkpoint.type, checkpoint.setting.cameras) == ("vqbet", ("front",))
    assert np.isfinite(first_action(checkpoint)).all()


def test_an_unknown_type_is_reported(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    edit(folder / "config.json", type="oracle")
    from labutopia_lerobot.evaluation.learned_policy import UnusableWeightsError

    with pytest.raises(UnusableWeightsError, match=r"'oracle'.*not registered"):
        open_checkpoint(folder, None, STATE)()


@pytest.fixture
def adapter(save_checkpoint: Saver, tmp_path: Path) -> Path:
    """A LoRA adapter of a tiny ACT, saved as `lerobot-train --peft.method_type=LORA` saves it."""
    from peft import LoraConfig, get_peft_model

    base, folder = save_checkpoint(), tmp_path / "adapter"
    policy = ACTPolicy.from_pretrained(base)
    policy.name_or_path = str(base)
    torch.manual_seed(1)
    lora = LoraConfig(r=2, target_modules=["action_head"], init_lora_weights=False)
    get_peft_model(policy, lora).save_pretrained(folder)
    for file in base.iterdir():
        if file.name != "model.safetensors":
            shutil.copy(file, folder)
    edit(folder / "config.json", use_peft=True)
    return folder


def test_a_lora_adapter_changes_what_its_base_does(adapter: Path, save_checkpoint: Saver) -> None:
    checkpoint = open_checkpoint(adapter, "act", STATE, device="cpu")
    base = open_checkpoint(save_checkpoint(), "act", STATE, device="cpu")
    assert checkpoint.base == base.folder
    adapted, plain = first_action(checkpoint), first_action(base)
    assert np.isfinite(adapted).all()
    assert not np.allclose(adapted, plain)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"peft_type": "IA3"}, "peft_type='IA3' is not one of LORA"),
        ({"megatron_config": {"x": 1}, "megatron_core": "antigravity"}, "it has megatron_config"),
        ({"base_model_name_or_path": None}, "does not name the policy that it adapts"),
        ({"base_model_name_or_path": "/nowhere"}, "/nowhere, which is not there"),
    ],
)
def test_an_adapter_that_cannot_be_trusted_or_used_is_refused(
    adapter: Path, changes: dict[str, object], message: str
) -> None:
    edit(adapter / "adapter_config.json", **changes)
    with pytest.raises(CheckpointError, match=message):
        open_checkpoint(adapter, "act", STATE)


def test_the_base_of_an_adapter_is_read_as_any_checkpoint_is(adapter: Path) -> None:
    base = Path(
        json.loads((adapter / "adapter_config.json").read_text())["base_model_name_or_path"]
    )
    edit(base / "config.json", type="groot")
    with pytest.raises(CheckpointError, match="code from elsewhere for policies of type 'groot'"):
        open_checkpoint(adapter, "act", STATE)


def test_policies_for_which_lerobot_trusts_foreign_code_are_known() -> None:
    import lerobot.policies

    folder = Path(lerobot.policies.__file__).parent
    trusting = {
        file.relative_to(folder).parts[0]
        for file in folder.rglob("*.py")
        for line in file.read_text().splitlines()
        if "trust_remote_code" in line.partition("#")[0] and "True" in line
    }
    assert trusting == FOREIGN_CODE


def test_the_words_of_policies_that_go_on_without_their_weights_are_known() -> None:
    import lerobot.policies

    from labutopia_lerobot.evaluation.learned_policy import NOT_LOADED

    folder = Path(lerobot.policies.__file__).parent
    silent = {f.parent.name for f in folder.rglob("*.py") if 'print(f"Warning:' in f.read_text()}
    known = {f.parent.name for f in folder.rglob("*.py") if NOT_LOADED in f.read_text()}
    assert silent == known == {"pi0", "pi05", "pi0_fast"}


def test_a_step_that_trusts_foreign_code_by_default_is_refused(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    steps = json.loads((folder / "policy_preprocessor.json").read_text())["steps"]
    tokens = {
        "registry_name": "action_tokenizer_processor",
        "config": {"action_tokenizer_name": "a"},
    }
    edit(folder / "policy_preprocessor.json", steps=[*steps, tokens])
    with pytest.raises(CheckpointError, match="trust_remote_code, its default"):
        open_checkpoint(folder, "act", STATE)


@pytest.fixture
def padded(save_checkpoint: Saver) -> Callable[..., Path]:
    """Save what a vision-language-action model with three slots for cameras has in JSON."""

    def save(renames: dict[str, str]) -> Path:
        folder = save_checkpoint(cameras=("camera1", "camera2", "camera3"))
        edit(folder / "config.json", max_state_dim=32)
        file = folder / "policy_preprocessor.json"
        steps = json.loads(file.read_text())["steps"]
        for step in steps:
            if step["registry_name"] == "rename_observations_processor":
                step["config"] = {"rename_map": renames}
        edit(file, steps=steps)
        return folder

    return save


FRONT_AND_TOP = {
    "observation.images.front": "observation.images.camera2",
    "observation.images.top": "observation.images.camera1",
}


def test_a_slot_that_training_left_empty_stays_empty(padded: Callable[..., Path]) -> None:
    checkpoint = open_checkpoint(padded(FRONT_AND_TOP), "act", Setting("level1/pick"))
    assert checkpoint.setting.cameras == ("top", "front")


def test_a_camera_that_the_training_did_not_have_fills_no_slot(
    padded: Callable[..., Path],
) -> None:
    wrist = {"observation.images.wrist": "observation.images.camera3"}
    folder = padded(FRONT_AND_TOP | wrist)
    (state,) = folder.glob("policy_preprocessor_*_normalizer_processor.safetensors")
    statistics, of = load_file(state), {after: before for before, after in FRONT_AND_TOP.items()}
    parts = {name: name.rpartition(".") for name in statistics if "camera3" not in name}
    save_file({of.get(k, k) + f".{s}": statistics[n] for n, (k, _, s) in parts.items()}, state)
    checkpoint = open_checkpoint(folder, "act", Setting("level1/pick"))
    assert checkpoint.setting.cameras == ("top", "front")


def test_a_rename_map_of_the_users_own_replaces_that_of_training(
    padded: Callable[..., Path],
) -> None:
    folder = padded({})
    with pytest.raises(CheckpointError, match=r"'policy\.rename=\{observation\.images\.front: "):
        open_checkpoint(folder, "act", Setting("level1/pick"))
    checkpoint = open_checkpoint(folder, "act", Setting("level1/pick"), rename=FRONT_AND_TOP)
    assert checkpoint.setting.cameras == ("top", "front")
    assert dict(checkpoint.rename or ()) == FRONT_AND_TOP


@pytest.fixture
def hub(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of the Hub, without a network."""
    monkeypatch.setattr(huggingface_hub.constants, "HF_HUB_CACHE", str(tmp_path / "hub"))
    monkeypatch.setattr(huggingface_hub.constants, "HF_HUB_OFFLINE", True)
    return tmp_path / "hub"


def test_a_hub_id_is_played_from_the_cache(save_checkpoint: Saver, hub: Path) -> None:
    revision = "0" * 40
    model = hub / "models--someone--picker"
    shutil.copytree(save_checkpoint(), model / "snapshots" / revision)
    (model / "refs").mkdir()
    (model / "refs" / "main").write_text(revision)
    checkpoint = open_checkpoint("someone/picker", None, STATE, device="cpu")
    assert checkpoint.folder.name == revision
    assert np.isfinite(first_action(checkpoint)).all()


@pytest.mark.parametrize("name", ["someone/else", "someone/else@v2"])
def test_without_a_network_a_hub_id_says_how_to_get_it(hub: Path, name: str) -> None:
    with pytest.raises(CheckpointError, match=r"cannot be reached.*hf download someone/else"):
        open_checkpoint(name, None, STATE)


def test_weights_that_were_averaged_over_the_training_are_played(save_checkpoint: Saver) -> None:
    folder = save_checkpoint()
    average = folder.with_name("pretrained_model_ema")
    shutil.copytree(folder, average)
    assert open_checkpoint(folder.parents[2], None, STATE).folder == average
    assert open_checkpoint(folder, None, STATE).folder == folder


def test_opening_a_checkpoint_imports_no_torch(save_checkpoint: Saver) -> None:
    program = (
        "import sys\n"
        "from labutopia_lerobot.evaluation.checkpoint import open_checkpoint\n"
        "from labutopia_lerobot.setting import Setting\n"
        f"open_checkpoint({str(save_checkpoint())!r}, None, Setting('level1/pick', obs='state'))\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
