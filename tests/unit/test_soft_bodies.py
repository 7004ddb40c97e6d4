"""Soft bodies against geometry, beam theory and common sense: they give way, come back and rest."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import mujoco
import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.soft.elastic_shell import enclosed_volume
from labutopia_lerobot.labware.soft.silicone_tube import SILICONE, SiliconeTube
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.squeeze import Squeeze
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD

BOTTLE = WashBottle("bottle")
TUBE = SiliconeTube("tube")
EDGE = float(np.linalg.norm(TUBE.path[1] - TUBE.path[0]))


def squeezed(env: LabEnv) -> float:
    """Return what has left the bottle [ml]."""
    return env.workcell.world.reading(BOTTLE.squeezed).value


@pytest.fixture(scope="module")
def env() -> LabEnv:
    """The task with the bottle."""
    return begun("level1/squeeze")


@pytest.fixture
def lying() -> Simulation:
    """A tube on the bench, away from the robot."""
    simulation = Simulation(compile_scene([TUBE], PANDA, LABORATORY, VESSEL_VIEW))
    simulation.reset({TUBE: Placement(0.3, -0.3, 0.5)})
    return simulation


def play(env: LabEnv, until: str, seed: int = 5):
    """Play the expert until a phase begins; return it."""
    env.reset(seed=seed)
    expert = env.expert()
    expert.start()
    while expert.label != until:
        env.step(expert.act())
    return expert


def volume(env: LabEnv) -> float:
    """Volume inside the bottle of the scene now [m^3]; its wall is the only flex."""
    return enclosed_volume(env.workcell.simulation.data.flexvert_xpos, BOTTLE.shell.triangles)


def speeds(simulation: Simulation) -> np.ndarray:
    """Speeds of all vertices of the only flex, shape (3 n,), m/s."""
    return simulation.data.qvel[9:]


def test_a_resting_bottle_encloses_the_volume_of_its_frustums():
    exact = sum(
        np.pi / 3 * (top - low) * (r * r + r * s + s * s)
        for (r, low), (s, top) in pairwise(BOTTLE.shell.rings)
    )
    assert BOTTLE.shell.volume == pytest.approx(exact, rel=0.01)


def test_the_divergence_theorem_gives_a_cube_its_volume_wherever_it_is():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    assert enclosed_volume(2.0 * corners + 5.0, faces) == pytest.approx(8.0)


def test_the_wall_is_watertight():
    edges = [tuple(np.roll(face, -k)[:2]) for face in BOTTLE.shell.triangles for k in range(3)]
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)


def test_a_bottle_under_its_own_weight_keeps_its_volume(env):
    env.reset(seed=0)
    assert volume(env) == pytest.approx(BOTTLE.shell.volume, rel=1e-3)


@pytest.mark.parametrize(
    "seed", [5, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (6, 7))]
)
def test_a_squeezed_bottle_caves_in_and_comes_back(env, seed):
    expert = play(env, "squeeze/hold", seed)
    assert BOTTLE.shell.volume - volume(env) > 20e-6
    assert env.workcell.world.touching(LEFT_PAD, BOTTLE.name)
    assert env.workcell.world.touching(RIGHT_PAD, BOTTLE.name)
    while expert.label != "squeeze/done":
        env.step(expert.act())
    assert volume(env) == pytest.approx(BOTTLE.shell.volume, rel=1e-3)


def winding_number(point: np.ndarray, vertices: np.ndarray, triangles: np.ndarray) -> float:
    """How often a surface encloses a point: its solid angle over 4 pi (Van Oosterom, Strackee)."""
    a, b, c = np.moveaxis((vertices - point)[triangles], 1, 0)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    dots = [np.einsum("ij,ij->i", *pair) for pair in ((a, b), (b, c), (c, a))]
    angles = np.arctan2(volumes, la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb)
    return float(angles.sum() / (2 * np.pi))


@dataclass(frozen=True)
class Anywhere(Squeeze):
    """As hard a squeeze as the hand can, at another height [m] or off the axis [m]."""

    higher: float = 0.0
    further: float = 0.0

    def _grasp(self, world):
        return super()._grasp(world).moved(z=self.higher).advanced(self.further)


@pytest.mark.parametrize(
    ("higher", "further"),
    [
        (0.0, 0.0),
        (0.028, 0.0),
        *(
            pytest.param(*grasp, marks=pytest.mark.slow)
            for grasp in [(-0.015, 0.0), (0.015, 0.0), (0.0, -0.015)]
        ),
    ],
)
def test_pads_never_go_through_the_wall(env, higher, further):
    env.reset(seed=5)
    hard = Anywhere(BOTTLE, amount_ml=190.0, strokes=1, higher=higher, further=further)
    expert = Expert((hard,), env.workcell.world, env.workcell.motion)
    expert.start()
    data = env.workcell.simulation.data
    while expert.label != "anywhere/release":
        env.step(expert.act())
        for pad in ("left_pad_collision", "right_pad_collision"):
            middle = data.geom(pad).xpos
            inside = winding_number(middle, data.flexvert_xpos, BOTTLE.shell.triangles)
            assert abs(inside) < 0.5
    assert BOTTLE.shell.volume - volume(env) > 15e-6


def test_a_shaken_wall_loses_its_energy_and_never_gains_any(env):
    env.reset(seed=0)
    simulation = env.workcell.simulation
    wall = slice(9, 9 + 3 * (simulation.scene.model.nflexvert - 2 * 14 - 2))
    rng = np.random.default_rng(0)
    simulation.data.qvel[wall] = rng.normal(0.0, 0.5, wall.stop - wall.start)
    mujoco.mj_step1(simulation.scene.model, simulation.data)
    energies = [np.square(simulation.data.qvel[wall]).sum()]
    for _ in range(60):
        simulation.step(simulation.command)
        energies.append(np.square(simulation.data.qvel[wall]).sum())
    assert max(energies[1:]) < energies[0]
    assert energies[-1] < 1e-6 * energies[0]


@pytest.mark.slow
def test_a_bottle_left_alone_for_a_minute_does_not_stir(env):
    env.reset(seed=0)
    simulation = env.workcell.simulation
    before = simulation.data.flexvert_xpos.copy()
    for _ in range(30 * 60):
        simulation.step(simulation.command)
    assert np.abs(simulation.data.flexvert_xpos - before).max() < 1e-5
    assert squeezed(env) == 0.0
    assert not simulation.diverged


def test_a_restored_state_goes_on_bit_for_bit_in_the_middle_of_a_squeeze(env):
    expert = play(env, "squeeze/squeeze")
    for _ in range(40):
        env.step(expert.act())
    saved, command = env.workcell.simulation.state(), env.workcell.simulation.command.copy()
    other = begun("level1/squeeze")
    other.reset(seed=5)
    other.workcell.simulation.restore(saved)
    assert other.workcell.simulation.command.tobytes() == command.tobytes()
    narrower = command - np.array([0.0] * 7 + [0.01])
    for _ in range(30):
        for simulation in (env.workcell.simulation, other.workcell.simulation):
            simulation.step(narrower)
        assert (
            other.workcell.simulation.state().tobytes() == env.workcell.simulation.state().tobytes()
        )
        assert squeezed(other) == squeezed(env) > 0.0


def test_each_further_stroke_gives_more_and_nothing_returns(env):
    expert = play(env, "squeeze/release")
    given = squeezed(env)
    while expert.label != "squeeze/done":
        env.step(expert.act())
        assert squeezed(env) == given
    simulation = env.workcell.simulation
    data, apparatus = simulation.data, simulation.apparatus
    squeezing = apparatus.processes[BOTTLE.squeezed]
    expert = play(env, "squeeze/hold")
    narrow, full = data.flexvert_xpos.copy(), volume(env)
    env.reset(seed=5)
    at_rest = data.flexvert_xpos.copy()
    fall = volume(env) - full
    for stroke in (1, 2, 3):
        for shape in (narrow, at_rest):
            data.flexvert_xpos[:] = shape
            squeezing.step(apparatus)
        left = stroke * (fall - BOTTLE.spout_volume)
        assert squeezed(env) == pytest.approx(1e6 * left, rel=1e-6)


def test_a_bottle_gives_no_more_than_it_holds(env):
    env.reset(seed=5)
    simulation = env.workcell.simulation
    data, apparatus = simulation.data, simulation.apparatus
    at_rest = data.flexvert_xpos.copy()
    for _ in range(20):
        for size in (0.95, 1.0):  # a seventh less volume, about 45 ml
            data.flexvert_xpos[:] = at_rest[0] + size * (at_rest - at_rest[0])
            apparatus.processes[BOTTLE.squeezed].step(apparatus)
    assert squeezed(env) == 1e6 * BOTTLE.contents


def test_a_tube_comes_to_rest_on_the_bench(lying):
    for _ in range(60):
        lying.step(lying.command)
    assert np.abs(speeds(lying)).max() < 1e-3
    height = lying.data.flexvert_xpos[:, 2] - LABORATORY.bench.height
    assert 0.0035 < height.min() < 0.0041  # its radius, 4 mm


def test_a_tube_that_is_lifted_keeps_its_length_falls_and_rests(lying):
    data = lying.data
    edges = np.linalg.norm(np.diff(TUBE.path, axis=0), axis=1)
    end = lying.scene.model.body("tube_rod_18").id
    data.xfrc_applied[end, 2] = 0.25  # a quarter of a newton, twice the tube's weight
    for _ in range(60):
        lying.step(lying.command)
    assert data.flexvert_xpos[18, 2] > LABORATORY.bench.height + 0.10
    now = np.linalg.norm(np.diff(data.flexvert_xpos, axis=0), axis=1)
    assert np.abs(now - edges).max() < 0.01 * edges.max()
    data.xfrc_applied[:] = 0.0
    for _ in range(120):
        lying.step(lying.command)
    assert np.abs(speeds(lying)).max() < 1e-3
    assert data.flexvert_xpos[18, 2] < LABORATORY.bench.height + 0.005


@dataclass(frozen=True)
class Beam(SiliconeTube):
    """A straight piece of tube, level and in the air, fixed at one end."""

    @cached_property
    def path(self):
        return np.array([(EDGE * k, 0.0, 0.3) for k in range(14)])


def test_a_level_tube_sags_as_a_beam():
    beam, weak = Beam("beam"), 0.05  # a twentieth of gravity: small deflections
    spec = mujoco.MjSpec()
    beam.add_to(spec, spec.worldbody)
    spec.option.timestep = 1 / 300
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    spec.option.gravity = (0.0, 0.0, -9.81 * weak)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 3000)
    sag = 0.3 - data.flexvert_xpos[-1, 2]
    # Twelve edges are free; the joint at the clamp bends over half an edge on its other side too.
    length, outer, bore = 12.5 * EDGE, 0.004, 0.0025
    inertia = np.pi / 4 * (outer**4 - bore**4)
    load = SILICONE.density * np.pi * (outer**2 - bore**2) * 9.81 * weak  # per length [N/m]
    # Uniform load on a cantilever: w L^4 / (8 E I) (Gere and Timoshenko, table of deflections).
    assert sag == pytest.approx(load * length**4 / (8 * SILICONE.young * inertia), rel=0.05)
