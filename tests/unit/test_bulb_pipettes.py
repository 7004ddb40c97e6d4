"""A pipette with a rubber bulb takes in what the bulb gives back, and drips as a soft bulb does."""

from typing import ClassVar

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.bulb_pipette import BulbPipette
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling


class Held(BulbPipette):
    """A pipette that something holds."""

    movable: ClassVar[bool] = False


PIPETTE = Held("pipette")
SOURCE = glassware("beaker_low", "50 ml", "source")
TARGET = glassware("beaker_low", "50 ml", "target")
AT = {SOURCE: (0.4, 0.1), TARGET: (0.4, -0.1)}
DEEP, HIGH = 0.006, 0.10
PARTICLE = 0.02  # ml: 30 ml of 1500
HEAD = 997.0 * 9.81 * 1e-6 / 1.2e-5  # Pa, of 1 ml
WALL, FLAT = 1500.0, 0.0045  # N/m, m
SHORT = 0.075
"""By how much more than 1 ml the bulb is squeezed for 1 ml: the column hangs on air and rubber."""


@pytest.fixture
def simulation() -> Simulation:
    scene = compile_scene(
        [PIPETTE, SOURCE, TARGET], PANDA, LABORATORY, DOOR_VIEW, {SOURCE: Filling(ml=30.0)}, 1500
    )
    simulation = Simulation(scene)
    layout = {piece: Placement(x, y, 0.0) for piece, (x, y) in AT.items()}
    simulation.reset({**layout, PIPETTE: Placement(0.4, 0.1, 0.0, height=HIGH)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def bring(simulation: Simulation, piece, height: float, lean: float = 0.0) -> None:
    body = simulation.scene.model.body("pipette")
    body.pos = (*AT[piece], LABORATORY.bench.height + height)
    body.quat = (np.cos(lean / 2), np.sin(lean / 2), 0.0, 0.0)


def squeeze(simulation: Simulation, travel: float, seconds: float = 0.8) -> None:
    """Press each wall so far in that its rubber balances the finger, as slowly as a person does."""
    joints = [simulation.data.joint(grip.joint) for grip in PIPETTE.grips]
    before, steps = float(joints[0].qfrc_applied[0]), round(30 * seconds)
    for step in range(steps):
        share = min(1.0, (step + 1) / (0.75 * steps))
        for joint in joints:
            joint.qfrc_applied[:] = before + share * (WALL * travel - before)
        simulation.step(simulation.command)


def take_up(simulation: Simulation, ml: float = 1.0, lean: float = 0.0) -> None:
    """Squeeze beside the liquid, dip, let go, and lift out."""
    travel = ml * (1.0 + SHORT) * 1e-6 / 2.5e-4 / 2
    bring(simulation, SOURCE, HIGH, lean)
    squeeze(simulation, travel)
    bring(simulation, SOURCE, DEEP, lean)
    squeeze(simulation, travel, 0.1)
    squeeze(simulation, 0.0, 0.8)
    bring(simulation, SOURCE, HIGH, lean)
    squeeze(simulation, 0.0, 0.2)


def inside(simulation: Simulation, name: str) -> float:
    """Return what is in something [ml]."""
    assert simulation.account is not None
    return 1e6 * simulation.account.inside[name]


def drawn(simulation: Simulation) -> float:
    return simulation.apparatus.reading(PIPETTE.drawn).value


@pytest.mark.slow
def test_a_millilitre_is_one_twenty_times(simulation):
    given = []
    for _ in range(20):
        take_up(simulation)
        before = inside(simulation, "target")
        bring(simulation, TARGET, 0.05)
        squeeze(simulation, FLAT)
        squeeze(simulation, 0.0)
        given.append(inside(simulation, "target") - before)
        assert simulation.account.counts.sum() == 1500
    assert given == pytest.approx([1.0] * 20, rel=0.021)  # one particle is 2 %
    assert inside(simulation, "pipette") == 0.0


def test_what_it_takes_in_is_what_the_bulb_displaced_less_what_the_column_stretches(simulation):
    take_up(simulation)
    air = 6.4e-6 - 1e-6  # above the liquid [m^3]
    stretched = HEAD * (air / 101325.0 + 4e-11)
    assert drawn(simulation) == pytest.approx(1.075 - 1e6 * stretched, abs=0.005)
    assert inside(simulation, "pipette") == pytest.approx(drawn(simulation), abs=PARTICLE)


@pytest.mark.slow
def test_raised_from_a_slant_it_drips_what_air_and_rubber_give_way_by(simulation):
    slant = np.radians(75.0)
    take_up(simulation, lean=slant)
    aslant = drawn(simulation)
    squeeze(simulation, 0.0, 0.5)
    assert drawn(simulation) == aslant  # the meniscus carries it
    bring(simulation, SOURCE, HIGH)
    squeeze(simulation, 0.0, 0.5)
    meniscus = 2 * 0.0728 / 5e-4
    column = HEAD * aslant
    more = column * (1.0 - np.cos(slant)) - meniscus  # Pa
    drips = 1e6 * more * ((6.4e-6 - 1e-6 * aslant) / 101325.0 + 4e-11)
    assert drips > PARTICLE
    assert aslant - drawn(simulation) == pytest.approx(drips, rel=0.1)
    assert simulation.account.counts.sum() == 1500


@pytest.mark.slow
def test_a_squeeze_in_the_air_gives_it_back_and_takes_in_none(simulation):
    squeeze(simulation, FLAT)
    squeeze(simulation, 0.0)
    assert drawn(simulation) == 0.0
    take_up(simulation, 0.5)
    squeeze(simulation, FLAT)
    assert inside(simulation, "pipette") == 0.0
    assert simulation.account.counts.sum() == 1500
