"""`--robot.type=labutopia` for LeRobot's programs; imports no mujoco."""

from dataclasses import dataclass

from draccus.utils import DecodingError
from lerobot.robots import RobotConfig

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import OBSERVATION_KINDS, Setting, SettingOptions, option, setting_of


class InvalidRobotError(UserError, DecodingError):
    """A flag of `--robot.*` that is wrong; LeRobot's programs print the message and stop."""


@RobotConfig.register_subclass("labutopia")
@dataclass
class LabUtopiaRobotConfig(SettingOptions, RobotConfig):
    """Task, robot, observation and the other options.

    Raises:
        InvalidRobotError: If a field is not one of its choices.
    """

    task: str = option("level1/pick", "Task id.")
    split: str = option("train", "`train`, for demonstrations, or another for measurements.")
    seed: int = option(0, "Seed of the first episode; the next one has the next seed.")

    def __post_init__(self) -> None:
        try:
            setting = self.setting
            load_room(setting.room)  # it must be one that can be played in
        except UserError as error:
            raise InvalidRobotError((), str(error)) from error
        if setting.obs != OBSERVATION_KINDS[0]:
            raise InvalidRobotError((), f"obs={setting.obs!r}: a robot has cameras, obs=pixels")
        if setting.extras:
            raise InvalidRobotError(
                (),
                f"extras={list(setting.extras)}: LeRobot's recorder would compress segmentations "
                "and put forces into the state. Leave it out, or use labutopia-record",
            )

    @property
    def setting(self) -> Setting:
        """The setting that is played and observed.

        Raises:
            UnknownOptionError: If a value is impossible.
            UnknownTaskError: If there is no such task.
        """
        return setting_of(self)
