"""A pump with hoses moves what the turns of its head squeeze on, from one vessel to another."""

import math

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.transfer_pump import TransferPump
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

PUMP = TransferPump("pump")
SOURCE = glassware("beaker_low", "150 ml", "source")
TARGET = glassware("beaker_low", "150 ml", "target")
PARTICLE = 0.1  # ml


@pytest.fixture
def simulation() -> Simulation:
    scene = compile_scene(
        [PUMP, SOURCE, TARGET], PANDA, LABORATORY, DOOR_VIEW, {SOURCE: Filling(ml=60.0)}, 600
    )
    simulation = Simulation(scene)
    simulation.reset(
        {
            PUMP: Placement(0.6, 0.0, 0.0),
            SOURCE: Placement(0.45, 0.185, 0.0),
            TARGET: Placement(0.45, -0.185, 0.0),
        }
    )
    simulation.fill(np.random.default_rng(0))
    return simulation


def run(simulation: Simulation, rpm: float, seconds: float) -> None:
    """Set knob and switch, and let it run."""
    simulation.data.joint(PUMP.speed.joint).qpos[:] = rpm / 300.0 * PUMP.speed.widest
    simulation.data.joint(PUMP.power.joint).qpos[:] = PUMP.power.widest
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def inside(simulation: Simulation, name: str) -> float:
    """Return what is in something [ml]."""
    assert simulation.account is not None
    return 1e6 * simulation.account.inside[name]


def test_it_moves_two_millilitres_with_every_turn_of_its_head(simulation):
    head = simulation.data.joint(PUMP.head.joint).qpos
    before = float(head[0])
    run(simulation, 60.0, 10.0)
    turns = abs(float(head[0]) - before) / (2 * math.pi)
    assert turns == pytest.approx(10.0, abs=0.5)  # 60 rpm for 10 s, less the ramp
    gone = 60.0 - inside(simulation, "source")
    assert gone == pytest.approx(2.0 * turns, abs=2 * PARTICLE)
    run(simulation, 0.0, 1.5)  # what is in the air comes down
    gone = 60.0 - inside(simulation, "source")
    assert inside(simulation, "target") == pytest.approx(gone, abs=PARTICLE)
    assert simulation.account.counts.sum() == 600


@pytest.mark.slow
def test_it_runs_dry_where_its_hose_ends(simulation):
    run(simulation, 300.0, 10.0)  # 100 ml, of 60
    left = inside(simulation, "source")
    run(simulation, 300.0, 1.0)
    assert 10.0 < left < 25.0  # what is below the hose's end, 8 mm deep, stays
    assert inside(simulation, "source") == pytest.approx(left, abs=PARTICLE)
    assert simulation.account.counts.sum() == 600
