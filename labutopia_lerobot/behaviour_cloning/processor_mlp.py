"""Processors before and behind the network: LeRobot's usual scaling."""

from typing import Any

from lerobot.processor import make_default_pre_post_processors

from labutopia_lerobot.behaviour_cloning.configuration_mlp import MLPConfig


def make_mlp_pre_post_processors(config: MLPConfig, dataset_stats: Any = None) -> tuple[Any, Any]:
    """Return what scales observations, and what scales actions back.

    Args:
        config: Options of the policy.
        dataset_stats: Statistics of the dataset, feature -> statistic -> numbers.
    """
    made: tuple[Any, Any] = make_default_pre_post_processors(
        config, dataset_stats, normalizer_device=config.device
    )
    return made
