"""Interlocks both ways, what is unbalanced trips, timers count and stop what they time."""

import mujoco
import numpy as np
import pytest

from instrument_bench import Bench
from labutopia_lerobot.labware.glass.catalogue import ware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.separating.clinical_centrifuge import ClinicalCentrifuge
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling


def lifted(bench: Bench, torque: float = 14.0) -> float:
    """Pull at a lid as 40 N at its edge do, and return how far it has opened [rad]."""
    lid = bench.data.joint(bench.piece.lid.joint)
    lid.qfrc_applied[:] = torque
    bench.wait(0.5)
    lid.qfrc_applied[:] = 0.0
    return float(lid.qpos[0])


def running(minutes: float = 1.0) -> Bench:
    """Return a centrifuge that runs at 2000 rpm."""
    bench = Bench("centrifuge")
    bench.put(bench.piece.speed, 0.5)
    bench.put(bench.piece.time, minutes / 30.0)
    bench.press(bench.piece.start)
    bench.wait(13.0)
    assert bench.read("centrifuge_rpm").value == pytest.approx(2000.0, rel=0.02)
    return bench


def test_a_shut_centrifuge_opens_only_after_its_latch_is_pressed_at_a_standstill():
    bench = running()
    assert lifted(bench) < np.radians(1.0)
    bench.press(bench.piece.latch)
    assert lifted(bench) < np.radians(1.0)
    bench.press(bench.piece.stop)
    bench.wait(11.0)
    assert bench.read("centrifuge_rpm").value < 1.0
    assert lifted(bench) < np.radians(1.0)
    bench.press(bench.piece.latch)
    assert lifted(bench) > np.radians(20.0)


def test_a_centrifuge_refuses_to_start_open_and_says_why():
    bench = Bench("centrifuge")
    bench.put(bench.piece.speed, 0.5)
    bench.put(bench.piece.time, 0.5)
    bench.put(bench.piece.lid, 1.0)
    bench.press(bench.piece.start)
    bench.wait(2.0)
    assert bench.read("centrifuge_rpm").value < 1.0
    assert bench.text("centrifuge_left") == "LID OPEN"
    bench.put(bench.piece.lid, 0.0)
    bench.wait(1.0)
    assert bench.text("centrifuge_left") == "15:00"
    assert bench.read("centrifuge_rpm").value < 1.0
    bench.press(bench.piece.start)
    bench.wait(2.0)
    assert bench.read("centrifuge_rpm").value > 300.0


def test_a_lid_with_a_spring_opens_by_itself_once_its_latch_is_pressed_and_not_before():
    bench = Bench(ClinicalCentrifuge("clinical", lid_springs=True))
    lid = bench.data.joint(bench.piece.lid.joint)
    bench.wait(3.0)
    assert lid.qpos[0] < np.radians(0.5)
    bench.press(bench.piece.latch)
    fastest = 0.0
    for _ in range(60):
        bench.wait(1 / 30)
        fastest = max(fastest, float(lid.qvel[0]))
    assert lid.qpos[0] == pytest.approx(bench.piece.lid.widest, abs=0.01)
    assert 0.5 < fastest < 1.3


def test_its_timer_stops_it():
    bench = running(1.0)
    left = bench.read("centrifuge_left").value
    assert left == pytest.approx(60.0 - 13.2, abs=0.4)
    bench.wait(left + 0.1)
    assert bench.read("centrifuge_left").value == 0.0
    bench.wait(12.0)
    assert bench.read("centrifuge_rpm").value < 1.0


def spun(grams: dict[int, float], water: dict[int, float] | None = None) -> Simulation:
    """Return a centrifuge that was started with extra weight [g] or water [ml] in its bores."""
    centrifuge = instrument("centrifuge", "centrifuge")
    water = water or {}
    tubes = {bore: ware("centrifuge_tube", "15 ml", f"tube_{bore}") for bore in {*grams, *water}}
    contents = {tubes[bore]: Filling(ml=ml) for bore, ml in water.items()}
    pieces = [centrifuge, *tubes.values()]
    simulation = Simulation(compile_scene(pieces, PANDA, LABORATORY, DOOR_VIEW, contents))
    aside = {tube: Placement(0.9, -0.3 + 0.1 * n, 0.0) for n, tube in enumerate(tubes.values())}
    simulation.reset({centrifuge: Placement(0.3, 0.3, 0.0), **aside})
    data, model = simulation.data, simulation.scene.model
    layout = {centrifuge: Placement(0.3, 0.3, 0.0)}
    for bore, tube in tubes.items():
        x, y, z = data.site(centrifuge.places[bore].name).xpos
        layout[tube] = Placement(x, y, 0.0, height=z - LABORATORY.bench.height + 0.001)
        model.body(tube.name).mass += 1e-3 * grams.get(bore, 0.0)
    mujoco.mj_setConst(model, mujoco.MjData(model))
    simulation.reset(layout)
    simulation.fill(np.random.default_rng(0))
    for joint, share in ((centrifuge.speed.joint, 0.5), (centrifuge.time.joint, 1.0)):
        data.joint(joint).qpos[0] = share * centrifuge.speed.widest
    for push in (5.0, 0.0):
        data.joint(centrifuge.start.joint).qfrc_applied[:] = push
        wait(simulation, 0.3)
    wait(simulation, 3.0)
    return simulation


