"""The features of a dataset, made from the one declaration of what is observed and commanded."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import Feature, action_feature, observation_features
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting

IMAGES = "observation.images."
"""Prefix of the keys of pictures; the camera follows."""

STATE = "observation.state"
ENVIRONMENT_STATE = "observation.environment_state"

PRIVILEGED_STATE = "privileged.environment_state"
"""Key of `environment_state` beside pictures: LeRobot would feed its usual key to policies."""

PRIVILEGED_SIZE = 128
"""Elements of `PRIVILEGED_STATE` in every task, those behind the task's own zero: LeRobot merges
datasets of equal features only. The largest so far, level3/identify_unknown, has 104."""

COMMAND = "commanded_action"
"""Key of the demonstrator's commands; `action` is what acted. A key that began with `action` would
become an output of LeRobot's policies."""

REWARD, DONE, SUCCEEDED = "next.reward", "next.done", "next.success"
"""Keys of the results of a frame's action, under the names that LeRobot's own recorder uses."""

STEP, SUBSTEP, PHASE = "annotation.step", "annotation.substep", "annotation.phase"
"""The step of the task that is being done, the substep that has latched last, the phase of the
expert; empty where there is none."""


_DEPTH_INFO = {"is_depth_map": True, "depth_unit": "m"}
"""LeRobot's marks of depth, and the unit of its statistics."""


class PrivilegedSizeError(UserError, ValueError):
    """A task with more privileged state than datasets hold; the message says the cure."""


def dataset_features(setting: Setting) -> dict[str, dict[str, Any]]:
    """Return LeRobot's declaration of a dataset: key -> dtype, shape and names.

    With `obs="pixels"` it is the same for every task.
    """
    action = action_feature(setting)
    features = [
        *observation_features(setting, lambda: canonical_task(setting)).values(),
        action,
        Feature(COMMAND, "float32", action.shape, action.names),
        Feature(REWARD, "float32", (1,), (REWARD,)),
        Feature(DONE, "bool", (1,), (DONE,)),
        Feature(SUCCEEDED, "bool", (1,), (SUCCEEDED,)),
        *(Feature(key, "string", (1,), (key,)) for key in (STEP, SUBSTEP, PHASE)),
    ]
    if setting.obs == "pixels":
        names = tuple(f"element_{index}" for index in range(PRIVILEGED_SIZE))
        features.append(Feature(PRIVILEGED_STATE, "float32", (PRIVILEGED_SIZE,), names))
    return {
        feature.key: {
            "dtype": "video" if feature.is_picture else feature.dtype,
            "shape": feature.shape,
            "names": list(feature.names),
            **({"info": dict(_DEPTH_INFO)} if feature.is_depth else {}),
        }
        for feature in features
    }


def same_features(settings: Sequence[Setting]) -> bool:
    """Return whether datasets of these settings can be one."""
    first, *others = (dataset_features(setting) for setting in settings)
    return all(features == first for features in others)


def privileged_state(state: NDArray[np.float32], obs: str) -> tuple[str, NDArray[np.float32]]:
    """Return under which key a dataset has the environment's privileged state, and in which form.

    Args:
        state: What the environment gives, shape (elements,).
        obs: The kind of observation that is recorded.

    Raises:
        PrivilegedSizeError: If it is too large.
    """
    if obs == "state":
        return ENVIRONMENT_STATE, state
    if len(state) > PRIVILEGED_SIZE:
        raise PrivilegedSizeError(
            f"The task has {len(state)} elements of privileged state, and datasets hold "
            f"{PRIVILEGED_SIZE}: record with obs=state, or raise PRIVILEGED_SIZE for all datasets"
        )
    return PRIVILEGED_STATE, np.pad(state, (0, PRIVILEGED_SIZE - len(state)))
