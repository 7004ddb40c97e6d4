"""What turns reaches its set speed along its ramp, reads it, shows it, and stops."""

import math

import mujoco
import numpy as np
import pytest

from instrument_bench import Bench
from labutopia_lerobot.labware.glass.catalogue import ware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.parts.drive import FASTEST, RPM
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world.model import VISUAL_GROUP

RAMPS = {
    "centrifuge": (4000, 200),
    "clinical_centrifuge": (6000, 300),
    "mini_centrifuge": (6000, 2000),
    "orbital_shaker": (300, 30),
    "overhead_stirrer": (2000, 250),
    "peristaltic_pump": (300, 300),
    "rocking_shaker": (60, 20),
    "rotary_evaporator": (280, 56),
    "stirring_hot_plate": (1500, 250),
    "transfer_pump": (300, 300),
    "tube_roller": (80, 40),
    "viscometer": (200, 100),
    "vortex_mixer": (3000, 3000),
}
"""Highest speed [rpm] and ramp [rpm/s], as docs/drives.md has them."""

driven = pytest.mark.parametrize("kind", RAMPS)


def start(bench: Bench, share: float = 1.0) -> float:
    """Set the speed, switch on, and return the set speed [rpm]."""
    piece = bench.piece
    if hasattr(piece, "speed"):
        bench.put(piece.speed, share)
    if hasattr(piece, "power"):
        bench.put(piece.power, 1.0)
    if hasattr(piece, "timer"):
        bench.put(piece.time, 1.0)
        bench.press(piece.start)
    return RAMPS[bench.piece.name][0] * (share if hasattr(piece, "speed") else 1.0)


@driven
def test_it_reaches_the_set_speed_along_its_ramp_reads_it_and_stops(kind):
    bench = Bench(kind)
    _, ramp = RAMPS[kind]
    assert bench.read(f"{kind}_rpm").value == 0.0
    wanted = start(bench, 0.5)
    before = bench.read(f"{kind}_rpm").value
    span = 0.5 * (wanted - before) / ramp
    bench.wait(span)
    assert bench.read(f"{kind}_rpm").value == pytest.approx(before + ramp * span, abs=0.08 * wanted)
    assert not bench.read(f"{kind}_rpm").settled
    bench.wait(span + 2.2)
    reading = bench.read(f"{kind}_rpm")
    assert reading.unit == "rpm"
    assert reading.settled
    assert reading.value == pytest.approx(wanted, rel=0.02)
    assert bench.text(f"{kind}_rpm") == reading.text
    stop(bench)
    bench.wait(wanted / ramp + 1.5)
    assert bench.read(f"{kind}_rpm").value == pytest.approx(0.0, abs=0.1)


def stop(bench: Bench) -> None:
    if hasattr(bench.piece, "timer"):
        bench.press(bench.piece.stop)
    elif hasattr(bench.piece, "power"):
        bench.put(bench.piece.power, 0.0)
    else:
        bench.put(bench.piece.speed, 0.0)


@driven
def test_what_is_seen_of_it_turns_as_fast_as_the_page_says(kind):
    bench = Bench(kind)
    start(bench)
    drive = bench.piece.drive
    bench.wait(RAMPS[kind][0] / RAMPS[kind][1] + 2.0)
    seen = min(RAMPS[kind][0], drive.seen)
    for motor in drive.motors if kind != "rocking_shaker" else ():
        before = bench.data.joint(motor.joint).qpos[0]
        bench.wait(2.0)
        turned = abs(bench.data.joint(motor.joint).qpos[0] - before)
        assert turned / 2.0 == pytest.approx(RPM * seen, rel=0.02)
    assert seen <= FASTEST


def test_a_platform_goes_round_its_orbit_without_turning():
    bench = Bench("orbital_shaker")
    start(bench)
    bench.wait(12.0)
    body, places = bench.data.body("orbital_shaker_platform"), []
    for _ in range(60):
        bench.wait(1 / 30)
        places.append(body.xpos.copy())
        assert body.xmat.reshape(3, 3) == pytest.approx(np.eye(3), abs=0.01)
    circle = np.array(places)[:, :2] - (0.030, 0.0)
    assert np.linalg.norm(circle, axis=1) == pytest.approx(0.010, abs=2e-4)


