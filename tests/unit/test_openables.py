"""Doors and drawers as mechanisms: where they start, how they move, where they stop."""

import math
from functools import partial

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.cabinet import Cabinet
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace
from labutopia_lerobot.layout import Inside, OnBench, Placement, sample_layout
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld

AJAR = {"oven": math.radians(30), "furnace": math.radians(30), "cabinet": 0.1}
KINDS = {"oven": DryingOven, "furnace": partial(MuffleFurnace, set_to=None), "cabinet": Cabinet}


def scene(name: str, ajar: float = 0.0):
    """Return a simulation, its world and the door or drawer of an instrument on the bench."""
    instrument = KINDS[name](name, ajar)
    part = instrument.top_drawer if isinstance(instrument, Cabinet) else instrument.door
    simulation = Simulation(compile_scene([instrument], PANDA, LABORATORY, DOOR_VIEW))
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


@pytest.mark.parametrize(("name", "force"), [("oven", 5.0), ("furnace", 5.0), ("cabinet", 20.0)])
def test_pulled_on_it_stops_at_its_widest(name, force):
    simulation, world, part = scene(name)
    simulation.data.joint(part.joint).qfrc_applied = force
    let_run(simulation, 5.0)
    assert world.joint(part.joint) == pytest.approx(part.widest, rel=0.02)


@pytest.mark.parametrize(
    ("name", "speed", "way"),
    [("oven", 1.0, 0.30), ("furnace", 1.0, 0.39), ("cabinet", 0.3, 0.020)],
)
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


@pytest.mark.parametrize("name", AJAR)
def test_every_element_is_named_after_the_instrument(name):
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    KINDS[name](name).add_to(spec, spec.worldbody)
    elements = [*spec.bodies[1:], *spec.geoms, *spec.joints, *spec.sites, *spec.materials]
    assert all(element.name.startswith(name) for element in elements)


@pytest.mark.parametrize(
    ("name", "part_at_free_edge", "wall"),
    [("oven", "door_near", "column"), ("furnace", "door_leaf", "casing_right")],
)
def test_a_closed_door_lies_on_its_box_without_a_gap(name, part_at_free_edge, wall):
    simulation, world, door = scene(name)
    panel = simulation.scene.model.geom(f"{name}_{part_at_free_edge}_hull")
    box = simulation.scene.model.geom(f"{name}_{wall}_hull")
    hinge = world.frame(door.joint).position_w
    placed = simulation.data.geom(panel.name)
    inward = placed.xmat.reshape(3, 3)[:, 0]
    face = (placed.xpos - hinge) @ inward + panel.size[0]
    front = (simulation.data.geom(box.name).xpos - hinge) @ inward - box.size[0]
    assert face == pytest.approx(front, abs=1e-4)
    assert world.joint(door.joint) < door.closed_within


@pytest.mark.parametrize("name", AJAR)
def test_the_frame_of_the_handle_lies_in_the_middle_of_its_bar(name):
    simulation, world, part = scene(name, AJAR[name])
    handle = world.frame(part.handle.name)
    bar = simulation.data.geom(f"{part.handle.name}_bar")
    assert handle.position_w == pytest.approx(bar.xpos, abs=1e-6)
    assert handle.z_axis == pytest.approx(bar.xmat.reshape(3, 3)[:, 2], abs=1e-6)


def test_a_beaker_stands_in_the_chamber_of_a_closed_furnace():
    furnace, held = MuffleFurnace("furnace"), glassware("beaker", "250 ml", "beaker")
    simulation = Simulation(compile_scene([furnace, held], PANDA, LABORATORY, DOOR_VIEW))
    start = {
        furnace: OnBench(x=(1.2, 1.2), y=(0.1, 0.1), yaw=(0.1, 0.1)),
        held: Inside(furnace, furnace.hearth),
    }
    simulation.reset(sample_layout(start, np.random.default_rng(0)))
    before = simulation.data.body("beaker").xpos.copy()
    let_run(simulation, 1.0)
    assert simulation.data.body("beaker").xpos == pytest.approx(before, abs=1e-3)
    assert simulation.data.joint(furnace.door.joint).qpos == pytest.approx(0.0, abs=1e-4)
