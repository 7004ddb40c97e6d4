"""Adversarial cases of `level2/heat_to_temperature`, played in the real simulation."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.task import NeedsLiquidError
from labutopia_lerobot.world import World

TASK = "level2/heat_to_temperature"


@dataclass(frozen=True)
class Warmed:
    """Let the beaker and what it holds be as warm as the wanted temperature, or not quite.

    Attributes:
        env: Where it is.
        by: How much warmer than wanted [K].
        glass: How much warmer the glass is than that [K].
    """

    env: LabEnv
    by: float = 0.0
    glass: float = 0.0

    def phases(self, world: World) -> Iterator[Phase]:
        simulation = self.env.workcell.simulation
        wanted = int(self.env.workcell.task.instruction.split(" degrees")[0].split()[-1])
        liquid, apparatus = simulation.liquid, simulation.apparatus
        assert liquid is not None
        liquid.temperatures[:] = wanted + self.by + 273.15
        glass = apparatus.memory(apparatus.processes["beaker_temperature"])
        glass[0] = wanted + self.by + self.glass + 273.15
        return iter(())


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def test_without_liquid_it_is_refused():
    with pytest.raises(NeedsLiquidError, match="Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


def test_water_more_than_2_k_too_hot_is_overheated(env):
    press, *_ = env.workcell.task.skills
    assert play(env, Warmed(env, by=2.2), press)["outcome"] == "overheated"


def test_warm_water_that_stays_on_the_plate_is_no_success(env):
    press, *_ = env.workcell.task.skills
    info = play(env, press, Warmed(env))
    assert info["outcome"] == "running"


def test_who_grips_glass_of_80_degrees_is_burnt(env):
    press, _, pick, _ = env.workcell.task.skills
    env.reset(seed=5)
    info = play(env, press, Warmed(env, by=-15.0, glass=80.0), pick)
    assert info["outcome"] == "burnt"


@pytest.mark.slow
def test_water_that_was_not_heated_is_too_cold(env):
    press, _, pick, place = env.workcell.task.skills
    info = play(env, press, pick, place)
    assert info["substeps"]["retracted"] < np.inf
    assert info["substeps"]["warm"] == np.inf
    assert info["outcome"] == "running"


@pytest.mark.slow
def test_who_switches_the_plate_off_before_taking_the_beaker_off_may(env):
    press, _, pick, place = env.workcell.task.skills
    info = play(env, press, Warmed(env), press, pick, place)
    assert info["outcome"] == "success"


def test_the_display_of_the_hot_plate_shows_what_the_water_has(env):
    env.reset(seed=3)
    world = env.workcell.world
    drawn = env.workcell.info()["readings"]["heater_probe"]
    assert drawn == pytest.approx(world.reading("beaker_temperature").value, abs=0.06)
