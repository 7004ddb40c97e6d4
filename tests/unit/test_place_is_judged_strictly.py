"""Adversarial cases of placing and transporting, played in the real simulation."""

from dataclasses import dataclass

import numpy as np
import pytest

from adversary import begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/place", liquid="off")


@dataclass(frozen=True)
class Aside(OnTop):
    """A place beside the middle of a thing's top [m]."""

    x: float = 0.0

    def position_w(self, world):
        return super().position_w(world) + self.x * world.pose(self.of).x_axis


def things(env: LabEnv):
    return tuple(env.workcell.task.start)


def test_the_unspoilt_skill_succeeds(env):
    beaker, plate = things(env)
    assert play(env, Place(beaker, OnTop(plate)))["outcome"] == "success"


@pytest.mark.slow
def test_a_beaker_that_stays_in_the_hand_is_not_placed(env):
    beaker, plate = things(env)

    def keep_shut(expert, action):
        action[-1] = beaker.grip_width - 0.012

    info = play(env, Place(beaker, OnTop(plate), retreat=0.0), spoil=keep_shut)
    assert info["outcome"] == "running"
    assert info["facts"]["beaker standing on target_plate"]
    assert not info["ever_success"]


@pytest.mark.slow
def test_a_hand_that_stays_around_the_beaker_has_not_withdrawn(env):
    beaker, plate = things(env)
    info = play(env, Place(beaker, OnTop(plate), retreat=0.0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["released"])
    assert not np.isfinite(info["substeps"]["retracted"])
    assert not info["ever_success"]


@pytest.mark.slow
def test_a_base_that_overhangs_the_plate_is_not_in_full_contact(env):
    beaker, plate = things(env)
    info = play(env, Place(beaker, Aside(plate, x=0.048)))
    assert info["outcome"] == "running"
    assert info["facts"]["beaker released"]
    assert not info["ever_success"]


@pytest.mark.slow
def test_a_beaker_beside_the_plate_is_not_at_the_target(env):
    beaker, plate = things(env)

    class Bench(Aside):
        support = "bench"

        def position_w(self, world):
            return super().position_w(world) * (1, 1, 0) + (0, 0, world.bench_height)

    info = play(env, Place(beaker, Bench(plate, x=0.14)))
    assert info["outcome"] == "running"
    assert not info["ever_success"]


def test_a_beaker_let_go_above_the_plate_is_dropped(env):
    beaker, plate = things(env)

    def let_go(expert, action):
        if env.workcell.world.pose(beaker).position_w[2] < env.workcell.world.bench_height + 0.09:
            action[-1] = PANDA.max_opening

    assert play(env, Place(beaker, OnTop(plate)), spoil=let_go)["outcome"] == "dropped"


def test_a_beaker_let_go_aslant_falls_on_its_edge_or_over(env):
    beaker, plate = things(env)

    slant = turning(0.8, "place/settle", "place/open")
    info = play(env, Place(beaker, OnTop(plate)), spoil=slant)
    assert info["outcome"] in {"broken", "knocked_over", "collided"}


def test_a_hand_on_the_plate_has_struck_it(env):
    beaker, plate = things(env)

    bow = turning(0.5, "place/done", joint=5)
    info = play(env, Place(beaker, OnTop(plate), retreat=0.03), spoil=bow)
    assert info["outcome"] == "struck"


@pytest.mark.slow
def test_a_beaker_carried_nineteen_centimetres_high_is_not_transported():
    env = begun("level2/transport_beaker", liquid="off")
    beaker, plate = things(env)
    info = play(env, Pick(beaker, lift=0.19), Place(beaker, OnTop(plate)))
    assert info["outcome"] == "running"
    assert info["facts"]["beaker standing on target_plate"]
    assert info["substeps"]["lifted"] == np.inf
