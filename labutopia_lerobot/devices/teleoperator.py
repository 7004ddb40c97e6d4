"""A person who moves the hand of a robot with a keyboard or a gamepad, as a LeRobot teleoperator.

LeRobot's own teleoperators read the devices. Their small steps of a hand become the absolute joint
targets that our robots, datasets and policies have, so that `lerobot-record` stores what it stores
of the experts.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from lerobot.teleoperators import Teleoperator
from lerobot.teleoperators.gamepad import GamepadTeleop, GamepadTeleopConfig
from lerobot.teleoperators.keyboard import KeyboardTeleop, KeyboardTeleopConfig

from labutopia_lerobot.devices.config_teleoperator import GAMEPAD, LabUtopiaTeleoperatorConfig
from labutopia_lerobot.devices.lerobot_robot import NEXT_EPISODE
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.world import FloatArray

type Axis = tuple[float, float, float]

MOVES: Mapping[str, Axis] = {
    "w": (1.0, 0.0, 0.0),
    "s": (-1.0, 0.0, 0.0),
    "a": (0.0, 1.0, 0.0),
    "d": (0.0, -1.0, 0.0),
    "r": (0.0, 0.0, 1.0),
    "f": (0.0, 0.0, -1.0),
}
"""Keys that move the hand forward, back, to the left, to the right, up, down: axes, world frame."""

TURNS: Mapping[str, Axis] = {
    "i": (0.0, 1.0, 0.0),
    "k": (0.0, -1.0, 0.0),
    "j": (1.0, 0.0, 0.0),
    "l": (-1.0, 0.0, 0.0),
    "o": (0.0, 0.0, 1.0),
    "u": (0.0, 0.0, -1.0),
}
"""Keys that turn it up, down, to the left, to the right, and roll it to the right and to the left:
axes, gripper frame."""

CLOSE, OPEN, NEXT = "c", "v", "n"
"""Keys that close and open the hand, and that ask for the next episode."""

_FINGERS = 0.08
"""Speed of the pads [m/s]; ours."""


@dataclass(frozen=True)
class Wish:
    """Motion of the hand that a person asks for now.

    Attributes:
        along_w: Where it is to move, shape (3,), 1 for full speed, world frame.
        about_b: What it is to turn about, shape (3,), 1 for full speed, gripper frame.
        opening: 1 to open the hand, -1 to close it, 0 to keep it.
        next_episode: Whether the next episode is to begin.
    """

    along_w: FloatArray
    about_b: FloatArray
    opening: float = 0.0
    next_episode: bool = False


def of_keys(pressed: Collection[str]) -> Wish:
    """Return what keys that are pressed now stand for; others stand for nothing."""
    return Wish(
        _sum_of(pressed, MOVES),
        _sum_of(pressed, TURNS),
        float(OPEN in pressed) - float(CLOSE in pressed),
        NEXT in pressed,
    )


def _sum_of(pressed: Collection[str], axes: Mapping[str, Axis]) -> FloatArray:
    total: FloatArray = np.zeros(3)
    for key, axis in axes.items():
        total += np.multiply(axis, key in pressed)
    return total


def of_sticks(moved: Mapping[str, float]) -> Wish:
    """Return the motion of LeRobot's gamepad: full deflection is 1, `gripper` 0 closes and 2 opens.

    Its x is ahead of the robot, its y to the left.
    """
    along_w = np.array([moved[f"delta_{axis}"] for axis in "xyz"], dtype=np.float64)
    return Wish(along_w, np.zeros(3), float(moved["gripper"]) - 1.0)


class LabUtopiaTeleoperator(Teleoperator):
    """A person at a keyboard or with a gamepad.

    Args:
        config: With what, and how fast.
    """

    config_class = LabUtopiaTeleoperatorConfig
    name = "labutopia"

    def __init__(self, config: LabUtopiaTeleoperatorConfig) -> None:
        from labutopia_lerobot.sim.hand_control import HandControl  # here: it imports mujoco

        super().__init__(config)
        self.config = config
        self._names = load_robot(config.robot).names
        self._control = HandControl.of(config.robot, config.room)
        self._device: Teleoperator | None = None
        self._asked = False

    @property
    def action_features(self) -> dict[str, type]:
        """Commanded features: absolute targets of the elements [rad or m]."""
        return dict.fromkeys(self._names, float)

    @property
    def feedback_features(self) -> dict[str, type]:
        """Nothing is felt."""
        return {}

    @property
    def is_connected(self) -> bool:
        return self._device is not None and bool(self._device.is_connected)

    def connect(self, calibrate: bool = True) -> None:
        """Begin to listen to the device.

        Raises:
            ConnectionError: If nothing can be heard of it; the message says what it needs.
        """
        try:
            self._device = (
                GamepadTeleop(GamepadTeleopConfig())
                if self.config.device == GAMEPAD
                else KeyboardTeleop(KeyboardTeleopConfig())
            )
            self._device.connect()
        except ImportError as error:
            raise ConnectionError(self._cure) from error
        if not self.is_connected:
            raise ConnectionError(self._cure)

    @property
    def _cure(self) -> str:
        return (
            f"--teleop.device={self.config.device} cannot be heard: a keyboard needs a screen with "
            "X11 (or Windows, macOS) and `pip install pynput`, a gamepad to be plugged in and "
            "`pip install pygame`"
        )

    @property
    def is_calibrated(self) -> bool:
        return True

    def calibrate(self) -> None:
        """Do nothing: keys have no range."""

    def configure(self) -> None:
        """Do nothing: everything stands in the configuration."""

    def get_action(self) -> dict[str, Any]:
        """Return where the person wants the elements [rad or m] in the next control period."""
        if self._device is None:
            raise ConnectionError("connect() comes first")
        raw = self._device.get_action()
        return self.commanded(of_sticks(raw) if self.config.device == GAMEPAD else of_keys(raw))

    def commanded(self, wish: Wish) -> dict[str, Any]:
        """Return the action of a wish; a key that stays down asks for one next episode only."""
        begins, self._asked = wish.next_episode and not self._asked, wish.next_episode
        if begins:
            self._control.begin()
        command = self._control.move(
            self.config.speed * wish.along_w,
            self.config.turning * wish.about_b,
            _FINGERS * wish.opening,
        )
        action: dict[str, Any] = dict(zip(self._names, command.tolist(), strict=True))
        return action | ({NEXT_EPISODE: True} if begins else {})

    def send_feedback(self, feedback: dict[str, Any]) -> None:
        """Do nothing: nothing is felt."""

    def disconnect(self) -> None:
        """Listen no more."""
        if self._device is not None:
            self._device.disconnect()
