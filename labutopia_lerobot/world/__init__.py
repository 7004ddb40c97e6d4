"""The read-only view of the simulation that predicates and skills have."""

from labutopia_lerobot.world.floor import Dock, Floor
from labutopia_lerobot.world.liquid_account import LiquidAccount
from labutopia_lerobot.world.manipulator import Approach, Manipulator, Wheels
from labutopia_lerobot.world.pose import FloatArray, Pose
from labutopia_lerobot.world.reading import ON, PRESSED, Reading
from labutopia_lerobot.world.solution import SOLUTION_NAMES, Solution
from labutopia_lerobot.world.things import (
    Button,
    Doorway,
    Graspable,
    Obstacle,
    OpenVessel,
    ReachedInto,
    Standing,
    Thing,
)
from labutopia_lerobot.world.world import (
    ARM,
    BASE,
    BENCH,
    CONTROL_HZ,
    HAND,
    LEFT_PAD,
    RIGHT_PAD,
    ROOM,
    World,
)

__all__ = [
    "ARM",
    "BASE",
    "BENCH",
    "CONTROL_HZ",
    "HAND",
    "LEFT_PAD",
    "ON",
    "PRESSED",
    "RIGHT_PAD",
    "ROOM",
    "SOLUTION_NAMES",
    "Approach",
    "Button",
    "Dock",
    "Doorway",
    "FloatArray",
    "Floor",
    "Graspable",
    "LiquidAccount",
    "Manipulator",
    "Obstacle",
    "OpenVessel",
    "Pose",
    "ReachedInto",
    "Reading",
    "Solution",
    "Standing",
    "Thing",
    "Wheels",
    "World",
]
