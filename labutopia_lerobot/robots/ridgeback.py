"""The Clearpath Ridgeback, a holonomic base on four mecanum wheels: names and limits.

[CPR] Clearpath Robotics, data sheet "Ridgeback omnidirectional development platform": 960 x 793 x
311 mm, payload 100 kg, 1.1 m/s.
[URDF] `ridgeback_description` 0.3.0 (ridgeback/ridgeback, BSD): frames, wheels, masses.
[UST] Hokuyo, data sheet "Scanning Laser Range Finder UST-10LX": 0.06 to 10 m, 270 deg by 0.25 deg.
[ROS] `ridgeback_control`, control.yaml (ridgeback/ridgeback): 1.0 m/s^2.
"""

import math

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.laser_scanner import LaserScanner
from labutopia_lerobot.robots.mobile_base import MobileBase

_SPEED = 1.1
"""Greatest speed [m/s] [CPR]; also that of the rims of the wheels."""
_ACCELERATION = 1.0
"""Greatest acceleration, likewise [m/s^2] [ROS]."""
_LEVER = 0.319 + 0.2755
"""Distance of the axles and of the wheels from the middle, added up [m] [URDF]: a base on mecanum
wheels turns as fast as their rims move, by this (Muir and Neuman, 1987, "Kinematic Modeling for
Feedback Control of an Omnidirectional Wheeled Mobile Robot"). The 4 rad/s of [ROS] would need rims
at 2.4 m/s."""
_RUN_UP_S = 0.1
"""Time from rest to full acceleration [s]; ours: not published."""


def _velocity(name: str, share: float) -> Element:
    speed, acceleration = _SPEED * share, _ACCELERATION * share
    return Element(name, -speed, speed, acceleration, acceleration / _RUN_UP_S, math.inf)


RIDGEBACK = MobileBase(
    elements=(
        _velocity("base_velocity_x", 1.0),
        _velocity("base_velocity_y", 1.0),
        _velocity("base_velocity_yaw", 1.0 / _LEVER),
    ),
    joints=("base_x", "base_y", "base_yaw"),
    body="base",
    size=(0.960, 0.793),  # [CPR]
    height=0.306,  # deck, 0.28 m [URDF], and the wheels below that frame; 311 mm overall [CPR]
    payload=100.0,  # [CPR]
    # Ours: on a riser at the front of the deck, as high as the stand of levels 1 to 4, so that a
    # base that stands at a bench has its arm where that is.
    arm=(0.30, 0.0, 0.71),
    # Ours: those of level 1's pick are 0.61 to 0.76, and a beaker of 0.25 m further out stays
    # within the reach of 0.855.
    ahead=(0.45, 0.70),
    above=0.70,
    gap=0.01,  # ours
    door_room=0.0,  # as the arm on its stand
    # Its standard front one: on the chassis, whose frame is 0.0259 m above the floor [URDF]. Ours:
    # every fourth ray, a degree apart.
    scanner=LaserScanner((0.3932, 0.0, 0.2330 + 0.0259), 270.0, 271, 0.06, 10.0),  # [URDF] [UST]
)
