"""`--teleop.type=labutopia` for LeRobot's programs; imports no mujoco."""

from dataclasses import dataclass

from draccus.utils import DecodingError
from lerobot.teleoperators import TeleoperatorConfig

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import DEFAULT_ROBOT, DEFAULT_ROOM, ROBOT_NAMES, require_choices

KEYBOARD, GAMEPAD = "keyboard", "gamepad"


class InvalidTeleoperatorError(UserError, DecodingError):
    """A flag of `--teleop.*` that is wrong; LeRobot's programs print the message and stop."""


@TeleoperatorConfig.register_subclass("labutopia")
@dataclass
class LabUtopiaTeleoperatorConfig(TeleoperatorConfig):
    """Device with which a person moves the hand, and the speed.

    Attributes:
        device: `keyboard` or `gamepad`, read by LeRobot's own teleoperators of these names.
        robot: Which arm is moved, as `--robot.robot`.
        room: Where it stands, as `--robot.room`.
        speed: Of the hand [m/s].
        turning: Of the hand [rad/s].

    Raises:
        InvalidTeleoperatorError: If a field is not one of its choices.
    """

    device: str = KEYBOARD
    robot: str = DEFAULT_ROBOT
    room: str = DEFAULT_ROOM
    speed: float = 0.15
    turning: float = 0.8

    def __post_init__(self) -> None:
        try:
            require_choices("device", [self.device], (KEYBOARD, GAMEPAD))
            require_choices("robot", [self.robot], ROBOT_NAMES)
            load_room(self.room)
        except UserError as error:
            raise InvalidTeleoperatorError((), str(error)) from error
