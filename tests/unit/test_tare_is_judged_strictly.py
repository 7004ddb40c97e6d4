"""Adversarial cases of `level1/tare`, played in the real simulation."""

from dataclasses import dataclass

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.press import Press
from labutopia_lerobot.skills.skill import Phase, arrived, waited


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/tare")


def things(env: LabEnv):
    return tuple(env.workcell.task.start)


@dataclass(frozen=True)
class PressThePan:
    """Push the pan down beside what stands on it."""

    balance: object

    def phases(self, world):
        pan = world.frame(self.balance.pan.place.name)
        reach = world.robot.finger_reach
        touches = frozenset({self.balance.pan.name, self.balance.name})
        down = world.frame(self.balance.tare.name)
        above = down.moved(*(pan.position_w - down.position_w + (-0.05, 0.06, 0.10 + reach)))
        yield Phase("above", lambda w: above, 0.0, arrived(within=0.02), touches, timeout_s=9.0)
        low = above.moved(z=-0.12)
        yield Phase("push", lambda w: low, 0.0, waited(2.0), touches, speed=0.05)


def test_the_unspoilt_expert_succeeds_and_the_display_shows_zero(env):
    balance, _ = things(env)
    info = play(env, *env.workcell.task.skills)
    assert info["outcome"] == "success"
    assert abs(info["readings"][balance.weighing.name]) <= 0.03


def test_a_balance_with_a_beaker_on_it_does_not_read_zero_at_the_start(env):
    balance, beaker = things(env)
    _, info = env.reset(seed=3)
    shown = info["readings"][balance.weighing.name]
    assert shown == pytest.approx(1e3 * beaker.mass, abs=0.05)


def test_half_a_press_sets_nothing_to_zero(env):
    balance, _ = things(env)
    info = play(env, Press(balance.tare, hold=0.5, beyond=-0.0015))
    assert info["outcome"] != "success"
    assert info["substeps"]["pressed"] == np.inf


def test_a_finger_that_stays_on_the_button_has_not_finished(env):
    balance, _ = things(env)
    info = play(env, Press(balance.tare, hold=9.0, standoff=0.01))
    assert info["outcome"] != "success"


def test_a_beaker_that_is_taken_off_first_has_been_touched_out_of_turn(env):
    balance, beaker = things(env)
    info = play(env, Pick(beaker, lift=0.1, support=balance.pan.name))
    assert info["outcome"] in ("collided", "displaced")


def test_a_pan_that_is_pushed_while_it_is_tared_reads_otherwise_afterwards(env):
    balance, _ = things(env)
    info = play(env, PressThePan(balance))
    assert info["outcome"] != "success"
