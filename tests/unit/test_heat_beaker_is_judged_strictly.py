"""Adversarial cases of `level2/heat_beaker`, played in the real simulation."""

from dataclasses import dataclass

import numpy as np
import pytest

from adversary import begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OnTop
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.skills.press import Press
from labutopia_lerobot.skills.skill import Phase, arrived, waited


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level2/heat_beaker", liquid="off")


@dataclass(frozen=True)
class OffCentre(OnTop):
    """A place to the left of the middle of a thing's top [m]."""

    left: float = 0.0

    def position_w(self, world):
        return super().position_w(world) + self.left * world.pose(self.of).y_axis


@dataclass(frozen=True)
class Strike:
    """Move the hand level from its place to a thing's lip and on, whatever it touches."""

    thing: object
    touches: frozenset[str]

    def phases(self, world):
        lip = world.frame(f"{self.thing.name}_rim").position_w
        here = world.gripper
        start = here.moved(z=lip[2] - 0.010 - here.position_w[2])
        there = start.moved(*(1.8 * (lip - start.position_w) * (1, 1, 0)))
        yield Phase("rise", lambda w: start, 0.0, arrived(within=0.01), self.touches)
        yield Phase("strike", lambda w: there, 0.0, waited(2.0), self.touches, speed=0.6)


def things(env: LabEnv):
    return tuple(env.workcell.task.start)


def test_the_unspoilt_expert_succeeds_and_the_lamp_is_lit(env):
    _, heater = things(env)
    info = play(env, *env.workcell.task.skills)
    assert info["outcome"] == "success"
    env.workcell.simulation.apparatus.show()
    lamp = env.workcell.simulation.scene.model.geom(heater.switch.lamp)
    assert np.allclose(lamp.rgba, heater.switch.lit)


def test_a_beaker_carried_nineteen_centimetres_high_is_not_picked(env):
    beaker, heater = things(env)
    place, press = Place(beaker, OnTop(heater), hover=0.02), Press(heater.button, hold=0.3)
    info = play(env, Pick(beaker, lift=0.19), place, press)
    assert info["outcome"] == "pressed_out_of_turn"
    assert info["substeps"]["lifted"] == np.inf


def test_a_button_that_is_half_way_in_switches_nothing_on(env):
    _, heater = things(env)
    pick, place, _ = env.workcell.task.skills
    info = play(env, pick, place, Press(heater.button, hold=0.3, beyond=-0.001))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["placed"])
    assert info["substeps"]["pressed"] == np.inf


def test_a_heater_is_not_switched_on_before_the_beaker_comes(env):
    pick, place, press = env.workcell.task.skills
    info = play(env, press, pick, place, press, press)
    assert info["outcome"] == "pressed_out_of_turn"
    assert not info["ever_success"]


def test_a_button_pressed_twice_switches_the_heater_off_again(env):
    pick, place, press = env.workcell.task.skills
    info = play(env, pick, place, press, press)
    assert info["outcome"] == "running"
    assert not info["facts"]["heater_switch on"]


def test_a_finger_that_stays_on_the_button_is_not_gone(env):
    _, heater = things(env)
    pick, place, _ = env.workcell.task.skills
    info = play(env, pick, place, Press(heater.button, hold=60.0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["pressed"])
    assert not info["ever_success"]


def test_a_beaker_that_overhangs_the_plate_is_not_on_it(env):
    beaker, heater = things(env)
    pick, _, press = env.workcell.task.skills
    info = play(env, pick, Place(beaker, OffCentre(heater, left=0.056)), press)
    assert info["outcome"] == "pressed_out_of_turn"
    assert info["substeps"]["placed"] == np.inf


def test_a_beaker_struck_at_its_lip_is_broken_or_knocked_over(env):
    beaker, heater = things(env)
    everything = frozenset({beaker.name, "bench"}) | heater.bodies
    pick, place, press = env.workcell.task.skills
    info = play(env, pick, place, press, Strike(beaker, everything))
    assert np.isfinite(info["substeps"]["pressed"])
    assert info["outcome"] in {"broken", "knocked_over"}


def test_a_hand_that_bows_onto_beaker_or_plate_is_no_success(env):
    beaker, heater = things(env)

    bow = turning(0.6, "place/done", joint=5)
    pick, *_ = env.workcell.task.skills
    info = play(env, pick, Place(beaker, OnTop(heater), retreat=0.03), spoil=bow)
    assert info["outcome"] in {"broken", "collided", "knocked_over"}
