"""What is held in the hand stays where it is held, and pads do not sink into glass."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import Thing


def held(task: str) -> tuple[LabEnv, Thing]:
    """Return an environment in which a setup has picked something up, at rest."""
    env = LabEnv(Setting(task, obs="state", liquid="off"))
    env.reset(seed=0)
    for _ in range(30):
        env.workcell.simulation.step(env.workcell.simulation.command)
    return env, next(piece for piece in env.workcell.task.start if piece.movable)


@pytest.mark.parametrize("task", ["level1/stir", "level1/place"])
def test_pads_sink_into_glass_by_less_than_three_tenths_of_a_millimetre(task):
    env, _ = held(task)
    simulation = env.workcell.simulation
    pads = [simulation.scene.model.geom(pad).id for pad in simulation.scene.robot.gripper.pads]
    contact = simulation.data.contact
    touching = np.isin(contact.geom, pads).any(axis=1)
    assert touching.any()
    assert contact.dist[touching].min() > -0.0003


def test_a_held_rod_creeps_by_less_than_a_fifth_of_a_millimetre_in_twenty_seconds():
    env, rod = held("level1/stir")
    world, simulation = env.workcell.world, env.workcell.simulation
    before = world.gripper.inverse() @ world.pose(rod)
    for _ in range(20 * 30):
        simulation.step(simulation.command)
    assert (world.gripper.inverse() @ world.pose(rod)).distance_to(before) < 0.0002
