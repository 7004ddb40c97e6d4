"""SmolVLA and pi0 with a few thousand random weights, under the names that the real ones have.

A program, since the caches of Hugging Face are named in the environment before they are imported:
`HF_HOME=HOME python tests/tiny_vla.py` fills them, and commands that run with `environment(HOME)`
find the models as if the Hub had been asked once. What the base models observe and how they are
configured is that of the real ones (their config.json); only the networks are small.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

VLM = "HuggingFaceTB/SmolVLM2-500M-Video-Instruct"
SMOLVLA = "lerobot/smolvla_base"
PALIGEMMA = "google/paligemma-3b-pt-224"
PI0, PI05 = "lerobot/pi0_base", "lerobot/pi05_base"

PLUGIN = "lerobot_policy_tiny_pi0"
SNAPSHOT = "0" * 40
NAMED_TOKENS = {
    "image_token": "<image>",
    "fake_image_token": "<fake_token_around_image>",
    "global_image_token": "<global-img>",
    "end_of_utterance_token": "<end_of_utterance>",
}


def environment(home: Path) -> dict[str, str]:
    """Return what makes a program find the models, without a network."""
    return {
        **os.environ,
        "HF_HOME": str(home),
        "HF_HUB_OFFLINE": "1",
        "TOKENIZERS_PARALLELISM": "false",
        "PYTHONPATH": os.pathsep.join([str(home / "plugins"), os.environ.get("PYTHONPATH", "")]),
    }


def build(home: Path) -> Path:
    """Fill the caches below a new folder, in a process of its own; return the folder."""
    plugin, distribution = home / "plugins" / f"{PLUGIN}.py", home / f"plugins/{PLUGIN}-0.dist-info"
    distribution.mkdir(parents=True)
    shutil.copy(Path(__file__).with_name("tiny_pi0.py"), plugin)
    (distribution / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {PLUGIN}\nVersion: 0\n")
    subprocess.run([sys.executable, __file__], env=environment(home), check=True)
    return home


def cached(home: Path, name: str) -> Path:
    """Return the folder that the cache has for a model."""
    return home / "hub" / f"models--{name.replace('/', '--')}" / "snapshots" / SNAPSHOT


def snapshot(name: str) -> Path:
    """Return the folder that the cache has for a model, made current."""
    folder = cached(Path(os.environ["HF_HOME"]), name)
    branches = folder.parents[1] / "refs"
    branches.mkdir(parents=True, exist_ok=True)
    (branches / "main").write_text(SNAPSHOT)
    return folder


def save_tokenizer(folder: Path, **named: str) -> None:
    """Save a tokenizer that knows every byte and the named tokens."""
    from tokenizers import Tokenizer, decoders, models, pre_tokenizers
    from transformers import PreTrainedTokenizerFast

    special = ["<pad>", "<bos>", "<eos>", *named.values()]
    alphabet = sorted(pre_tokenizers.ByteLevel.alphabet())
    vocabulary = {token: number for number, token in enumerate([*special, *alphabet])}
    tokenizer = Tokenizer(models.BPE(vocabulary, merges=[]))
    tokenizer.pre_tokenizer = pre_tokenizers.ByteLevel(add_prefix_space=False)
    tokenizer.decoder = decoders.ByteLevel()
    PreTrainedTokenizerFast(
        tokenizer_object=tokenizer,
        pad_token="<pad>",
        bos_token="<bos>",
        eos_token="<eos>",
        extra_special_tokens=named,
    ).save_pretrained(folder)


def save_vlm() -> None:
    """Save a SmolVLM with two layers, and the processor that SmolVLA loads with it."""
    from transformers import (
        LlamaConfig,
        PreTrainedTokenizerFast,
        SmolVLMConfig,
        SmolVLMForConditionalGeneration,
        SmolVLMImageProcessor,
        SmolVLMProcessor,
        SmolVLMVideoProcessor,
    )

    folder = snapshot(VLM)
    save_tokenizer(folder, **NAMED_TOKENS)
    tokenizer = PreTrainedTokenizerFast.from_pretrained(folder)
    processor = SmolVLMProcessor(SmolVLMImageProcessor(), tokenizer, SmolVLMVideoProcessor())
    processor.save_pretrained(folder)
    words = LlamaConfig(
        vocab_size=len(tokenizer),
        hidden_size=64,
        intermediate_size=64,
        num_hidden_layers=2,
        num_attention_heads=4,
        num_key_value_heads=2,
        head_dim=16,
        pad_token_id=tokenizer.pad_token_id,
    )
    pictures = {
        "hidden_size": 16,
        "intermediate_size": 16,
        "num_hidden_layers": 1,
        "num_attention_heads": 2,
        "image_size": 512,
        "patch_size": 64,
    }
    config = SmolVLMConfig(
        vision_config=pictures,
        text_config=words.to_dict(),
        scale_factor=4,
        image_token_id=tokenizer.image_token_id,
        pad_token_id=tokenizer.pad_token_id,
    )
    SmolVLMForConditionalGeneration(config).save_pretrained(folder)


def save_policy(name: str, kind: str, state: int, cameras: tuple[str, ...], size: int) -> None:
    """Save a base model as LeRobot does: network, configuration, processors."""
    from lerobot.configs import FeatureType, PolicyFeature
    from lerobot.policies import make_pre_post_processors
    from lerobot.policies.factory import get_policy_class, make_policy_config

    config = make_policy_config(
        kind,
        input_features={
            "observation.state": PolicyFeature(FeatureType.STATE, (state,)),
            **{
                f"observation.images.{camera}": PolicyFeature(FeatureType.VISUAL, (3, size, size))
                for camera in cameras
            },
        },
        output_features={"action": PolicyFeature(FeatureType.ACTION, (state,))},
        device="cpu",
        push_to_hub=False,
        **({"load_vlm_weights": True} if kind == "smolvla" else {}),
    )
    folder = snapshot(name)
    get_policy_class(kind)(config).save_pretrained(folder)
    for processor in make_pre_post_processors(config):
        processor.save_pretrained(folder)


def main() -> None:
    """Fill the caches that the environment names."""
    import torch
    from lerobot.utils.import_utils import register_third_party_plugins
    from transformers import PaliGemmaConfig

    register_third_party_plugins()
    torch.manual_seed(0)
    save_vlm()
    save_policy(SMOLVLA, "smolvla", 6, ("camera1", "camera2", "camera3"), 256)
    save_tokenizer(snapshot(PALIGEMMA))
    PaliGemmaConfig().save_pretrained(snapshot(PALIGEMMA))  # which tokenizer it is stands there
    slots = ("base_0_rgb", "left_wrist_0_rgb", "right_wrist_0_rgb")
    save_policy(PI0, "pi0", 32, slots, 224)
    save_policy(PI05, "pi05", 32, slots, 224)


if __name__ == "__main__":
    main()
