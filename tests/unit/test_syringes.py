"""A syringe takes in what its plunger makes room for, and gives it out again."""

from dataclasses import dataclass
from typing import override

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware, ware
from labutopia_lerobot.labware.glass.syringe import Syringe
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling


@dataclass(frozen=True)
class Held(Syringe):
    """A syringe that something holds."""

    @property
    @override
    def movable(self) -> bool:
        return False


def held(kind: str, size: str) -> Held:
    made = ware(kind, size, "syringe")
    assert isinstance(made, Syringe)
    return Held("syringe", made.shape, made.material, bore=made.bore, tip=made.tip)


SOURCE = glassware("beaker_low", "150 ml", "source")
TARGET = glassware("beaker_low", "50 ml", "target")
AT = {SOURCE: (0.4, 0.1), TARGET: (0.4, -0.1)}
DEEP, HIGH = 0.020, 0.10


def beside(syringe: Held, filled: float) -> Simulation:
    """Return a syringe over a beaker with some water [ml]."""
    contents = {SOURCE: Filling(ml=filled)}
    scene = compile_scene([syringe, SOURCE, TARGET], PANDA, LABORATORY, DOOR_VIEW, contents, 1000)
    simulation = Simulation(scene)
    layout = {piece: Placement(x, y, 0.0) for piece, (x, y) in AT.items()}
    simulation.reset({**layout, syringe: Placement(0.4, 0.1, 0.0, height=HIGH)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def bring(simulation: Simulation, piece, height: float) -> None:
    bench = LABORATORY.bench.height
    simulation.scene.model.body("syringe").pos = (*AT[piece], bench + height)


def pull(simulation: Simulation, syringe: Held, to_ml: float, seconds: float = 0.6) -> None:
    """Move the plunger evenly to where it makes room for a volume, and keep it there a while."""
    slide = simulation.data.joint(syringe.plunger.joint)
    goal, steps = 1e-6 * to_ml / syringe.section, round(30 * seconds)
    way = np.linspace(slide.qpos[0], goal, steps + 1)[1:]
    for position in (*way, *[goal] * 10):
        slide.qpos[0], slide.qvel[0] = position, 0.0
        simulation.step(simulation.command)


def inside(simulation: Simulation, name: str) -> float:
    """Return what is in something [ml]."""
    assert simulation.account is not None
    return 1e6 * simulation.account.inside[name]


@pytest.mark.parametrize(
    ("kind", "size"),
    [
        ("syringe_plastic", "5 ml"),
        pytest.param("syringe_glass", "10 ml", marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("times", [3, pytest.param(20, marks=pytest.mark.slow)])
def test_a_millilitre_is_one_every_time(kind, size, times):
    syringe = held(kind, size)
    simulation, given = beside(syringe, 100.0), []
    for _ in range(times):
        bring(simulation, SOURCE, DEEP)
        pull(simulation, syringe, 1.0)
        bring(simulation, SOURCE, HIGH)
        pull(simulation, syringe, 1.0, 0.2)
        assert simulation.apparatus.reading(syringe.drawn).value == pytest.approx(1.0, rel=0.02)
        before = inside(simulation, "target")
        bring(simulation, TARGET, 0.05)
        pull(simulation, syringe, 0.0)
        given.append(inside(simulation, "target") - before)
        assert simulation.account.counts.sum() == 1000
    assert given == pytest.approx([1.0] * times, rel=0.02)
    assert inside(simulation, "syringe") == 0.0


def test_it_takes_in_no_more_than_there_is_room_for():
    syringe = held("syringe_plastic", "5 ml")
    simulation = beside(syringe, 100.0)
    bring(simulation, SOURCE, DEEP)
    pull(simulation, syringe, 4.0, 1.5)
    assert inside(simulation, "syringe") == pytest.approx(4.0, abs=0.11)
    half = 2.0
    bring(simulation, TARGET, 0.05)
    pull(simulation, syringe, half, 1.0)
    assert inside(simulation, "syringe") == pytest.approx(half, abs=0.11)


def test_above_the_liquid_it_takes_in_air():
    syringe = held("syringe_plastic", "5 ml")
    simulation = beside(syringe, 20.0)
    pull(simulation, syringe, 2.0)
    assert inside(simulation, "syringe") == 0.0
    assert simulation.apparatus.reading(syringe.drawn).value == 0.0