def wait(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def balanced(simulation: Simulation) -> bool:
    return bool(simulation.apparatus.reading("centrifuge_balanced").value)


@pytest.mark.parametrize(
    ("grams", "even"),
    [({0: 0.0, 6: 0.0}, True), ({0: 2.0, 6: 0.0}, True), ({0: 12.0, 6: 0.0}, False)],
)
def test_what_is_uneven_trips_it_and_what_is_even_does_not(grams, even):
    simulation = spun(grams)
    assert balanced(simulation) is even
    speed = simulation.apparatus.reading("centrifuge_rpm").value
    assert (speed > 500.0) is even
    text = simulation.apparatus.processes["centrifuge_left"].text(simulation.apparatus)
    assert (text == "UNBALANCED") is not even


@pytest.mark.slow
def test_water_counts_for_its_balance():
    assert not balanced(spun({}, {0: 10.0, 6: 1.0}))
    assert balanced(spun({}, {0: 6.0, 6: 6.0}))


def test_a_mini_centrifuge_stops_when_its_lid_opens():
    bench = Bench("mini_centrifuge")
    bench.put(bench.piece.power, 1.0)
    bench.wait(4.0)
    assert bench.read("mini_centrifuge_rpm").value == pytest.approx(6000.0, rel=0.01)
    bench.put(bench.piece.lid, 1.0)
    bench.wait(4.0)
    assert bench.read("mini_centrifuge_rpm").value < 1.0
    bench.put(bench.piece.lid, 0.0)
    bench.wait(4.0)
    assert bench.read("mini_centrifuge_rpm").value == pytest.approx(6000.0, rel=0.01)


def test_a_peristaltic_pump_stands_still_while_its_shoe_is_up():
    bench = Bench("peristaltic_pump")
    bench.put(bench.piece.shoe, 1.0)
    bench.put(bench.piece.speed, 1.0)
    bench.put(bench.piece.power, 1.0)
    bench.wait(2.0)
    assert bench.read("peristaltic_pump_rpm").value < 1.0
    bench.put(bench.piece.shoe, 0.0)
    bench.wait(2.0)
    assert bench.read("peristaltic_pump_rpm").value == pytest.approx(300.0, rel=0.02)


def test_a_stopwatch_starts_stops_and_is_set_to_zero():
    bench = Bench("laboratory_timer")
    begin, reset = bench.piece.keys
    name = "laboratory_timer_time"
    bench.wait(1.0)
    assert bench.text(name) == "00:00"
    bench.press(begin)
    bench.wait(2.0)
    assert bench.read(name).value == pytest.approx(2.4, abs=0.2)
    assert not bench.read(name).settled
    bench.press(begin)
    stopped = bench.read(name).value
    bench.wait(2.0)
    assert bench.read(name).value == stopped
    assert bench.text(name) == "00:02"
    bench.press(begin)
    bench.wait(60.0)
    assert bench.text(name) == "01:02"
    bench.press(reset)
    assert bench.read(name).value == 0.0
    bench.wait(1.0)
    assert bench.read(name).value == 0.0


@pytest.mark.parametrize(
    ("kind", "knob", "minutes"), [("ultrasonic_bath", "minutes", 5), ("autoclave", "time", 6)]
)
def test_a_knob_with_a_timer_counts_what_it_is_set_to(kind, knob, minutes):
    bench = Bench(kind)
    dial = getattr(bench.piece, knob)
    bench.put(dial, minutes / {"ultrasonic_bath": 30, "autoclave": 60}[kind])
    bench.wait(0.1)
    bench.wait(10.0)
    left = bench.read(f"{kind}_left").value
    assert left == pytest.approx(60 * minutes - 10.0, abs=0.2)
    assert bench.text(f"{kind}_left") == f"{minutes - 1:02d}:50"
    bench.wait(left + 0.1)
    assert bench.read(f"{kind}_left").value == 0.0


def test_a_thermal_cycler_runs_its_program_only_with_its_lid_shut():
    bench = Bench("thermal_cycler")
    begin, end = bench.piece.keys
    bench.put(bench.piece.lid, 1.0)
    bench.press(begin)
    assert bench.read("thermal_cycler_time").value == 0.0
    bench.put(bench.piece.lid, 0.0)
    bench.press(begin)
    bench.wait(5.0)
    assert bench.read("thermal_cycler_time").value == pytest.approx(5400.0 - 5.3, abs=0.2)
    bench.press(end)
    assert bench.read("thermal_cycler_time").value == 0.0
