"""`--env.type=labutopia` for LeRobot's programs. Imports mujoco only where it is needed."""

from dataclasses import dataclass, field
from functools import partial
from typing import Any

from draccus.utils import DecodingError
from gymnasium.vector import VectorEnv
from lerobot.configs import FeatureType, PolicyFeature
from lerobot.envs.configs import EnvConfig

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import (
    CAMERAS,
    IMAGE_SIZE,
    Feature,
    action_feature,
    observation_features,
)
from labutopia_lerobot.options import LIQUID, SPLITS, UnknownOptionError, require_choices
from labutopia_lerobot.registry import load_task, require_task, tasks_of_levels
from labutopia_lerobot.robots import DEFAULT_ROBOT, load_robot
from labutopia_lerobot.world import CONTROL_HZ


class InvalidEnvError(UserError, DecodingError):
    """A flag of `--env.*` that is wrong; LeRobot's programs print the message and stop."""


@EnvConfig.register_subclass("labutopia")
@dataclass
class LabUtopiaEnvConfig(EnvConfig):
    """Which environments LeRobot plays; every field is a flag `--env.<field>`.

    Attributes:
        task: A task id, a level such as `level1` for all of its tasks, or several of either,
            separated by commas.
        fps: Control rate, which cannot be changed.
        obs: `pixels` or `state`.
        split: `id` or `train`.
        cameras: Which cameras `pixels` has.
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].
        tasks_dir: A further folder of tasks.
        liquid: `on`, or `off` for empty vessels.

    `features` and `features_map` follow from these; what they are given is not used.

    Raises:
        InvalidEnvError: If a field is not one of its choices.
    """

    task: str | None = "level1/pick"
    fps: int = CONTROL_HZ
    obs: str = "pixels"
    split: str = "id"
    cameras: list[str] = field(default_factory=lambda: list(CAMERAS))
    width: int = IMAGE_SIZE
    height: int = IMAGE_SIZE
    tasks_dir: str | None = None
    liquid: str = "on"

    def __post_init__(self) -> None:
        try:
            require_choices("split", [self.split], SPLITS)
            require_choices("liquid", [self.liquid], LIQUID)
            require_choices("fps", [self.fps], [CONTROL_HZ])
            observed = self._observed()
        except UserError as error:
            raise InvalidEnvError((), str(error)) from error
        # LeRobot's recording of evaluations looks pictures up under their LeRobot key and numbers
        # under the environment's.
        action = action_feature(load_robot(DEFAULT_ROBOT))
        declared = {
            feature.key if feature.is_picture else path: feature
            for path, feature in {**observed, "action": action}.items()
        }
        self.features = {name: _policy_feature(feature) for name, feature in declared.items()}
        self.features_map = {name: feature.key for name, feature in declared.items()}

    @property
    def task_ids(self) -> list[str]:
        """Ids of the tasks that `task` names.

        Raises:
            UnknownTaskError: If a task or level does not exist.
        """
        chosen: list[str] = []
        for word in (self.task or "").split(","):
            level = word.strip().removeprefix("level")
            if level.isdigit():
                chosen += tasks_of_levels([int(level)], self.tasks_dir)
            else:
                require_task(word.strip(), self.tasks_dir)
                chosen.append(word.strip())
        return list(dict.fromkeys(chosen))

    @property
    def gym_kwargs(self) -> dict[str, Any]:
        """Arguments of `LabEnv` beside the task."""
        return {
            "obs": self.obs,
            "cameras": tuple(self.cameras),
            "width": self.width,
            "height": self.height,
            "split": self.split,
            "tasks_dir": self.tasks_dir,
            "liquid": self.liquid,
        }

    def create_envs(
        self, n_envs: int, use_async_envs: bool = False
    ) -> dict[str, dict[str, VectorEnv[Any, Any, Any]]]:
        """Return level -> task name -> environments; nothing starts before its first reset."""
        from labutopia_lerobot.vector import LabVectorEnv  # here: it imports mujoco

        asynchronous = use_async_envs and n_envs > 1
        suites: dict[str, dict[str, VectorEnv[Any, Any, Any]]] = {}
        for task_id in self.task_ids:
            level, name = task_id.split("/")
            envs = LabVectorEnv(task_id, n_envs, asynchronous, **self.gym_kwargs)
            suites.setdefault(level, {})[name] = envs
        return suites

    def _observed(self) -> dict[str, Feature]:
        """Declare what is observed, which must be the same in every task."""
        first, *others = (
            observation_features(
                partial(load_task, task_id, self.tasks_dir, self.liquid),
                load_robot(DEFAULT_ROBOT),
                self.obs,
                self.cameras,
                self.width,
                self.height,
            )
            for task_id in self.task_ids
        )
        if any(other != first for other in others):
            raise UnknownOptionError(
                f"obs={self.obs!r} differs between the tasks {', '.join(self.task_ids)}. "
                "Name one at a time, or use obs=pixels"
            )
        return first


_TYPES = {
    "action": FeatureType.ACTION,
    "observation.state": FeatureType.STATE,
    "observation.environment_state": FeatureType.ENV,
}


def _policy_feature(feature: Feature) -> PolicyFeature:
    return PolicyFeature(_TYPES.get(feature.key, FeatureType.VISUAL), feature.shape)
