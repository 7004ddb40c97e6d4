"""Stopcocks let liquid through by opening, head and bore; shut, stoppered or empty they do not."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from labutopia_lerobot.labware.glass.catalogue import closed, glassware
from labutopia_lerobot.labware.glass.draining import Bore
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

BURETTE = replace(glassware("burette", "50 ml", "burette"), clamped=True)
FUNNEL = replace(glassware("separating_funnel", "250 ml", "funnel"), clamped=True)
BEAKER = glassware("beaker_low", "250 ml", "beaker")
OPEN = math.pi / 2
DENSITY, VISCOSITY = 997.0, 0.890e-3


def above_a_beaker(vessel, filling: Filling, particles: int = 500, more=()) -> Simulation:
    """Return a filled vessel that hangs over a beaker, come to rest."""
    pieces, contents = [vessel, BEAKER, *more], {vessel: filling}
    scene = compile_scene(pieces, PANDA, LABORATORY, DOOR_VIEW, contents, particles)
    simulation = Simulation(scene)
    layout = {vessel: Placement(0.4, 0.1, 0.0, height=0.13), BEAKER: Placement(0.4, 0.1, 0.0)}
    for closure in more:
        layout[closure] = Placement(0.4, 0.1, 0.0, height=0.13 + closure.seat(vessel))
    simulation.reset(layout)
    simulation.fill(np.random.default_rng(0))
    return simulation


def turn(simulation: Simulation, vessel, angle: float) -> None:
    joint = vessel.stopcocks[0].mechanism.joint
    simulation.data.joint(joint).qpos[:] = angle
    simulation.data.joint(joint).qvel[:] = 0.0


def wait(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def inside(simulation: Simulation, name: str) -> float:
    """Return what is in a vessel [ml]."""
    assert simulation.account is not None
    return 1e6 * simulation.account.inside[name]


def delivered(simulation: Simulation) -> float:
    return simulation.apparatus.reading(BURETTE.delivered).value


def emptying(vessel, volume: float, bore: Bore) -> float:
    """Integrate pressure = friction + jet + orifice, with a root finder, by itself [s]."""
    hole, outlet = math.pi * bore.hole**2 / 4, math.pi * bore.radius**2

    def rate(volume: float) -> float:
        head = vessel.profile.fill_height(max(volume, 0.0))
        friction = 8 * VISCOSITY * bore.length / (math.pi * bore.radius**4)
        squares = DENSITY / 2 * ((0.6 * hole) ** -2 + outlet**-2)
        return float(np.roots([squares, friction, -DENSITY * 9.81 * head]).max().real)

    done = lambda _, v: v[0] - 1e-9  # noqa: E731
    done.terminal = True
    solution = solve_ivp(lambda _, v: [-rate(v[0])], (0, 900), [volume], events=done, max_step=0.5)
    return float(solution.t_events[0][0])


@pytest.mark.parametrize(
    ("vessel", "ml"),
    [(BURETTE, 10.0), pytest.param(FUNNEL, 200.0, marks=pytest.mark.slow)],
    ids=["burette", "funnel"],
)
def test_it_empties_in_the_time_that_head_and_bore_say(vessel, ml):
    simulation = above_a_beaker(vessel, Filling(ml=ml))
    turn(simulation, vessel, OPEN)
    expected, steps = emptying(vessel, 1e-6 * ml, vessel.stopcocks[0].bore), 0
    while inside(simulation, vessel.name) > 0.0:
        wait(simulation, 1 / 30)
        steps += 1
        assert steps < 30 * 2 * expected
    assert steps / 30 == pytest.approx(expected, rel=0.05)
    wait(simulation, 2.0)
    assert inside(simulation, "beaker") == pytest.approx(ml, rel=0.01)


@pytest.mark.slow
def test_a_shut_cock_leaks_nothing_and_nothing_is_lost():
    simulation = above_a_beaker(BURETTE, Filling(ml=50.0))
    wait(simulation, 5.0)
    assert inside(simulation, "burette") == pytest.approx(50.0)
    assert delivered(simulation) == 0.0
    turn(simulation, BURETTE, OPEN)
    for _ in range(300):
        wait(simulation, 1 / 30)
        assert simulation.account.total == pytest.approx(50e-6, rel=1e-12)
        assert simulation.account.counts.sum() == 500
    turn(simulation, BURETTE, 0.0)
    wait(simulation, 2.0)
    left = delivered(simulation)
    assert abs(left - inside(simulation, "beaker")) <= 0.1 + 1e-9  # one particle
    wait(simulation, 3.0)
    assert delivered(simulation) == left


@pytest.mark.slow
def test_half_open_gives_the_share_that_the_circles_have_in_common():
    bore = FUNNEL.stopcocks[0].bore
    full, none = bore.opening(OPEN), bore.opening(OPEN - 2 * math.asin(bore.hole / bore.plug))
    assert full == pytest.approx(math.pi * bore.hole**2 / 4)
    assert none == 0.0
    angle = OPEN - 2 * math.asin(bore.hole / 2 / bore.plug)  # half a diameter apart
    share = (2 * math.acos(0.5) - math.sin(2 * math.acos(0.5))) / math.pi
    assert bore.opening(angle) == pytest.approx(share * full)
    simulation = above_a_beaker(FUNNEL, Filling(ml=200.0))
    gone = []
    for at in (OPEN, angle):
        kept = simulation.state()
        turn(simulation, FUNNEL, at)
        wait(simulation, 4.0)
        gone.append(200.0 - inside(simulation, "funnel"))
        simulation.restore(kept)
    outlet = (math.pi * bore.radius**2) ** -2
    expected = [((0.6 * part) ** -2 + outlet) ** -0.5 for part in (full, share * full)]
    assert gone[1] / gone[0] == pytest.approx(expected[1] / expected[0], rel=0.06)


def test_a_stopper_holds_it():
    _, stopper = closed("separating_funnel", "250 ml", "funnel")
    simulation = above_a_beaker(FUNNEL, Filling(ml=150.0), more=(stopper,))
    turn(simulation, FUNNEL, OPEN)
    wait(simulation, 2.0)
    assert inside(simulation, "funnel") == pytest.approx(150.0)


def test_it_goes_on_bit_for_bit_from_a_saved_state():
    simulation = above_a_beaker(BURETTE, Filling(ml=50.0))
    turn(simulation, BURETTE, OPEN)
    wait(simulation, 3.0)
    kept, results = simulation.state(), []
    for _ in range(2):
        simulation.restore(kept)
        wait(simulation, 2.0)
        results.append(simulation.state().tobytes())
    assert results[0] == results[1]


def test_of_what_is_poured_in_from_above_the_column_grows():
    simulation = above_a_beaker(BURETTE, Filling(ml=20.0), particles=200)
    top = simulation.data.site(BURETTE.rim).xpos + np.array([0.0, 0.0, 0.004])
    simulation.liquid.release(top[None], np.zeros((1, 3)))
    wait(simulation, 2.0)
    assert inside(simulation, "burette") == pytest.approx(20.1)
