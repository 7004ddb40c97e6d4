"""Taps let water through, by how far they are open: it is read, counted, seen, and fills."""

import math

import numpy as np
import pytest

from heat_bench import alone, celsius, turn, warm_up
from instrument_bench import Bench
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

SINK = instrument("laboratory_sink", "it")
BEAKER = glassware("beaker_low", "1000 ml", "beaker")
PARTICLES, ML = 60, 60.0


@pytest.mark.parametrize(
    ("kind", "part", "flow", "full"),
    [
        ("laboratory_sink", "water", "flow", 12.0),
        ("eyewash", "lever", "flow", 6.0),
        ("safety_shower", "pull", "flow", 60.0),
        ("safety_shower", "lever", "eyewash_flow", 6.0),
        ("fume_hood", "water", "flow", 6.0),
        ("fume_hood", "gas", "gas_flow", 6.0),
    ],
)
def test_a_tap_lets_through_what_its_opening_and_the_rest_of_its_line_do(kind, part, flow, full):
    bench = Bench(kind)
    tap = next(m for m in bench.piece.mechanisms if m.name == f"{kind}_{part}")
    seen = []
    for opening in (0.0, 0.09, 0.3, 0.6, 1.0):
        bench.put(tap, opening)
        seen.append(bench.read(f"{kind}_{flow}").value)
    # Half of the pressure falls in the open tap, as the square of the flow over its area.
    areas = [(opening - 0.1) / 0.9 for opening in (0.3, 0.6, 1.0)]
    expected = [math.sqrt(1.0 / (0.5 / area**2 + 0.5)) * full for area in areas]
    assert seen == pytest.approx([0.0, 0.0, *expected])


def test_a_meter_counts_what_has_been_drawn_since_the_start():
    bench = Bench("laboratory_sink")
    bench.put(bench.piece.water, 1.0)
    bench.wait(3.0)
    assert bench.read("laboratory_sink_drawn").value == pytest.approx(12.0 * 3.0 / 60.0, rel=0.02)
    bench.put(bench.piece.water, 0.0)
    drawn = bench.read("laboratory_sink_drawn").value
    bench.wait(1.0)
    assert bench.read("laboratory_sink_drawn").value == drawn
    assert bench.read("laboratory_sink_drawn").unit == "l"


def stream(bench: Bench, name: str) -> list[tuple[np.ndarray, float]]:
    """Return where the visible lengths of a stream are, and their radii [m]."""
    bench.apparatus.show()
    lengths = (bench.model.geom(g) for g in range(bench.model.ngeom))
    wide = np.linalg.norm(bench.data.geom_xmat.reshape(-1, 3, 3)[:, :, 0], axis=1)
    return [
        (bench.data.geom_xpos[geom.id].copy(), float(geom.size[0] * wide[geom.id]))
        for geom in lengths
        if geom.name.startswith(name) and geom.rgba[3] > 0.0
    ]


def test_a_stream_falls_into_the_basin_and_grows_thin_as_it_gets_faster():
    bench = Bench("laboratory_sink")
    assert not stream(bench, "laboratory_sink_stream")
    bench.put(bench.piece.water, 0.5)
    seen = stream(bench, "laboratory_sink_stream")
    outlet = bench.apparatus.site(bench.piece.spout).position_w
    flow = bench.read("laboratory_sink_flow").value / 60e3
    leaves = flow / (math.pi * 0.006**2)
    for place, radius in seen[1:-1]:
        speed = math.sqrt(leaves**2 + 2 * 9.81 * (outlet[2] - place[2]))  # Torricelli
        assert math.pi * radius**2 * speed == pytest.approx(flow, rel=0.05)
    assert seen[-1][0][2] > 0.650  # the floor of the basin ends it
    bench.put(bench.piece.neck, 1.0)
    bench.wait(0.1)
    turned = stream(bench, "laboratory_sink_stream")
    assert np.linalg.norm(turned[0][0][:2] - seen[0][0][:2]) > 0.15
    bench.put(bench.piece.water, 0.0)
    assert not stream(bench, "laboratory_sink_stream")


def test_the_jets_of_an_eyewash_rise_as_high_as_the_standard_wants_and_fall_into_its_bowl():
    bench = Bench("eyewash")
    bench.put(bench.piece.lever, 1.0)
    seen = np.array([place for place, _ in stream(bench, "eyewash_stream")])
    assert 0.100 < seen[:, 2].max() - 0.176 < 0.300  # EN 15154-2
    assert np.abs(seen[seen[:, 2] < 0.110]).max() < 0.125


