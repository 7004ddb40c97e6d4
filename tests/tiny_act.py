"""A tiny ACT with random weights, saved as `lerobot-train` saves a trained one."""

from pathlib import Path
from typing import Any

import torch
from lerobot.configs import FeatureType, PolicyFeature
from lerobot.policies import make_pre_post_processors
from lerobot.policies.act.configuration_act import ACTConfig
from lerobot.policies.act.modeling_act import ACTPolicy


def save(
    folder: Path,
    state: int = 8,
    action: int = 8,
    privileged: int = 13,
    cameras: tuple[str, ...] = (),
) -> Path:
    """Save it, for level1/pick by default, and return the folder."""
    inputs = {"observation.state": PolicyFeature(FeatureType.STATE, (state,))}
    for camera in cameras:
        inputs[f"observation.images.{camera}"] = PolicyFeature(FeatureType.VISUAL, (3, 64, 64))
    if not cameras:
        inputs["observation.environment_state"] = PolicyFeature(FeatureType.ENV, (privileged,))
    config = ACTConfig(
        input_features=inputs,
        output_features={"action": PolicyFeature(FeatureType.ACTION, (action,))},
        device="cpu",
        push_to_hub=False,
        pretrained_backbone_weights=None,
        chunk_size=4,
        n_action_steps=4,
        dim_model=16,
        n_heads=2,
        dim_feedforward=16,
        n_encoder_layers=1,
        n_decoder_layers=1,
        use_vae=False,
    )
    features = {**inputs, **config.output_features}
    sizes = {key: (3, 1, 1) if "images" in key else f.shape for key, f in features.items()}
    statistics: dict[str, dict[str, Any]] = {
        key: {"mean": torch.zeros(size), "std": torch.ones(size)} for key, size in sizes.items()
    }
    torch.manual_seed(0)
    ACTPolicy(config).save_pretrained(folder)
    for processor in make_pre_post_processors(config, dataset_stats=statistics):
        processor.save_pretrained(folder)
    return folder


def change(folder: Path) -> None:
    """Change one of its weights, as a training that goes on does."""
    file = folder / "model.safetensors"
    weights = bytearray(file.read_bytes())
    weights[-1] ^= 1
    file.write_bytes(weights)
