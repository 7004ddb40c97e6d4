"""Liquid in an episode: what can be put into vessels, what is said of it, and what may go wrong."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from adversary import begun, begun_with
from labutopia_lerobot import kernel
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.glass_rod import GlassRod
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.substances.filling import (
    Filling,
    ImpossibleFillingError,
    require_fillable,
)
from labutopia_lerobot.substances.substance import DYES, SUBSTANCES, UnknownSubstanceError

PARTS = ("poured", "retained", "spilled", "clinging", "in_flight")


@dataclass(frozen=True)
class Colander:
    """A vessel whose wall has no thickness at half its height."""

    name: str

    @property
    def profile(self) -> Profile:
        return _Holed(((0.03, 0.0), (0.03, 0.05), (0.03, 0.1)), 0.002, 0.003)


class _Holed(Profile):
    def inner_radius(self, height: float) -> float:
        thickness = 0.0 if height == pytest.approx(0.05) else self.wall
        return self.outer_radius(height) - thickness


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/pour", particles=200)


@pytest.mark.parametrize("ml", [-1.0, 0.0, 1000.0, float("nan"), float("inf")])
def test_a_volume_that_a_vessel_cannot_hold_is_refused(ml):
    vessel = glassware("beaker", "250 ml", "beaker")
    with pytest.raises(ImpossibleFillingError, match=r"beaker cannot hold .* at most \d+ ml"):
        require_fillable({vessel: Filling(ml)}, {vessel: None})


def test_an_unknown_substance_is_refused_and_the_known_ones_are_listed():
    vessel = glassware("beaker", "250 ml", "beaker")
    with pytest.raises(UnknownSubstanceError, match=r"unobtainium.*water, .*, glycerol"):
        require_fillable({vessel: Filling(50, "unobtainium")}, {vessel: None})


@pytest.mark.parametrize("thing", [GlassRod("rod"), Colander("colander")])
def test_what_is_not_watertight_cannot_be_filled(thing):
    with pytest.raises(ImpossibleFillingError, match=f"{thing.name}.* is not watertight"):
        require_fillable({thing: Filling(10)}, {thing: None})


def test_a_vessel_that_is_not_in_the_task_cannot_be_filled():
    with pytest.raises(ImpossibleFillingError, match="flask is to be filled but not in the task"):
        require_fillable(
            {glassware("beaker", "250 ml", "flask"): Filling(10)},
            {glassware("beaker", "250 ml", "beaker"): None},
        )


def test_impossible_contents_are_refused_when_a_task_is_loaded(tmp_path):
    level = tmp_path / "level1"
    level.mkdir()
    (level / "flood.py").write_text(
        "from dataclasses import replace\n"
        "from labutopia_lerobot.substances.filling import Filling\n"
        "from labutopia_lerobot.tasks.level1.pour import pour\n"
        "def flood():\n"
        "    task = pour()\n"
        "    vessel = next(iter(task.start))\n"
        "    return replace(task, contents={vessel: Filling(5000)})\n"
    )
    with pytest.raises(ImpossibleFillingError, match="beaker cannot hold 5000 ml of water"):
        LabEnv(Setting("level1/flood", obs="state", tasks_dir=tmp_path))


def test_an_unknown_liquid_option_is_refused():
    with pytest.raises(
        UnknownOptionError, match=r"liquid=.maybe. is unknown\. Choose from: on, off"
    ):
        LabEnv(Setting("level1/pour", obs="state", liquid="maybe"))


def test_everything_is_accounted_for_at_every_step(env):
    _, info = env.reset(seed=2)
    expert = env.expert()
    expert.start()
    over, airborne, clung = False, 0.0, 0.0
    while not over:
        parts = [info[f"ml_{part}"] for part in PARTS]
        assert sum(parts) == pytest.approx(info["ml_total"], abs=1e-9)
        assert env.workcell.world.liquid.counts.sum() == 200
        airborne, clung = max(airborne, info["ml_in_flight"]), max(clung, info["ml_clinging"])
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert info["ml_total"] == 100
    assert airborne > 1
    assert clung > 0.5


def test_the_vessel_in_the_hand_is_full_and_at_rest_when_the_episode_begins(env):
    _, info = env.reset(seed=2)
    assert info["ml_retained"] == pytest.approx(100)
    assert info["ml_spilled"] == 0
    assert np.linalg.norm(env.workcell.simulation.liquid.velocities, axis=1).mean() < 0.03


def test_the_privileged_state_says_how_full_vessels_are(env):
    names = list(environment_state_names(env.workcell.task))
    observation, _ = env.reset(seed=2)
    vessel, target = env.workcell.task.start
    fill = names.index("beaker.fill")
    depth = vessel.profile.depth(100e-6)
    assert observation["environment_state"][fill] == pytest.approx(depth, rel=1e-5)
    assert observation["environment_state"][names.index("target_beaker.fill")] == 0
    assert target.profile.depth(0.0) == 0


def test_levels_are_left_out_of_the_privileged_state_where_they_are_hidden(env):
    options = {"obs": "state", "particles": env.setting.particles}
    hidden = LabEnv(Setting("level1/pour", hidden=("levels",), **options))
    shown, _ = env.reset(seed=2)
    without, _ = hidden.reset(seed=2)
    names = environment_state_names(env.workcell.task)
    kept = [index for index, name in enumerate(names) if not name.endswith(".fill")]
    assert 0 < len(kept) < len(names)
    assert np.array_equal(without["environment_state"], shown["environment_state"][kept])
    assert hidden.observation_space.contains(without)


def test_without_liquid_nothing_is_reported_of_it():
    env = LabEnv(Setting("level1/pour", obs="state", liquid="off"))
    _, info = env.reset(seed=2)
    assert not any(name.startswith("ml_") for name in info)
    assert not any(name.endswith(".fill") for name in environment_state_names(env.workcell.task))


def test_the_weight_of_the_contents_is_on_the_hand(env):
    env.reset(seed=2)
    force = env.workcell.simulation.data.body("beaker")
    pushed = env.workcell.simulation.data.xfrc_applied[force.id, 2]
    assert pushed == pytest.approx(-0.0997 * 9.81, rel=0.05)


@pytest.mark.parametrize("poison", [np.nan, 1e6])
def test_a_solver_that_diverges_ends_the_episode_and_reports_no_nonsense(env, poison):
    env.reset(seed=2)
    env.workcell.simulation.liquid.velocities[7] = poison
    observation, _, terminated, _, info = env.step(
        env.workcell.simulation.command.astype(np.float32)
    )
    assert terminated
    assert info["outcome"] == "diverged"
    for numbers in observation.values():
        assert np.isfinite(numbers).all()
    _, info = env.reset(seed=2)
    assert info["outcome"] == "running"


@pytest.mark.slow
def test_another_substance_weighs_and_flows_otherwise(monkeypatch):
    weights = {}
    for name in (next(iter(DYES)), "mercury", "diethyl ether"):
        task = canonical_task(Setting("level1/pour"))
        task = replace(task, contents={next(iter(task.start)): Filling(100, name)})
        env = begun_with("level1/pour", task, monkeypatch, particles=100)
        env.reset(seed=2)
        body = env.workcell.simulation.data.body("beaker").id
        weights[name] = -env.workcell.simulation.data.xfrc_applied[body, 2]
    for name, weight in weights.items():
        assert weight == pytest.approx(SUBSTANCES[name].density * 1e-4 * 9.81, rel=0.05)


def turning(env: LabEnv, vessel) -> float:
    """Mean angular velocity of the liquid about the vessel's axis [rad/s], counterclockwise."""
    liquid, pose = env.workcell.simulation.liquid, env.workcell.world.pose(vessel)
    arm = (liquid.positions - pose.position_w)[:, :2]
    velocity = liquid.velocities[:, :2]
    momentum = arm[:, 0] * velocity[:, 1] - arm[:, 1] * velocity[:, 0]
    return float(momentum.sum() / (arm**2).sum())


