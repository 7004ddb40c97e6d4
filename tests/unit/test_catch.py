"""The roller catch as a mechanism: it clicks shut, and holds against what it is said to hold."""

import math

import pytest

from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.parts.catch import HOLDS
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.predicates import latched
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld

RADIUS = 0.496
"""From the hinge to the catch [m], which is above the handle."""


class Oven:
    """An oven out of the robot's reach, whose door is pulled and pushed at its catch."""

    def __init__(self, ajar_deg: float = 0.0, *, latching: bool = True) -> None:
        oven = DryingOven("oven", math.radians(ajar_deg), latching=latching, stand=0.2)
        self.door = oven.door
        self.simulation = Simulation(compile_scene([oven], PANDA, LABORATORY, DOOR_VIEW))
        self.simulation.reset({oven: Placement(1.2, 0.1, 0.1)})
        self.world = SimulatedWorld(self.simulation)

    def pull(self, force: float, seconds: float = 1.0) -> float:
        """Pull with a force [N], or push if it is negative; return the angle then [deg]."""
        self.simulation.data.joint(self.door.joint).qfrc_applied = force * RADIUS
        for _ in range(round(30 * seconds)):
            self.simulation.step(self.simulation.command)
        return math.degrees(self.world.joint(self.door.joint))


def test_it_holds_a_shut_door_against_its_force_and_no_more():
    oven = Oven()
    assert latched(oven.door).holds(oven.world)
    assert oven.pull(HOLDS - 2) < 0.1
    assert latched(oven.door).holds(oven.world)
    assert oven.pull(HOLDS + 2) > 2


def test_a_door_that_is_pushed_lightly_stays_before_it():
    oven = Oven(ajar_deg=2)
    assert oven.pull(-3) == pytest.approx(1.5, abs=0.1)
    assert oven.pull(-HOLDS) == pytest.approx(1.5, abs=0.1)
    assert oven.pull(0) > 1
    assert not latched(oven.door).holds(oven.world)


def test_a_door_that_is_pushed_hard_clicks_in_and_stays_shut():
    oven = Oven(ajar_deg=4)
    oven.pull(-1.5 * HOLDS)
    oven.pull(0)
    assert latched(oven.door).holds(oven.world)


def test_a_door_without_one_cannot_be_latched():
    with pytest.raises(ValueError, match="has no catch"):
        latched(Oven(latching=False).door)
