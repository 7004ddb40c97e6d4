"""A vortex mixer runs while its cup is pressed down, or its switch is on; knobs begin turned."""

import mujoco
import pytest

from instrument_bench import Bench
from labutopia_lerobot.labware.instruments.mixing.vortex_mixer import VortexMixer
from labutopia_lerobot.labware.instruments.separating.centrifuge import Centrifuge
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation


@pytest.fixture
def bench() -> Bench:
    mixer = Bench("vortex_mixer")
    mixer.put(mixer.piece.speed, 0.5)
    return mixer


def press(bench: Bench, newton: float, seconds: float) -> None:
    """Push the cup down."""
    slide = bench.data.joint(bench.piece.sprung_cup.joint)
    slide.qfrc_applied[:] = newton
    bench.wait(seconds)
    slide.qfrc_applied[:] = 0.0


def test_it_runs_while_its_cup_is_pressed_and_stops_when_it_is_let_go(bench):
    press(bench, 6.0, 2.0)
    assert bench.read("vortex_mixer_rpm").value == pytest.approx(1500.0, rel=0.01)
    bench.wait(1.0)
    assert bench.read("vortex_mixer_rpm").value < 1.0


def test_a_tube_that_only_stands_in_the_cup_does_not_run_it(bench):
    press(bench, 0.4, 2.0)
    assert bench.read("vortex_mixer_rpm").value < 1.0


def test_with_its_switch_on_it_runs_by_itself(bench):
    bench.put(bench.piece.power, 1.0)
    bench.wait(2.0)
    assert bench.read("vortex_mixer_rpm").value == pytest.approx(1500.0, rel=0.01)


def test_a_pressed_cup_goes_round_as_one_that_is_not():
    bench = Bench("vortex_mixer")
    bench.put(bench.piece.speed, 0.1)
    press(bench, 6.0, 1.0)
    bench.data.joint(bench.piece.sprung_cup.joint).qfrc_applied[:] = 6.0
    cup, axis = bench.data.body("vortex_mixer_cup"), 0.017
    for _ in range(30):
        bench.wait(1 / 30)
        x, y, _ = cup.xpos
        assert ((x - axis) ** 2 + y**2) ** 0.5 == pytest.approx(0.0025, abs=1e-4)
        assert cup.xmat[0] == pytest.approx(1.0, abs=0.01)


def test_what_a_knob_is_set_to_at_the_start_is_read_and_seen():
    mixer = VortexMixer("mixer", set_to=1500.0)
    centrifuge = Centrifuge("centrifuge", set_to=1000.0, minutes=10.0, lid_open=0.5)
    simulation = Simulation(compile_scene([mixer, centrifuge], PANDA, LABORATORY, DOOR_VIEW))
    simulation.reset({mixer: Placement(0.3, -0.5, 0.0), centrifuge: Placement(0.5, 0.3, 0.0)})
    read = simulation.apparatus.reading
    assert read("mixer_speed").value == pytest.approx(1500.0)
    assert read("centrifuge_speed").value == pytest.approx(1000.0)
    assert read("centrifuge_time").value == pytest.approx(10.0)
    assert read("centrifuge_lid_shut").value == 0.0
    turned, built = simulation.data.site("mixer_speed"), mujoco.MjData(simulation.scene.model)
    built.qpos[:] = simulation.scene.model.qpos0
    built.joint("mixer_speed_hinge").qpos[:] = 0.0
    mujoco.mj_kinematics(simulation.scene.model, built)
    angle = (turned.xmat.reshape(3, 3).T @ built.site("mixer_speed").xmat.reshape(3, 3))[0, 0]
    assert angle == pytest.approx(-0.866, abs=0.01)  # the pointers are 150 degrees apart
    front = simulation.data.site("centrifuge_lid").xpos[2] - LABORATORY.bench.height
    assert front == pytest.approx(0.270 + 0.350 * 0.479, abs=0.002)