def test_a_rocking_platform_goes_to_and_fro_as_often_as_it_says():
    bench = Bench("rocking_shaker")
    start(bench, 0.5)
    bench.wait(4.0)
    tilts = []
    for _ in range(300):
        bench.wait(1 / 30)
        tilts.append(bench.data.joint(bench.piece.platform.joint).qpos[0])
    swing = np.array(tilts) - math.radians(10.0)
    assert np.ptp(swing) == pytest.approx(math.radians(20.0), rel=0.03)
    rises = ((swing[:-1] < 0) & (swing[1:] >= 0)).sum()
    assert rises == 5  # in 10 s at 30 rpm


def test_a_motor_that_is_held_reads_slower():
    bench = Bench("tube_roller")
    start(bench)
    bench.wait(4.0)
    roller = bench.data.joint(bench.piece.rollers[0].joint)
    roller.qfrc_applied[:] = -1.0
    bench.wait(0.5)
    assert not bench.read("tube_roller_rpm").settled
    roller.qfrc_applied[:] = 0.0
    bench.wait(2.0)
    assert bench.read("tube_roller_rpm").value == pytest.approx(80.0, rel=0.02)


def test_the_display_shows_what_is_set_while_the_knob_moves_and_then_the_speed():
    bench = Bench("stirring_hot_plate")
    bench.put(bench.piece.speed, 0.4)
    bench.wait(1 / 30)
    assert bench.text("stirring_hot_plate_rpm") == "set 600 rpm"
    bench.wait(2.1)
    assert bench.text("stirring_hot_plate_rpm") == bench.read("stirring_hot_plate_rpm").text


def test_a_syringe_pump_gives_what_its_rate_says_until_it_is_stopped():
    bench = Bench("syringe_pump")
    bench.put(bench.piece.rate, 1.0)
    bench.press(bench.piece.start)
    bench.wait(5.0)
    before = bench.data.joint(bench.piece.carriage.joint).qpos[0]
    bench.wait(10.0)
    moved = bench.data.joint(bench.piece.carriage.joint).qpos[0] - before
    assert moved == pytest.approx(10.0 * 60.0 / 3600.0 / 50.0 * 0.100, rel=0.02)
    assert bench.read("syringe_pump_rate_now").value == pytest.approx(60.0, rel=0.05)
    bench.press(bench.piece.stop)
    bench.wait(3.0)
    assert bench.read("syringe_pump_rate_now").value == pytest.approx(0.0, abs=0.5)


def test_a_peristaltic_pump_gives_its_displacement_with_every_turn():
    bench = Bench("peristaltic_pump")
    start(bench)
    bench.wait(4.0)
    assert bench.read("peristaltic_pump_flow").value == pytest.approx(300 * 2.0, rel=0.02)


def test_a_vacuum_falls_exponentially_to_what_is_set_and_air_comes_back():
    bench = Bench("vacuum_pump")
    assert bench.read("vacuum_pump_pressure").value == 1013.0
    bench.put(bench.piece.regulator, 1.0)
    bench.put(bench.piece.power, 1.0)
    bench.wait(1.0)
    one = bench.read("vacuum_pump_pressure").value
    bench.wait(2.0)
    two = bench.read("vacuum_pump_pressure").value
    assert (two - 10.0) / (one - 10.0) == pytest.approx(math.exp(-1.0), rel=1e-6)
    bench.wait(20.0)
    assert bench.read("vacuum_pump_pressure").value == pytest.approx(10.0, abs=1.0)
    assert bench.read("vacuum_pump_pressure").settled
    bench.put(bench.piece.power, 0.0)
    bench.wait(60.0)
    share = (1013 - bench.read("vacuum_pump_pressure").value) / 1003
    assert share == pytest.approx(math.exp(-1.0), rel=0.02)


