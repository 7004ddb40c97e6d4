"""A piston pipette takes in what it dips into and gives out what its grips displace."""

from typing import ClassVar

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.piston_pipette import PistonPipette
from labutopia_lerobot.labware.instruments.support.pipette_stand import PipetteStand
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling


class Held(PistonPipette):
    """A pipette that something holds."""

    movable: ClassVar[bool] = False


PIPETTE = Held("pipette")
SOURCE = glassware("beaker_low", "150 ml", "source")
TARGET = glassware("beaker_low", "50 ml", "target")
AT = {SOURCE: (0.4, 0.1), TARGET: (0.4, -0.1)}
DEEP, HIGH = 0.025, 0.10
FIRST, SECOND = 7.8, 30.0  # N; the springs say 7.8 at the first stop


@pytest.fixture
def simulation() -> Simulation:
    scene = compile_scene(
        [PIPETTE, SOURCE, TARGET], PANDA, LABORATORY, DOOR_VIEW, {SOURCE: Filling(ml=100.0)}, 1000
    )
    simulation = Simulation(scene)
    layout = {piece: Placement(x, y, 0.0) for piece, (x, y) in AT.items()}
    simulation.reset({**layout, PIPETTE: Placement(0.4, 0.1, 0.0, height=HIGH)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def bring(simulation: Simulation, piece, height: float) -> None:
    bench = LABORATORY.bench.height
    simulation.scene.model.body("pipette").pos = (*AT[piece], bench + height)


def press(simulation: Simulation, force: float, seconds: float = 0.5) -> None:
    for grip in PIPETTE.grips:
        simulation.data.joint(grip.joint).qfrc_applied[:] = force
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def take_up(simulation: Simulation) -> None:
    """Take in the set volume."""
    bring(simulation, SOURCE, HIGH)
    press(simulation, FIRST)
    bring(simulation, SOURCE, DEEP)
    press(simulation, FIRST)
    press(simulation, 0.0, 1.0)
    bring(simulation, SOURCE, HIGH)
    press(simulation, 0.0, 0.2)


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
        assert drawn(simulation) == pytest.approx(1.0, rel=0.02)
        before = inside(simulation, "target")
        bring(simulation, TARGET, 0.05)
        press(simulation, SECOND)
        press(simulation, 0.0)
        given.append(inside(simulation, "target") - before)
        assert simulation.account.counts.sum() == 1000
    assert given == pytest.approx([1.0] * 20, rel=0.02)
    assert inside(simulation, "pipette") == 0.0


def test_air_gives_nothing(simulation):
    for force in (SECOND, 0.0, SECOND, 0.0):
        press(simulation, force)
    assert drawn(simulation) == 0.0
    assert inside(simulation, "source") == pytest.approx(100.0)
    assert simulation.account.transfers == {}


def test_it_goes_on_bit_for_bit_from_a_saved_state(simulation):
    take_up(simulation)
    kept, results = simulation.state(), []
    for _ in range(2):
        simulation.restore(kept)
        press(simulation, SECOND)
        results.append(simulation.state().tobytes())
    assert results[0] == results[1]


def test_it_drips_when_it_is_warmed(simulation):
    take_up(simulation)
    full, memory = drawn(simulation), simulation.apparatus.memory(PIPETTE.works[0])
    press(simulation, 0.0, 2.0)
    assert drawn(simulation) == full
    held = inside(simulation, "pipette")
    memory[3] += 30.0  # a burner nearby
    press(simulation, 0.0, 1.0)
    assert drawn(simulation) < full - 0.1
    assert inside(simulation, "pipette") < held
    assert simulation.account.counts.sum() == 1000


def test_it_hangs_on_a_hook_of_its_stand_and_lips_keep_it_there():
    stand, pipette = PipetteStand("stand"), PistonPipette("pipette")
    simulation = Simulation(compile_scene([stand, pipette], PANDA, LABORATORY, DOOR_VIEW))
    x, y, z = stand.hanging(pipette)
    simulation.reset(
        {stand: Placement(0.3, 0.1, 0.0), pipette: Placement(0.3 + x, 0.1 + y, 0.0, height=z)}
    )
    body = simulation.data.body("pipette")
    hung = body.xpos.copy()
    for _ in range(60):
        simulation.step(simulation.command)
    assert body.xpos == pytest.approx(hung, abs=5e-4)
    body.xfrc_applied[0] = 0.2  # N, off the column
    for _ in range(60):
        simulation.step(simulation.command)
    assert np.linalg.norm(body.xpos - hung) < 0.01  # the lips keep it


def lean(simulation: Simulation, angle: float) -> None:
    turn = (np.cos(angle / 2), np.sin(angle / 2), 0.0, 0.0)
    simulation.scene.model.body("pipette").quat = turn


def test_what_was_taken_in_aslant_runs_out_upright(simulation):
    """An upright column is higher: what the meniscus does not carry leaves, here nanolitres."""
    lean(simulation, np.radians(75))
    take_up(simulation)
    aslant = drawn(simulation)
    press(simulation, 0.0, 1.0)
    assert drawn(simulation) == aslant
    lean(simulation, 0.0)
    press(simulation, 0.0, 1.0)
    assert drawn(simulation) < aslant
