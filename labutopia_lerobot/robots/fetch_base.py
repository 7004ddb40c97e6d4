"""The base of the Fetch, as holonomic as the paper's or as it is: names and limits.

[FR] Fetch Robotics, data sheet "Fetch Mobile Manipulator": 1.0 m/s.
[URDF] `fetch_description` (ZebraDevs/fetch_ros): frames.
[TIM] SICK, data sheet "TiM571": 0.05 to 25 m, rays 1/3 deg apart; [FR] has 220 of its 270 deg.

The paper drives the Fetch by "x and y velocity and rotation", as it does the Ridgeback: so do we.
The real one has two wheels that are driven and cannot go sideways: `FETCH_DIFFERENTIAL_BASE`.
"""

import math
from dataclasses import replace

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.laser_scanner import LaserScanner
from labutopia_lerobot.robots.mobile_base import MobileBase

_SPEED = 1.0
"""Greatest speed [m/s] [FR]."""
_ACCELERATION = 0.75
"""Greatest acceleration [m/s^2]; ours: not published. A quarter less than the Ridgeback's, whose
base weighs twice as much and stands on four wheels."""
_TURNING = 2.0
"""Greatest speed of turning [rad/s], and acceleration [rad/s^2]; ours: the wheels, 0.187 m from the
middle [URDF], could turn it faster than an outstretched arm should be swung."""
_RUN_UP_S = 0.1
"""Time from rest to full acceleration [s]; ours: as the Ridgeback's."""


def _velocity(name: str, speed: float, acceleration: float) -> Element:
    return Element(name, -speed, speed, acceleration, acceleration / _RUN_UP_S, math.inf)


FETCH_BASE = MobileBase(
    elements=(
        _velocity("base_velocity_x", _SPEED, _ACCELERATION),
        _velocity("base_velocity_y", _SPEED, _ACCELERATION),
        _velocity("base_velocity_yaw", _TURNING, _TURNING),
    ),
    joints=("base_x", "base_y", "base_yaw"),
    body="base",
    size=(0.576, 0.576),  # the circle around the mesh
    height=0.359,  # of the mesh
    payload=40.0,  # ours: what torso, head and arm weigh, and 6 kg in the hand [FR]
    # Axis of the shoulder above the floor with the torso down: 0.37743 + 0.34858 m up, and
    # 0.119525 m before the column, which is 0.086875 m behind the middle [URDF].
    arm=(0.03265, 0.0, 0.72601),
    ahead=(0.57, 0.82),  # ours: a beaker of 0.25 m further out stays within the reach
    # Ours: from farther off its arm, the torso being up and the hand pointing down, is straight
    # before a beaker is 0.25 m above a bench of 0.90 m.
    above=0.68,
    gap=0.10,  # ours: nearer by, the arm has to fold as far as it can
    door_room=0.35,  # ours: with 0.25 the elbow folds up before the door is wide open
    # Ours: every third ray, a degree apart.
    scanner=LaserScanner((0.235, 0.0, 0.2878), 220.0, 221, 0.05, 25.0),  # [URDF] [TIM]
    # Measured at `FETCH.stowed`: hand, wrist, forearm and elbow, and 2 cm around them.
    folded=((0.288, 0.555), (-0.085, 0.385), (1.075, 1.565)),
)

FETCH_DIFFERENTIAL_BASE = replace(
    FETCH_BASE,
    elements=(
        FETCH_BASE.elements[0],
        replace(FETCH_BASE.elements[1], lower=0.0, upper=0.0),
        FETCH_BASE.elements[2],
    ),
)
