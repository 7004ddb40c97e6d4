"""Turns, swings and pulls add up; counted in a world that shows what the test wants."""

import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.predicates import pulled, swings, turns
from labutopia_lerobot.world import Pose

ROD, VESSEL = GlassRod("rod"), glassware("beaker", "250 ml", "vessel")


class Poses:
    """A world in which a rod's tip and a vessel are where the test puts them."""

    def __init__(self) -> None:
        self.tip, self.lean, self.time = np.zeros(3), np.eye(3), 0.0

    def frame(self, name: str) -> Pose:
        return Pose(np.zeros(3), np.eye(3))

    def pose(self, thing: object) -> Pose:
        return Pose(self.tip, np.eye(3)) if thing is ROD else Pose(np.zeros(3), self.lean)


def turned(
    *legs: tuple[float, float], radius: float = 0.009, across: bool = False, pause: float = 0.0
) -> float:
    """Count turns along arcs, each from an angle to another [deg], with a pause after each [s]."""
    world = Poses()
    counter = turns(ROD, VESSEL, needed=5, beyond=0.003, pause=2.0).counter()
    count = 0.0
    for start, end in legs:
        for angle in np.radians(np.linspace(start, end, 2 + int(abs(end - start) / 6))):
            world.tip = radius * np.array([np.cos(angle), np.sin(angle), 0.0])
            world.time += 1 / 30
            count = counter.add(world)
        for _ in range(round(30 * pause)):
            world.time += 1 / 30
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


def test_turns_one_way_and_then_the_other_add_up():
    assert abs(turned((0, 1080), (1080, -792)) - 8.2) < 0.01


def test_less_than_a_turn_there_and_back_is_none_however_often():
    assert turned(*[(0, 350), (350, 0)] * 10) == 0.0


def test_a_crescent_on_one_side_of_the_axis_is_no_turn_whatever_its_radii():
    world = Poses()
    counter = turns(ROD, VESSEL, needed=5, beyond=0.003, pause=2.0).counter()
    count = 0.0
    for leg in range(40):
        out = leg % 2 == 0
        for angle in np.radians(np.linspace(-57, 57, 20) * (1 if out else -1)):
            radius = 0.006 if out else 0.004
            world.tip = radius * np.array([np.cos(angle), np.sin(angle), 0.0])
            world.time += 1 / 30
            count = counter.add(world)
    assert count == 0.0


def test_a_short_pause_is_no_end_and_a_long_one_is_the_end_of_a_run():
    halves = [(0, 270), (270, 540), (540, 810)]
    assert abs(turned(*halves, pause=1.0) - 2.25) < 0.01
    assert turned(*halves, pause=3.0) == 0.0


def test_a_way_across_the_axis_is_no_half_turn():
    back_and_forth = [(0, 1), (180, 181)] * 10
    assert turned(*back_and_forth) == 0.0
    assert turned(*back_and_forth, across=True) == 0.0


def test_circles_too_near_the_axis_are_no_turns():
    assert turned((0, 1800), radius=0.002) == 0.0


def test_three_swings_are_three_about_any_axis():
    for direction in range(0, 360, 30):
        assert swung(*[(20, direction), (-20, direction)] * 3) == 3.0


def test_a_wobble_is_no_swing_and_a_lean_that_wobbles_is_half_of_one():
    assert swung(*[(12, 0), (-12, 0)] * 3) == 0.0
    assert swung(*[(20, 0), (14, 0)] * 3) == 0.5


def test_a_lean_that_goes_round_the_vertical_is_no_swing():
    assert swung(*[(20, direction) for direction in range(0, 1080, 10)]) < 1.0


DRAWER = Cabinet("cabinet").top_drawer


class Pulls:
    """A world in which a drawer is where the test puts it, its handle in the hand or not."""

    commanded_opening = 0.0
    gripper_opening = DRAWER.handle.diameter

    def __init__(self) -> None:
        self.position, self.held = 0.0, False

    def joint(self, name: str) -> float:
        return self.position

    def touching(self, first: str, second: str) -> bool:
        return self.held

    def frame(self, name: str) -> Pose:
        return Pose(np.zeros(3), np.eye(3))

    @property
    def gripper(self) -> Pose:
        return Pose(np.zeros(3), np.eye(3))


def pulled_to(*moves: tuple[float, bool]) -> float:
    """Count how far a drawer is pulled by moves, each to a position [m], in the hand or not."""
    world, counter = Pulls(), pulled(DRAWER, DRAWER.handle, to=0.13, slack=0.005).counter()
    count = counter.add(world)
    for position, held in moves:
        world.held = held
        for between in np.linspace(world.position, position, 30):
            world.position = float(between)
            count = counter.add(world)
    return count


def test_a_drawer_may_be_pulled_in_one_pull_or_several():
    assert pulled_to((0.13, True)) == 0.13
    assert pulled_to((0.07, True), (0.07, False), (0.13, True)) == 0.13
    assert pulled_to((0.07, True), (0.03, False), (0.13, True)) == 0.13


def test_what_a_drawer_moves_without_the_handle_in_the_hand_does_not_count():
    assert pulled_to((0.13, False)) == 0.0
    assert abs(pulled_to((0.05, True), (0.13, False), (0.13, True)) - 0.05) < 0.001
