"""The features of a dataset, made from the one declaration of what is observed and commanded."""

from typing import Any

from labutopia_lerobot.features import (
    Feature,
    action_feature,
    environment_state_names,
    observation_features,
)
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

PRIVILEGED_STATE = "privileged.environment_state"
"""Where `environment_state` lives beside pictures: LeRobot would feed its usual key to policies."""

IMAGES = "observation.images."
"""Prefix of the keys of pictures; the camera follows."""


def dataset_features(setting: Setting) -> dict[str, dict[str, Any]]:
    """Return LeRobot's declaration of a dataset: key -> dtype, shape and names."""
    task = canonical_task(setting)
    features = [*observation_features(setting, lambda: task).values(), action_feature(setting)]
    if setting.obs == "pixels":
        names = environment_state_names(task)
        features.append(Feature(PRIVILEGED_STATE, "float32", (len(names),), names))
    return {
        feature.key: {
            "dtype": "video" if feature.is_picture else feature.dtype,
            "shape": feature.shape,
            "names": list(feature.names),
        }
        for feature in features
    }


def state_keys(obs: str) -> dict[str, str]:
    """Return the path in the environment's observation with `obs="state"` -> the dataset's key."""
    privileged = "observation.environment_state" if obs == "state" else PRIVILEGED_STATE
    return {"agent_pos": "observation.state", "environment_state": privileged}