@pytest.mark.parametrize(("kind", "speed"), [("fume_hood", 0.50), ("laminar_flow_bench", 0.45)])
def test_a_fan_moves_the_air_as_a_lag_of_three_seconds(kind, speed):
    bench = Bench(kind)
    fan = bench.piece.fan
    switched = bench.piece.buttons
    if switched:
        bench.press(fan)
    else:
        bench.put(fan, 1.0)
    early = bench.read(f"{kind}_air").value
    bench.wait(3.0)
    later = bench.read(f"{kind}_air").value
    assert (speed - later) / (speed - early) == pytest.approx(math.exp(-1.0), rel=1e-6)
    bench.wait(15.0)
    assert bench.read(f"{kind}_air").value == pytest.approx(speed, rel=0.01)


def test_its_state_goes_back_bit_for_bit():
    shaker = instrument("orbital_shaker", "shaker")
    simulation = Simulation(compile_scene([shaker], PANDA, LABORATORY, DOOR_VIEW))
    simulation.reset({shaker: Placement(0.5, 0.0, 0.0)})
    knob = simulation.data.joint(shaker.speed.joint)
    knob.qpos[0] = 0.5 * shaker.speed.widest

    def play() -> bytes:
        for _ in range(30):
            simulation.step(simulation.command)
        return simulation.state().tobytes()

    play()
    kept = simulation.state()
    once = play()
    simulation.restore(kept)
    assert play() == once
    assert simulation.apparatus.reading("shaker_rpm").value > 30.0


def test_motors_come_after_the_robot_and_the_robot_stands_still():
    roller = instrument("tube_roller", "roller")
    model = compile_scene([roller], PANDA, LABORATORY, DOOR_VIEW).model
    names = [model.actuator(number).name for number in range(model.nu)]
    assert set(names[: len(PANDA.names)]) == set(PANDA.names)
    assert names[len(PANDA.names) :] == [roller.motor.name for roller in roller.rollers]
    assert (model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT)[len(PANDA.names) :].all()


def spinning(simulation: Simulation, about: np.ndarray) -> float:
    """Return the angular speed of the liquid about an upright axis, by angular momentum [rad/s]."""
    assert simulation.liquid is not None
    off = simulation.liquid.positions - about
    moving = simulation.liquid.velocities
    momentum = off[:, 0] * moving[:, 1] - off[:, 1] * moving[:, 0]
    return float(momentum.sum() / (off[:, :2] ** 2).sum())


def water_on(piece, at, vessel, ml: float, *more) -> Simulation:
    """Return an instrument with a vessel of water on a place of it, and things in that."""
    scene = compile_scene(
        [piece, vessel, *more], PANDA, LABORATORY, DOOR_VIEW, {vessel: Filling(ml=ml)}
    )
    simulation = Simulation(scene)
    layout = {piece: Placement(0.3, 0.3, 0.0)}
    aside = {thing: Placement(0.9, -0.3 + 0.2 * n, 0.0) for n, thing in enumerate((vessel, *more))}
    simulation.reset({**layout, **aside})
    x, y, z = simulation.data.site(at).xpos
    floor = z - LABORATORY.bench.height
    layout |= {vessel: Placement(x, y, 0.0, height=floor + 0.0005)}
    layout |= {thing: Placement(x, y, 0.0, height=floor + 0.006) for thing in more}
    simulation.reset(layout)
    simulation.fill(np.random.default_rng(0))
    return simulation


