"""Doors and drawers as mechanisms: where they start, how they move, where they stop."""

import math

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.cabinet import Cabinet
from labutopia_lerobot.labware.drying_oven import DryingOven
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots.panda import PANDA
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.views import DOOR_VIEW

AJAR = {"oven": math.radians(30), "cabinet": 0.1}


def scene(name: str, ajar: float = 0.0):
    """Return a simulation, its world and the door or drawer of an instrument on the bench."""
    instrument = DryingOven(name, ajar) if name == "oven" else Cabinet(name, ajar)
    part = instrument.door if name == "oven" else instrument.top_drawer
    simulation = Simulation(compile_scene([instrument], PANDA, DOOR_VIEW))
    simulation.reset({instrument: Placement(1.2, 0.1, 0.1)})  # out of reach of the arm
    return simulation, SimulatedWorld(simulation), part


def let_run(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


@pytest.mark.parametrize("name", AJAR)
def test_it_starts_where_it_was_left_and_stays_there(name):
    simulation, world, part = scene(name, AJAR[name])
    assert world.joint(part.joint) == pytest.approx(AJAR[name], abs=1e-4)
    let_run(simulation, 3.0)
    assert world.joint(part.joint) == pytest.approx(AJAR[name], abs=1e-4)


@pytest.mark.parametrize("name", AJAR)
def test_a_start_ajar_is_the_closed_one_moved_along_its_joint(name):
    _, closed, part = scene(name)
    _, opened, _ = scene(name, AJAR[name])
    expected = part.carried(closed.frame(part.handle.name), closed, AJAR[name])
    actual = opened.frame(part.handle.name)
    assert expected.distance_to(actual) < 1e-4
    assert expected.angle_to(actual) < 1e-3


@pytest.mark.parametrize("name", AJAR)
def test_the_handle_comes_towards_the_robot_as_it_opens(name):
    _, closed, part = scene(name)
    _, opened, _ = scene(name, AJAR[name])
    before, after = (w.frame(part.handle.name).position_w for w in (closed, opened))
    assert after[0] < before[0] - 0.05
    assert after[2] == pytest.approx(before[2], abs=1e-4)


@pytest.mark.parametrize(("name", "force"), [("oven", 5.0), ("cabinet", 20.0)])
def test_pulled_on_it_stops_at_its_widest(name, force):
    simulation, world, part = scene(name)
    simulation.data.joint(part.joint).qfrc_applied = force
    let_run(simulation, 5.0)
    assert world.joint(part.joint) == pytest.approx(part.widest, rel=0.02)


@pytest.mark.parametrize(("name", "speed", "way"), [("oven", 1.0, 0.30), ("cabinet", 0.3, 0.020)])
def test_friction_stops_what_is_let_go_of_in_motion(name, speed, way):
    simulation, world, part = scene(name, AJAR[name])
    simulation.data.joint(part.joint).qvel = speed
    let_run(simulation, 3.0)
    assert world.joint(part.joint) - AJAR[name] == pytest.approx(way, rel=0.15)


@pytest.mark.parametrize("name", AJAR)
def test_every_moving_body_has_a_hull_for_the_planner_and_a_mass(name):
    simulation, _, part = scene(name)
    model = simulation.scene.model
    assert 1.0 < model.body_subtreemass[model.body(part.name).id] < 10.0
    hulls = {int(model.geom_bodyid[geom]) for geom in np.flatnonzero(model.geom_group == 4)}
    assert {model.body(part.name).id, model.body(part.handle.name).id} <= hulls
    assert (model.geom_type[model.geom_group == 4] != mujoco.mjtGeom.mjGEOM_MESH).all()
