"""Turns and swings add up from poses alone; told through a world that says what the test wants."""

import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.glass.glassware import beaker
from labutopia_lerobot.predicates import swings, turns
from labutopia_lerobot.world import Pose

ROD, VESSEL = GlassRod("rod"), beaker("vessel")


class Poses:
    """A world in which a rod's tip and a vessel are where the test puts them."""

    def __init__(self) -> None:
        self.tip, self.lean = np.zeros(3), np.eye(3)

    def frame(self, name: str) -> Pose:
        return Pose(np.zeros(3), np.eye(3))

    def pose(self, thing: object) -> Pose:
        return Pose(self.tip, np.eye(3)) if thing is ROD else Pose(np.zeros(3), self.lean)


def turned(*legs: tuple[float, float], radius: float = 0.009, across: bool = False) -> float:
    """Count turns along arcs, each from an angle to another [deg]."""
    world, counter = Poses(), turns(ROD, VESSEL, needed=5, beyond=0.005).counter()
    count = 0.0
    for start, end in legs:
        for angle in np.radians(np.linspace(start, end, 2 + int(abs(end - start) / 6))):
            world.tip = radius * np.array([np.cos(angle), np.sin(angle), 0.0])
            count = counter.add(world)
        if across:
            world.tip = np.zeros(3)
            counter.add(world)
    return count


def swung(*leans: tuple[float, float]) -> float:
    """Count swings through leans, each an angle and the direction that it goes to [deg]."""
    world, counter = Poses(), swings(VESSEL, needed=3, beyond_deg=15).counter()
    count = 0.0
    for lean, direction in leans:
        bearing = np.radians(direction + 90)
        axis = np.array([np.cos(bearing), np.sin(bearing), 0.0])
        world.lean = Rotation.from_rotvec(np.radians(lean) * axis).as_matrix()
        count = counter.add(world)
    return count


def test_turns_add_up_from_any_angle_and_in_either_sense():
    for start in range(0, 360, 45):
        for sense in (1, -1):
            assert abs(turned((start, start + sense * 1800)) - 5.0) < 1e-6


def test_turns_there_and_back_are_none():
    assert turned((0, 720), (720, 0)) == 0.0


def test_a_way_across_the_axis_is_no_half_turn():
    back_and_forth = [(0, 1), (180, 181)] * 10
    assert turned(*back_and_forth) == 0.0
    assert turned(*back_and_forth, across=True) == 0.0


def test_circles_too_near_the_axis_are_no_turns():
    assert turned((0, 1800), radius=0.004) == 0.0


def test_three_swings_are_three_about_any_axis():
    for direction in range(0, 360, 30):
        assert swung(*[(20, direction), (-20, direction)] * 3) == 3.0


def test_a_wobble_is_no_swing_and_a_lean_that_wobbles_is_half_of_one():
    assert swung(*[(12, 0), (-12, 0)] * 3) == 0.0
    assert swung(*[(20, 0), (14, 0)] * 3) == 0.5


def test_a_lean_that_goes_round_the_vertical_is_no_swing():
    assert swung(*[(20, direction) for direction in range(0, 1080, 10)]) < 1.0