def play(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def test_a_bar_on_a_stirrer_turns_the_water_around_it():
    plate = instrument("stirring_hot_plate", "plate")
    bar = ware("stirring_bar", "25 x 8 mm", "bar")
    beaker = ware("beaker_low", "250 ml", "beaker")
    simulation = water_on(plate, plate.plate.name, beaker, 150.0, bar)
    middle = simulation.data.site(plate.plate.name).xpos.copy()
    assert abs(spinning(simulation, middle)) < 0.2
    simulation.data.joint(plate.speed.joint).qpos[0] = 0.2 * plate.speed.widest  # 300 rpm
    play(simulation, 4.0)
    body = simulation.data.body("bar")
    assert np.hypot(*(body.xpos - middle)[:2]) < 0.01
    turning = []
    for _ in range(30):
        play(simulation, 1 / 30)
        turning.append(spinning(simulation, middle))
    water = float(np.mean(turning))
    # A Rankine vortex of a quarter of its speed in a beaker of 70 mm: of a rigid body's, by angular
    # momentum, 2 (b/R)^2 less (b/R)^4, b the bar's half length, R the beaker's radius.
    part = (0.0125 / 0.033) ** 2
    assert 0.3 < water / (0.25 * 300 * RPM * (2 * part - part**2)) < 1.5
    simulation.data.joint(plate.speed.joint).qpos[0] = 0.0
    play(simulation, 6.0)
    assert spinning(simulation, middle) < 0.3 * water


def test_what_is_seen_of_a_bar_turns_and_the_physics_do_not_know():
    plate, bar = instrument("stirring_hot_plate", "plate"), ware("stirring_bar", "25 x 8 mm", "bar")
    simulation = Simulation(compile_scene([plate, bar], PANDA, LABORATORY, DOOR_VIEW))
    simulation.reset({plate: Placement(0.3, 0.3, 0.0), bar: Placement(0.9, -0.3, 0.0)})
    x, y, z = simulation.data.site(plate.plate.name).xpos
    layout = Placement(x, y, 0.0, height=z - LABORATORY.bench.height + 0.001)
    simulation.reset({plate: Placement(0.3, 0.3, 0.0), bar: layout})
    shown = (simulation.scene.model.geom_group == VISUAL_GROUP) & (
        simulation.scene.model.geom_bodyid == simulation.data.body("bar").id
    )

    def heading() -> float:
        """Return which way the bar seems to lie, as a double angle [rad]: both ends look alike."""
        kept = simulation.state()
        simulation.apparatus.show()
        assert (simulation.state() == kept).all()
        turn = simulation.data.geom_xmat[shown][0].reshape(3, 3) @ start.T
        return 2 * math.atan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1])

    start = simulation.data.geom_xmat[shown][0].reshape(3, 3).copy()
    play(simulation, 1.0)
    assert heading() == pytest.approx(0.0, abs=0.02)
    simulation.data.joint(plate.speed.joint).qpos[0] = 0.06 * plate.speed.widest  # 90 rpm
    play(simulation, 3.0)
    before, angles = heading(), []
    for _ in range(10):
        play(simulation, 1 / 30)
        now = heading()
        angles.append((now - before) % (2 * math.pi) / 2)
        before = now
    assert np.mean(angles) == pytest.approx(90 * RPM / 30, rel=0.05)


def test_without_a_bar_nothing_turns():
    plate = instrument("stirring_hot_plate", "plate")
    simulation = water_on(plate, plate.plate.name, ware("beaker_low", "250 ml", "beaker"), 150.0)
    middle = simulation.data.site(plate.plate.name).xpos.copy()
    simulation.data.joint(plate.speed.joint).qpos[0] = 0.2 * plate.speed.widest
    play(simulation, 3.0)
    assert abs(spinning(simulation, middle)) < 0.3


def test_an_orbital_shaker_takes_water_in_a_flask_round():
    shaker = instrument("orbital_shaker", "shaker")
    flask = ware("erlenmeyer_narrow", "250 ml", "flask")
    simulation = water_on(shaker, shaker.mat.name, flask, 100.0)
    simulation.data.joint(shaker.speed.joint).qpos[0] = 0.4 * shaker.speed.widest  # 120 rpm
    play(simulation, 6.0)
    liquid, account = simulation.liquid, simulation.account
    assert liquid is not None
    assert account is not None
    speed = RPM * 120 * 0.010  # of the platform
    assert 0.5 * speed < np.linalg.norm(liquid.velocities, axis=1).mean() < 3.0 * speed
    assert account.inside["flask"] == pytest.approx(100e-6, rel=0.01)
