"""`--robot.type=labutopia` for LeRobot's programs; imports no mujoco."""

from draccus.utils import DecodingError
from lerobot.robots import RobotConfig

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import OBSERVATION_KINDS, Setting, setting_of, with_setting


class InvalidRobotError(UserError, DecodingError):
    """A flag of `--robot.*` that is wrong; LeRobot's programs print the message and stop."""


@RobotConfig.register_subclass("labutopia")
@with_setting
class LabUtopiaRobotConfig(RobotConfig):
    """Options of what is played and observed; the fields of `Setting` are fields of this too.

    Attributes:
        task: Task id.
        split: `train`, for demonstrations, or another for measurements.
        seed: Seed of the first episode; the next one has the next seed.

    Raises:
        InvalidRobotError: If a field is not one of its choices.
    """

    task: str = "level1/pick"
    split: str = "train"
    seed: int = 0

    def __post_init__(self) -> None:
        try:
            setting = self.setting
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
