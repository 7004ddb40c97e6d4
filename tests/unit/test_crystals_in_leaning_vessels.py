"""Crystals stay on the bottom of a vessel that leans; in one that stands, height is what counts."""

import math

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.substances.filling import Filling
from solution_bench import GIVER, bench, liquid_of, mix

SALT = Filling(50.0, crystals=(Crystals("potassium nitrate", 30.0, 0.3),))


def test_in_a_vessel_that_leans_crystals_gather_at_its_base() -> None:
    simulation = bench(SALT, Filling(20.0))
    liquid = liquid_of(simulation)
    held = liquid.accounted == liquid.names.index(GIVER.name)
    assert liquid.over_bottoms() == pytest.approx(liquid.positions[:, 2])
    beaker = simulation.data.joint(f"{GIVER.name}_free").qpos
    local = liquid.positions[held] - beaker[:3]
    lean = math.radians(100.0)  # its lip is lower than its base
    beaker[3:] = (math.cos(lean / 2), math.sin(lean / 2), 0.0, 0.0)
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, beaker[3:])
    liquid.positions[held] = beaker[:3] + local @ turned.reshape(3, 3).T
    mujoco.mj_forward(simulation.scene.model, simulation.data)
    liquid.around.move()
    assert liquid.over_bottoms()[held] == pytest.approx(local[:, 2])
    mix(simulation, 5.0)
    assert liquid.solutions is not None
    solid = liquid.what.contents[held, liquid.solutions.inventory.species.index("KNO3(s)")]
    near = local[:, 2] < np.median(local[:, 2])
    assert solid[near].sum() > 0.9 * solid.sum() > 0.0
