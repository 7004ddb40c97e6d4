"""One number of a robot's state and of its commands."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Element:
    """One number of a robot's state and of its commands.

    That of a joint or a gripper is a position [rad or m]. That of a base is a velocity [rad/s or
    m/s]: there each of the following is one derivative further on.

    Attributes:
        name: What it is called in features; also the servo that takes its target.
        lower: Least position [rad or m].
        upper: Greatest position [rad or m].
        speed: Greatest speed [rad/s or m/s].
        acceleration: Greatest acceleration [rad/s^2 or m/s^2].
        jerk: Greatest jerk [rad/s^3 or m/s^3].
    """

    name: str
    lower: float
    upper: float
    speed: float
    acceleration: float
    jerk: float
