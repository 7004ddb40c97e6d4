"""Adversarial cases of `level1/squeeze`, played in the real simulation: nearly is not enough."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from adversary import begun, begun_with, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.skills.squeeze import Squeeze
from labutopia_lerobot.substances.filling import Filling

GLASS = 6.4e10
"""Young's modulus of borosilicate glass [Pa] (Schott Duran data sheet: 64 kN/mm^2)."""


@pytest.fixture
def env() -> LabEnv:
    return begun("level1/squeeze")


def things(env: LabEnv):
    """Return the bottle and the beaker."""
    return tuple(env.workcell.task.start)


@dataclass(frozen=True)
class Linger(Squeeze):
    """A squeeze after which the open hand stays round the bottle."""

    def phases(self, world):
        for phase in super().phases(world):
            yield phase
            if phase.name == "release":
                yield replace(phase, name="linger", done=waited(60.0), timeout_s=61.0)


@dataclass(frozen=True)
class Clutch(Squeeze):
    """A squeeze that never lets go."""

    def phases(self, world):
        for phase in super().phases(world):
            yield phase
            if phase.name == "hold":
                yield replace(phase, name="clutch", done=waited(60.0), timeout_s=61.0)


@dataclass(frozen=True)
class Beside(Squeeze):
    """A squeeze of the air in front of the bottle."""

    def _grasp(self, world):
        return super()._grasp(world).advanced(-0.08)


@dataclass(frozen=True)
class Knock(Squeeze):
    """A closed hand that comes down where it should not."""

    on: str = ""
    names: frozenset[str] = frozenset()

    def phases(self, world):
        above = replace(self._grasp(world), position_w=world.frame(self.on).position_w)
        far, wide = above.moved(z=0.12), world.robot.max_opening
        yield Phase("hover", lambda w: far, wide, arrived(0.02, 0.2))
        yield Phase("knock", lambda w: above, wide, waited(5.0), self.names)


def squeezed(env: LabEnv, bottle: WashBottle) -> float:
    """Return what has left the bottle [ml]."""
    return env.workcell.world.reading(bottle.squeezed).value


def test_the_unspoilt_expert_succeeds(env):
    bottle, _ = things(env)
    assert play(env, *env.workcell.task.skills)["outcome"] == "success"
    assert squeezed(env, bottle) >= 20.0


@pytest.mark.slow
def test_a_bottle_of_glass_gives_nothing(env, monkeypatch):
    (bottle, region), (beaker, place) = env.workcell.task.start.items()
    rigid = replace(bottle, material=replace(bottle.material, young=GLASS))
    start = {rigid: region, beaker: replace(place, holder=rigid)}
    task = replace(env.workcell.task, start=start, contents={rigid: Filling(ml=200)})
    env = begun_with("level1/squeeze", task, monkeypatch)
    info = play(env, Squeeze(rigid, amount_ml=21.0))
    assert info["outcome"] == "timeout"
    assert np.isfinite(info["substeps"]["gripped"])
    assert squeezed(env, rigid) == 0.0


def test_half_of_it_is_not_enough(env):
    bottle, _ = things(env)
    info = play(env, Squeeze(bottle, amount_ml=10.0))
    assert 10.0 <= squeezed(env, bottle) < 20.0
    assert info["outcome"] == "running"
    assert info["substeps"]["dispensed"] == np.inf


@pytest.mark.slow
def test_two_small_strokes_are_as_good_as_one(env):
    bottle, _ = things(env)
    small = [Squeeze(bottle, amount_ml=amount, deep=0.045) for amount in (12.0, 21.0)]
    info = play(env, *small)
    assert info["outcome"] == "success"


def test_air_that_is_squeezed_gives_nothing(env):
    bottle, _ = things(env)
    info = play(env, Beside(bottle, amount_ml=21.0, strokes=1))
    assert info["outcome"] == "running"
    assert info["substeps"]["gripped"] == np.inf
    assert squeezed(env, bottle) == 0.0


@pytest.mark.slow
def test_a_hand_that_does_not_let_go_has_not_finished(env):
    bottle, _ = things(env)
    info = play(env, Clutch(bottle, amount_ml=21.0))
    assert np.isfinite(info["substeps"]["dispensed"])
    assert info["outcome"] == "timeout"
    assert not info["ever_success"]


@pytest.mark.slow
def test_a_hand_that_stays_round_the_bottle_has_not_finished(env):
    bottle, _ = things(env)
    info = play(env, Linger(bottle, amount_ml=21.0))
    assert np.isfinite(info["substeps"]["released"])
    assert info["outcome"] == "timeout"
    assert not info["ever_success"]


def test_a_jet_beside_the_beaker_spills(env, monkeypatch):
    (bottle, region), (beaker, _) = env.workcell.task.start.items()
    start = {bottle: region, beaker: OnBench(x=(0.30, 0.35), y=(-0.35, -0.30))}
    env = begun_with("level1/squeeze", replace(env.workcell.task, start=start), monkeypatch)
    info = play(env)
    assert info["outcome"] == "spilled"
    assert info["ml_spilled"] > 2
    assert info["ml_poured"] == 0


def test_a_hand_on_the_spout_has_collided(env):
    bottle, _ = things(env)
    knock = Knock(bottle, 1.0, on=bottle.spout, names=bottle.bodies)
    assert play(env, knock)["outcome"] == "collided"


def test_a_beaker_that_is_touched_ends_the_episode(env, monkeypatch):
    _, beaker = things(env)
    aside = OnBench(x=(0.25, 0.26), y=(0.28, 0.30))  # where the bottle is not in the way
    task = env.workcell.task
    env = begun_with(
        "level1/squeeze", replace(task, start={**task.start, beaker: aside}), monkeypatch
    )
    assert play(env, Pick(beaker, lift=0.05))["outcome"] == "struck"
