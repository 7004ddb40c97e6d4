"""Near misses of drying_beakers that a person would call failures, and odd ways that are right."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from adversary import Careless, Choose, begun, moved, play_on
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Close, Go
from labutopia_lerobot.skills.handle import Operable, move_by_handle
from labutopia_lerobot.skills.skill import Phase, Skill
from labutopia_lerobot.tasks.level4.drying_beakers import HEADING

TASK, SEED = "level4/drying_beakers", 100


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


@dataclass(frozen=True)
class CloseTo:
    """Close a door by its handle, but not altogether.

    Attributes:
        door: The door.
        to: Where it is left [rad].
    """

    door: Operable
    to: float

    def phases(self, world) -> Iterator[Phase]:
        near = self.to + math.radians(0.3)
        yield from move_by_handle(
            self.door, world, self.to, lambda w, *_: w.joint(self.door.joint) < near, HEADING
        )


def closing(to: float) -> Choose:
    def choose(skills: list[Skill]) -> list[Skill]:
        return [CloseTo(s.part, to) if isinstance(s, Close) else s for s in skills]

    return choose


@pytest.mark.parametrize("left_at", [pytest.param(1.6, marks=pytest.mark.slow), 8.0])
def test_a_door_that_is_left_before_its_catch_is_not_closed(env, left_at):
    info = play_on(env, SEED, "5_place", closing(math.radians(left_at)))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["6_close/moved"])
    assert not np.isfinite(info["substeps"]["6_close/latched"])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("after", "left", "touched"), [("4_pick", -0.06, "large_beaker"), ("2_pick", -0.05, "oven")]
)
def test_a_beaker_that_touches_the_other_or_a_wall_does_not_stand_free(env, after, left, touched):
    def choose(skills):
        return [Careless(moved(skills[0], left=left), frozenset({touched})), *skills[1:]]

    assert play_on(env, SEED, after, choose)["outcome"] == "struck"


@pytest.mark.slow
def test_a_beaker_six_centimetres_off_is_not_where_it_should_be(env):
    info = play_on(env, SEED, "4_pick", lambda skills: [moved(skills[0], left=0.06)])
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["5_place/placed"])


def test_the_small_beaker_first_is_out_of_order(env):
    def choose(skills):
        go, _, _, pick_the_small_one, *_ = skills
        return [go, pick_the_small_one]

    info = play_on(env, SEED, "1_open", choose)
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["2_pick/gripped"])


@pytest.mark.slow
def test_an_oven_that_is_left_open_dries_nothing(env):
    info = play_on(env, SEED, "5_place", lambda skills: [s for s in skills if isinstance(s, Go)])
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["6_close/moved"])


@pytest.mark.slow
def test_a_beaker_two_centimetres_off_will_do(env):
    def choose(skills):
        return [moved(skills[0], left=0.02, inward=0.01), *skills[1:]]

    assert play_on(env, SEED, "4_pick", choose)["outcome"] == "success"


@pytest.mark.slow
def test_a_door_may_be_closed_in_two_goes(env):
    def choose(skills):
        go, close = skills
        return [go, CloseTo(close.part, math.radians(50)), close]

    assert play_on(env, SEED, "5_place", choose)["outcome"] == "success"