def test_the_streams_of_a_shower_spread_as_the_standard_wants():
    bench = Bench("safety_shower")
    bench.put(bench.piece.pull, 1.0)
    points = bench.piece.shower.path
    for n in range(7):
        site = bench.apparatus.site(f"safety_shower_hole_{n}")
        speed = 1e-3 / 7 / (math.pi * 0.0048**2)
        lasts = (-speed + math.sqrt(speed**2 + 2 * 9.81 * 0.7)) / 9.81  # 700 mm below the head
        lands = site.position_w + lasts * speed * site.z_axis
        assert np.hypot(lands[0] + 0.15, lands[1]) < 0.400  # EN 15154-1
        positions, _ = points(site.position_w, speed * site.z_axis)
        assert positions[-1, 2] == pytest.approx(2.105 - 2.1, abs=1e-3)


def at_a_sink(contents: dict) -> Simulation:
    """Return a beaker in the basin of a sink."""
    scene = compile_scene([SINK, BEAKER], PANDA, LABORATORY, DOOR_VIEW, contents, PARTICLES)
    simulation = Simulation(scene)
    floor = -LABORATORY.bench.height  # the sink stands on it
    simulation.reset(
        {
            SINK: Placement(1.5, 0.0, 0.0, height=floor),
            BEAKER: Placement(1.53, 0.0, 0.0, height=floor + 0.652),
        }
    )
    simulation.fill(np.random.default_rng(0))
    return simulation


def run(simulation: Simulation, opening: float, seconds: float) -> None:
    turn(simulation, SINK.water.joint, opening * SINK.water.widest)
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def test_what_a_task_fills_into_a_sink_runs_into_the_vessel_under_its_neck_and_then_no_more():
    simulation = at_a_sink({SINK: Filling(ml=ML)})
    particle = ML / PARTICLES
    run(simulation, 0.4, 0.4)
    drawn = 1e3 * celsius(simulation, "it_drawn")
    account = simulation.account
    assert account is not None
    left = 1e6 * account.inside["it"]
    assert ML - left == pytest.approx(drawn, abs=1.01 * particle)
    run(simulation, 0.0, 0.6)
    assert 1e6 * simulation.account.inside["beaker"] > 0.8 * drawn
    assert simulation.account.counts.sum() == PARTICLES
    run(simulation, 1.0, 0.3)
    assert celsius(simulation, "it_flow") == 0.0
    assert 1e3 * celsius(simulation, "it_drawn") == pytest.approx(ML, abs=2 * particle)
    assert simulation.account.inside["it"] == 0.0
    simulation.apparatus.show()
    assert simulation.scene.model.geom("it_stream_0_0").rgba[3] == 0.0  # liquid is drawn by itself


def test_it_goes_on_bit_for_bit_from_a_saved_state():
    simulation = at_a_sink({SINK: Filling(ml=ML)})
    run(simulation, 0.4, 0.2)
    saved = simulation.state()
    run(simulation, 0.4, 0.2)
    once = simulation.state()
    simulation.restore(saved)
    run(simulation, 0.4, 0.2)
    assert simulation.state().tobytes() == once.tobytes()


def test_a_tap_that_no_task_has_filled_fills_nothing():
    simulation = at_a_sink({BEAKER: Filling(ml=ML)})
    run(simulation, 1.0, 0.5)
    assert celsius(simulation, "it_drawn") > 0.05
    assert simulation.account is not None
    assert simulation.account.counts.sum() == PARTICLES
    simulation.apparatus.show()
    assert simulation.scene.model.geom("it_stream_0_0").rgba[3] > 0.0


def test_the_vacuum_of_a_fume_hood_falls_as_its_pump_has_it_and_the_air_comes_back():
    piece = instrument("fume_hood", "it")
    simulation = alone(piece)
    turn(simulation, piece.taps[2].joint, piece.taps[2].widest)
    warm_up(simulation, 5.0)
    evacuated = 100.0 + (1013.0 - 100.0) * math.exp(-5.0 / (1.0 / 0.3))
    assert celsius(simulation, "it_pressure") == pytest.approx(evacuated, rel=0.02)
    turn(simulation, piece.taps[2].joint, 0.0)
    warm_up(simulation, 60.0)
    back = 1013.0 - (1013.0 - evacuated) * math.exp(-1.0)
    assert celsius(simulation, "it_pressure") == pytest.approx(back, rel=0.02)
