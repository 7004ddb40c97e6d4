"""Adversarial cases of `level1/press`, played in the real simulation: nearly is not enough."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.skills.press import Press
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import Pose


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/press")


@dataclass(frozen=True)
class Askew(Press):
    """A press off the axis of the button [m], or at an angle to it [deg]."""

    aside: float = 0.0
    tilt_deg: float = 0.0

    def _before(self, world):
        face = world.frame(self.button.name)
        turn = Rotation.from_rotvec(np.radians(self.tilt_deg) * face.y_axis).as_matrix()
        point = face.position_w + self.aside * face.x_axis
        return Pose(point, turn @ face.rotation_w).advanced(
            -self.standoff - world.robot.finger_reach
        )


@dataclass(frozen=True)
class Ram(Press):
    """A fist against the panel, half-way between two buttons."""

    touches: frozenset[str] = frozenset()

    def phases(self, world):
        side = 0.06 * world.frame(self.button.name).rotation_w @ (-1.0, 1.0, 0.0) / np.sqrt(2.0)
        before = self._before(world).moved(*side)
        inside = before.advanced(self.standoff + 0.02)
        yield Phase("approach", lambda w: before, 0.0, arrived(0.01, 0.1))
        yield Phase("ram", lambda w: inside, 0.0, arrived(0.001), self.touches)


def buttons(env: LabEnv):
    return next(iter(env.workcell.task.start)).buttons


def test_the_unspoilt_expert_succeeds(env):
    assert play(env, Press(buttons(env)[0], hold=2.5))["outcome"] == "success"


def test_a_button_that_is_half_way_in_is_not_pressed(env):
    red, *_ = buttons(env)
    info = play(env, Press(red, hold=2.5, beyond=-0.001))
    assert env.workcell.world.joint(red.joint) > 0.001
    assert info["outcome"] == "running"
    assert info["substeps"]["pressed"] == np.inf


def test_a_button_let_go_after_one_and_a_half_seconds_is_not_held(env):
    info = play(env, Press(buttons(env)[0], hold=1.5))
    assert info["ever_success"]
    assert info["outcome"] == "running"


def test_a_finger_in_front_of_the_button_does_not_press_it(env):
    info = play(env, Press(buttons(env)[0], hold=2.5, beyond=-0.008))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["aligned"])
    assert not info["ever_success"]


def test_the_wrong_button_ends_the_episode(env):
    for other in buttons(env)[1:]:
        assert play(env, Press(other, hold=2.5))["outcome"] == "wrong_button"


def test_a_button_pressed_at_its_edge_is_misaligned(env):
    info = play(env, Askew(buttons(env)[0], hold=20.0, aside=0.012))
    assert info["facts"]["panel_red pressed"]
    assert info["outcome"] == "running"
    assert not info["ever_success"]


def test_a_button_pressed_at_an_angle_is_misaligned(env):
    info = play(env, Askew(buttons(env)[0], hold=20.0, tilt_deg=24.0))
    assert info["facts"]["panel_red pressed"]
    assert info["outcome"] == "running"
    assert not info["ever_success"]


def test_a_fist_against_the_panel_has_collided(env):
    panel = next(iter(env.workcell.task.start))
    red, *_ = panel.buttons
    assert play(env, Ram(red, hold=0.0, touches=panel.bodies))["outcome"] == "collided"


def test_the_order_of_the_colours_is_drawn_from_the_seed(env):
    panel = next(iter(env.workcell.task.start))
    orders = Counter()
    for seed in range(60):
        env.reset(seed=seed)
        to_panel = env.workcell.world.pose(panel).inverse()
        places = [
            (to_panel @ env.workcell.world.frame(b.name)).position_w[1] for b in panel.buttons
        ]
        orders[tuple(np.argsort(places))] += 1
    assert len(orders) == 6
    assert max(orders.values()) < 20  # the 99.9 % quantile of a sixth of 60 is 19


def test_the_state_says_where_each_colour_is(env):
    observation, _ = env.reset(seed=9)
    names = environment_state_names(env.workcell.task)
    state = dict(zip(names, observation["environment_state"], strict=True))
    for button in buttons(env):
        expected = env.workcell.world.robot_base.inverse() @ env.workcell.world.frame(button.name)
        reported = [state[f"{button.name}.{axis}"] for axis in "xyz"]
        assert np.allclose(reported, expected.position_w, atol=1e-6)
