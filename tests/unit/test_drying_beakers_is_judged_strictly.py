"""Near misses of drying_beakers that a person would call failures, and odd ways that are right."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OnShelf
from labutopia_lerobot.skills import Close, Go, Place
from labutopia_lerobot.skills.handle import Operable, move_by_handle
from labutopia_lerobot.skills.skill import Phase, Skill
from labutopia_lerobot.tasks.level4.drying_beakers import HEADING
from labutopia_lerobot.world import CONTROL_HZ

type Choose = Callable[[list[Skill]], list[Skill]]
"""What is played, of the skills that are still to come."""

TASK, SEED = "level4/drying_beakers", 100


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def play_on(env: LabEnv, after: str, choose: Choose) -> dict[str, Any]:
    """Play from behind a step what is chosen of the skills to come, and wait for three seconds.

    Returns:
        The last info; its outcome is "running" where the goal did not hold.
    """
    env.reset(seed=SEED, options={"after": after})
    task = env.workcell.task
    done = len([skill for step in task.steps_until(after) for skill in step.skills])
    expert = env.workcell.expert(choose(list(task.skills[done:])))
    expert.start()
    over, left = False, 3 * CONTROL_HZ
    while not over and left:
        left -= bool(expert.finished or expert.failure)
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    return info


def moved(place: Place, *, inward: float = 0.0, left: float = 0.0) -> Place:
    """Return a `Place` onto the shelf, some way off [m]."""
    on = place.on
    assert isinstance(on, OnShelf)
    return replace(place, on=replace(on, inward=on.inward + inward, left=on.left + left))


@dataclass(frozen=True)
class Careless:
    """Play a skill without keeping clear of some things.

    Attributes:
        skill: What is played.
        of: Their contact names.
    """

    skill: Skill
    of: frozenset[str]

    def phases(self, world) -> Iterator[Phase]:
        for phase in self.skill.phases(world):
            yield replace(phase, touches=phase.touches | self.of)


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


@pytest.mark.parametrize("left_at", [1.6, 8.0])
def test_a_door_that_is_left_before_its_catch_is_not_closed(env, left_at):
    info = play_on(env, "5_place", closing(math.radians(left_at)))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["6_close/moved"])
    assert not np.isfinite(info["substeps"]["6_close/latched"])


@pytest.mark.parametrize(
    ("after", "left", "touched"), [("4_pick", -0.06, "large_beaker"), ("2_pick", -0.05, "oven")]
)
def test_a_beaker_that_touches_the_other_or_a_wall_does_not_stand_free(env, after, left, touched):
    def choose(skills):
        return [Careless(moved(skills[0], left=left), frozenset({touched})), *skills[1:]]

    assert play_on(env, after, choose)["outcome"] == "struck"


def test_a_beaker_six_centimetres_off_is_not_where_it_should_be(env):
    info = play_on(env, "4_pick", lambda skills: [moved(skills[0], left=0.06)])
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["5_place/placed"])


def test_the_small_beaker_first_is_out_of_order(env):
    def choose(skills):
        go, _, _, pick_the_small_one, *_ = skills
        return [go, pick_the_small_one]

    info = play_on(env, "1_open", choose)
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["2_pick/gripped"])


def test_an_oven_that_is_left_open_dries_nothing(env):
    info = play_on(env, "5_place", lambda skills: [s for s in skills if isinstance(s, Go)])
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["6_close/moved"])


def test_a_beaker_two_centimetres_off_will_do(env):
    def choose(skills):
        return [moved(skills[0], left=0.02, inward=0.01), *skills[1:]]

    assert play_on(env, "4_pick", choose)["outcome"] == "success"


def test_a_door_may_be_closed_in_two_goes(env):
    def choose(skills):
        go, close = skills
        return [go, CloseTo(close.part, math.radians(50)), close]

    assert play_on(env, "5_place", choose)["outcome"] == "success"