@pytest.mark.slow
def test_a_rod_that_stirs_takes_the_liquid_round_with_it():
    env = LabEnv(Setting("level1/stir", obs="state", particles=300))
    env.reset(seed=2)
    vessel = next(iter(env.workcell.task.contents))
    rest = turning(env, vessel)
    expert = env.expert()
    expert.start()
    while "retract" not in expert.label:
        env.step(expert.act())
    assert abs(rest) < 0.05
    assert turning(env, vessel) > 0.2


def test_a_shaken_vessel_makes_its_contents_slosh():
    env = LabEnv(Setting("level1/shake", obs="state", particles=300))
    env.reset(seed=2)
    expert = env.expert()
    expert.start()
    speeds = []
    for _ in range(150):
        env.step(expert.act())
        speeds.append(np.linalg.norm(env.workcell.simulation.liquid.velocities, axis=1).mean())
    assert speeds[0] < 0.03
    assert max(speeds) > 0.1


def test_the_half_minute_of_compiling_is_announced(monkeypatch, tmp_path, caplog):
    monkeypatch.setattr(kernel, "_compiled_kernels", lambda: tmp_path)
    kernel.announce_compiling.cache_clear()
    kernel.announce_compiling()
    assert "half a minute" in caplog.text
    caplog.clear()
    (tmp_path / "liquids").mkdir()
    (tmp_path / "liquids" / "advance.nbi").touch()
    kernel.announce_compiling.cache_clear()
    kernel.announce_compiling()
    assert not caplog.text
