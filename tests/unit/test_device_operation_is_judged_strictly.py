"""Near misses of device_operation that a person would fail, and odd ways that are right."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from adversary import Careless, begun, moved, play_on
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Close, Go, Press
from labutopia_lerobot.skills.skill import Phase, Skill
from labutopia_lerobot.tasks.level4.beyond.device_operation import HIGH
from labutopia_lerobot.tasks.level4.drying_beakers import HEADING, INSIDE, OUTSIDE, OVEN
from labutopia_lerobot.world import Pose, World

TASK, SEED = "level4/device_operation", 100


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


@dataclass(frozen=True)
class Until:
    """Play a skill until a phase begins.

    Attributes:
        skill: What is played.
        phase: The first that is not played.
    """

    skill: Skill
    phase: str

    def phases(self, world: World) -> Iterator[Phase]:
        for phase in self.skill.phases(world):
            if phase.name == self.phase:
                return
            yield phase


@dataclass(frozen=True)
class PressBelow(Press):
    """Press the panel 45 mm below a button."""

    def _before(self, world: World) -> Pose:
        return super()._before(world).moved(z=-0.045)


@pytest.mark.slow
def test_a_hand_raised_by_twelve_centimetres_is_not_raised(env):
    low = replace(HIGH, height=OUTSIDE.height + 0.12)

    def choose(skills):
        return [Go((low, INSIDE), HEADING), skills[2]]

    info = play_on(env, SEED, "1_open", choose)
    assert info["outcome"] == "collided"  # with the beaker, whose turn it is not
    assert not np.isfinite(info["substeps"]["2_raise/raised"])
    assert not np.isfinite(info["substeps"]["3_pick/gripped"])


@pytest.mark.slow
def test_an_oven_is_not_started_with_one_beaker_still_on_the_bench(env):
    info = play_on(env, SEED, "4_place", lambda skills: skills[-2:])
    assert info["outcome"] == "pressed_out_of_turn"
    assert not np.isfinite(info["substeps"]["7_press/pressed"])


@pytest.mark.slow
def test_an_oven_is_not_started_before_it_is_loaded(env):
    def choose(skills):
        _, *_, go, press = skills
        return [go, press]

    assert play_on(env, SEED, "2_raise", choose)["outcome"] == "pressed_out_of_turn"


def test_a_beaker_that_touches_the_wall_does_not_stand_free(env):
    def choose(skills):
        return [Careless(moved(skills[0], left=-0.05), frozenset({"oven"})), *skills[1:]]

    assert play_on(env, SEED, "3_pick", choose)["outcome"] == "struck"


@pytest.mark.slow
def test_a_beaker_six_centimetres_off_is_not_where_it_should_be(env):
    info = play_on(env, SEED, "5_pick", lambda skills: [moved(skills[0], left=0.06), *skills[1:]])
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["6_place/placed"])
    assert not np.isfinite(info["substeps"]["7_press/pressed"])


@pytest.mark.slow
def test_a_button_that_does_not_click_starts_nothing(env):
    info = play_on(
        env, SEED, "6_place", lambda skills: [skills[0], replace(skills[1], beyond=-1e-3)]
    )
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["7_press/pressed"])


@pytest.mark.slow
def test_a_fist_against_the_panel_is_not_at_the_button(env):
    def choose(skills):
        go, press = skills
        return [go, Careless(PressBelow(press.button, hold=0.3, beyond=0.03), frozenset({"oven"}))]

    assert play_on(env, SEED, "6_place", choose)["outcome"] == "collided"


@pytest.mark.slow
def test_a_finger_that_stays_on_the_button_is_not_away(env):
    info = play_on(env, SEED, "6_place", lambda skills: [skills[0], Until(skills[1], "leave")])
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["7_press/pressed"])
    assert info["facts"]["oven_switch on"]


@pytest.mark.slow
def test_a_button_may_be_pressed_with_two_fingers_and_for_long(env):
    def choose(skills):
        go, press = skills
        return [go, replace(press, spacing=0.012, hold=2.0)]

    assert play_on(env, SEED, "6_place", choose)["outcome"] == "success"


@pytest.mark.slow
def test_the_hand_may_be_raised_higher(env):
    def choose(skills):
        _, _, *rest = skills
        higher = replace(HIGH, height=HIGH.height + 0.04)
        return [Go((higher, INSIDE), HEADING), rest[0]]

    info = play_on(env, SEED, "1_open", choose)
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["3_pick/lifted"])


@pytest.mark.slow
def test_the_door_may_be_shut_before_the_oven_is_started(env):
    def choose(skills):
        _, press = skills
        return [Go((INSIDE, OUTSIDE), HEADING), Close(OVEN.door, HEADING, beyond=2.0), press]

    assert play_on(env, SEED, "6_place", choose)["outcome"] == "success"
