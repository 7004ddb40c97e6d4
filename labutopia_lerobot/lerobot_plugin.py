"""`--env.type=labutopia` for LeRobot's programs. Imports mujoco only where it is needed."""

from dataclasses import asdict, dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from draccus.utils import DecodingError
from gymnasium.vector import VectorEnv
from lerobot.configs import FeatureType, PolicyFeature
from lerobot.envs.configs import EnvConfig
from lerobot.processor import ObservationProcessorStep, PolicyProcessorPipeline

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import ACTION, Feature, action_feature, observation_features
from labutopia_lerobot.registry import tasks_of_levels
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import (
    DEPTH,
    Setting,
    SettingOptions,
    UnknownOptionError,
    option,
    require_choices,
    setting_of,
)
from labutopia_lerobot.world import CONTROL_HZ

if TYPE_CHECKING:
    from labutopia_lerobot.task import Task


class InvalidEnvError(UserError, DecodingError):
    """A flag of `--env.*` that is wrong; LeRobot's programs print the message and stop."""


@EnvConfig.register_subclass("labutopia")
@dataclass
class LabUtopiaEnvConfig(SettingOptions, EnvConfig):
    """The environments that LeRobot plays; every field is a flag `--env.<field>`.

    Its `max_parallel_tasks` has to be 1: LeRobot would let tasks that it plays at a time share one
    policy and its queue of actions (huggingface/lerobot#4327). `features` and `features_map` follow
    from the other fields; what they are given is not used.

    Raises:
        InvalidEnvError: If a field is not one of its choices.
    """

    task: str | None = option(
        "level1/pick",
        "A task id, a level such as `level1` for all of its tasks, or several of either, separated "
        "by commas.",
    )
    fps: int = option(CONTROL_HZ, "Control rate, which cannot be changed.")

    def __post_init__(self) -> None:
        try:
            require_choices("fps", [self.fps], [CONTROL_HZ])
            self._require_one_task_at_a_time()
            observed = self._observed()
        except UserError as error:
            raise InvalidEnvError((), str(error)) from error
        # LeRobot's recording of evaluations looks pictures up under their LeRobot key and numbers
        # under the environment's.
        declared = {
            feature.key if feature.is_picture else path: feature
            for path, feature in {**observed, ACTION: action_feature(self.settings[0])}.items()
        }
        self.features = {name: _policy_feature(feature) for name, feature in declared.items()}
        self.features_map = {name: feature.key for name, feature in declared.items()}

    @property
    def settings(self) -> list[Setting]:
        """The setting of every task that `task` names.

        Raises:
            UnknownOptionError: If a value is impossible.
            UnknownTaskError: If a task or level does not exist.
        """
        chosen: list[str] = []
        for word in (self.task or "").split(","):
            level = word.strip().removeprefix("level")
            if level.isdigit():
                chosen += tasks_of_levels([int(level)], self.tasks_dir)
            else:
                chosen.append(word.strip())
        return [setting_of(self, task=task) for task in dict.fromkeys(chosen)]

    @property
    def gym_kwargs(self) -> dict[str, Any]:
        """Arguments of `gymnasium.make` beside the task."""
        options = asdict(self.settings[0])
        del options["task"]
        return options

    def get_env_processors(self) -> tuple[Any, Any]:
        """Return what LeRobot does to observations and actions: depths get its own form."""
        steps = [LeRobotDepth()] if DEPTH in self.extras else []
        return PolicyProcessorPipeline(steps=steps), PolicyProcessorPipeline(steps=[])

    def create_envs(
        self, n_envs: int, use_async_envs: bool = False
    ) -> dict[str, dict[str, VectorEnv[Any, Any, Any]]]:
        """Return level -> task name -> environments; nothing starts before its first reset."""
        from labutopia_lerobot.evaluation.logged_vector import (
            LoggedVectorEnv,  # here: it imports mujoco
        )

        asynchronous = use_async_envs and n_envs > 1
        suites: dict[str, dict[str, VectorEnv[Any, Any, Any]]] = {}
        for setting in self.settings:
            level, name = setting.task.split("/")
            envs = LoggedVectorEnv(setting, n_envs, asynchronous)
            suites.setdefault(level, {})[name] = envs
        return suites

    def _require_one_task_at_a_time(self) -> None:
        if self.max_parallel_tasks > 1:
            raise UnknownOptionError(
                f"max_parallel_tasks={self.max_parallel_tasks} is refused: LeRobot lets tasks that "
                "it plays at a time share one policy and its queue of actions, so that each plays "
                "the other's. Leave it out; `eval.batch_size` and `eval.use_async_envs` play "
                "several episodes of a task at a time"
            )

    def _observed(self) -> dict[str, Feature]:
        """Declare what is observed, which must be the same in every task."""
        settings = self.settings
        load_room(self.room)  # it must be one that can be played in
        first, *others = (
            observation_features(setting, partial(_canonical_task, setting)) for setting in settings
        )
        if any(other != first for other in others):
            raise UnknownOptionError(
                f"obs={settings[0].obs!r} differs between the tasks "
                f"{', '.join(setting.task for setting in settings)}. "
                "Name one at a time, or use obs=pixels"
            )
        return first


class LeRobotDepth(ObservationProcessorStep):
    """Gives depths the form in which LeRobot's datasets give them: channel first, millimetres."""

    def observation(self, observation: dict[str, Any]) -> dict[str, Any]:
        """Return the observation with its depths, (environments, 1, height, width) [mm]."""
        depths = {key: value for key, value in observation.items() if key.endswith(f"_{DEPTH}")}
        return observation | {key: d.permute(0, 3, 1, 2) * 1000.0 for key, d in depths.items()}

    def transform_features(self, features: Any) -> Any:
        """Return the features, which stay as they are."""
        return features


def _canonical_task(setting: Setting) -> "Task":
    from labutopia_lerobot.scenario import canonical_task  # here: it imports mujoco

    return canonical_task(setting)


_TYPES = {
    "action": FeatureType.ACTION,
    "observation.state": FeatureType.STATE,
    "observation.forces": FeatureType.STATE,
    "observation.readings": FeatureType.STATE,
    "observation.environment_state": FeatureType.ENV,
}


def _policy_feature(feature: Feature) -> PolicyFeature:
    return PolicyFeature(_TYPES.get(feature.key, FeatureType.VISUAL), feature.shape)
