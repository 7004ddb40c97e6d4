"""The vacuum oven: its door is shut until the lever is turned."""

import math
from functools import partial

import mujoco
import numpy as np
import pytest

from adversary import begun_with, play
from labutopia_lerobot.labware.instruments.vacuum_oven import VacuumOven
from labutopia_lerobot.labware.parts.lever import Lever
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.tasks.level1.open_door import open_oven

OVEN = VacuumOven("oven", set_to=None)
DOOR, LEVER = OVEN.door.joint, OVEN.door.handle.joint


@pytest.fixture
def simulation() -> Simulation:
    result = Simulation(compile_scene([OVEN], PANDA, LABORATORY, DOOR_VIEW))
    result.reset({OVEN: Placement(1.2, 0.1, 0.1)})  # out of reach of the arm
    return result


def pulled(simulation: Simulation, torque: float, lever_deg: float) -> float:
    """Pull at the door [N m] for half a second with the lever turned; return its angle [rad]."""
    simulation.data.joint(LEVER).qpos = math.radians(lever_deg)
    simulation.data.joint(DOOR).qfrc_applied = torque
    for _ in range(15):
        simulation.step(simulation.command)
    return float(simulation.data.joint(DOOR).qpos[0])


@pytest.mark.parametrize("lever_deg", [0.0, 30.0, 45.0])
def test_a_door_whose_lever_is_not_turned_far_enough_stays_closed(simulation, lever_deg):
    assert pulled(simulation, 40.0, lever_deg) < OVEN.door.closed_within


def test_a_door_whose_lever_is_turned_opens(simulation):
    turned = math.degrees(OVEN.door.handle.turn)
    assert pulled(simulation, 5.0, turned) > math.radians(20)


def test_the_lever_stays_where_it_is_left(simulation):
    pulled(simulation, 0.0, 40.0)
    assert simulation.data.joint(LEVER).qpos[0] == pytest.approx(math.radians(40), abs=0.02)


def test_the_frame_of_the_lever_turns_about_its_axis(simulation):
    world = SimulatedWorld(simulation)
    lever = OVEN.door.handle
    expected = lever.carried(world.frame(lever.name), world, math.radians(40))
    pulled(simulation, 0.0, 40.0)
    assert expected.distance_to(world.frame(lever.name)) < 2e-3
    assert world.frame(lever.name).z_axis[2] == pytest.approx(math.sin(math.radians(40)), abs=0.02)


def test_every_element_is_named_after_the_oven_and_moving_bodies_have_hulls(simulation):
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    OVEN.add_to(spec, spec.worldbody)
    elements = [*spec.bodies[1:], *spec.geoms, *spec.joints, *spec.sites, *spec.materials]
    assert all(element.name.startswith("oven") for element in elements)
    model = simulation.scene.model
    hulls = {int(model.geom_bodyid[geom]) for geom in np.flatnonzero(model.geom_group == 4)}
    assert {model.body(name).id for name in OVEN.bodies} <= hulls


def test_who_turns_the_lever_too_little_does_not_succeed(monkeypatch):
    name = "labutopia_lerobot.labware.instruments.vacuum_oven.Lever"
    monkeypatch.setattr(name, partial(Lever, turn=math.radians(25)))
    env = begun_with("level1/open_door", open_oven(OVEN), monkeypatch)
    info = play(env)
    assert info["outcome"] == "running"
    assert info["substeps"]["gripped"] < math.inf
