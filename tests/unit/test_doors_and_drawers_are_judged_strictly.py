"""Adversarial cases of opening and closing, played in the real simulation: nearly is not enough."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills.close import Close
from labutopia_lerobot.skills.handle import Operable, move_by_handle
from labutopia_lerobot.skills.open import Open
from labutopia_lerobot.skills.skill import Phase, Skill, arrived, waited
from labutopia_lerobot.world import CONTROL_HZ, Pose

OPENING = ("level1/open_door", "level1/open_drawer")
CLOSING = ("level1/close_door", "level1/close_drawer")


@pytest.fixture(scope="module")
def envs() -> Callable[[str], LabEnv]:
    made: dict[str, LabEnv] = {}
    return lambda task: made.get(task) or made.setdefault(task, begun(task))


def part_of(env: LabEnv) -> Operable:
    return env.workcell.task.skills[0].part


@dataclass(frozen=True)
class MoveTo:
    """Move a door or drawer by its handle to a position of its joint, wherever that is."""

    part: Operable
    to: float

    def phases(self, world) -> Iterator[Phase]:
        near = 0.02 * abs(self.to - world.joint(self.part.joint))
        yield from move_by_handle(
            self.part, world, self.to, lambda w, *_: abs(w.joint(self.part.joint) - self.to) < near
        )


@dataclass(frozen=True)
class Push:
    """Push a closed fist against the handle, along the way of the door or drawer."""

    part: Operable

    def phases(self, world) -> Iterator[Phase]:
        bar = frozenset({self.part.handle.name})
        approach = next(move_by_handle(self.part, world, 0.0, waited(0.0)))
        yield replace(approach, opening=0.0)
        near = world.gripper.advanced(0.083)
        yield Phase("touch", lambda w: near, 0.0, arrived(0.005), touches=bar)
        fist = world.frame(self.part.handle.name).inverse() @ near

        def onward(world) -> Pose:
            return self.part.carried(world.frame(self.part.handle.name) @ fist, world, -0.1)

        yield Phase("push", onward, 0.0, waited(5.0), touches=bar)
        back = world.gripper.advanced(-0.12)
        yield Phase("leave", lambda w: back, 0.0, arrived(0.01), touches=bar)


@dataclass(frozen=True)
class Ram:
    """Drive the hand into the front, beyond the end of the bar."""

    part: Operable
    bodies: frozenset[str]

    def phases(self, world) -> Iterator[Phase]:
        yield next(move_by_handle(self.part, world, 0.0, waited(0.0)))
        bar = world.frame(self.part.handle.name)
        spot = bar.position_w + 0.14 * bar.z_axis + 0.08 * bar.x_axis
        beside = Pose(spot, world.gripper.rotation_w)
        yield Phase("ram", lambda w: beside, 0.05, waited(5.0), touches=self.bodies)


@dataclass(frozen=True)
class Only:
    """Some of the phases of a skill."""

    skill: Skill
    names: tuple[str, ...]

    def phases(self, world) -> Iterator[Phase]:
        return (phase for phase in self.skill.phases(world) if phase.name in self.names)


def let_go_half_way(env: LabEnv):
    """Return a spoiler that opens the fingers once the joint is half-way to where it should be."""
    joint = part_of(env).joint
    start = env.workcell.world.joint(joint)
    skill = env.workcell.task.skills[0]
    half = (start + getattr(skill, "to", 0.0)) / 2

    def spoil(expert, action):
        if (
            expert.label.endswith("/move")
            and (env.workcell.world.joint(joint) - half) * (start - half) < 0
        ):
            action[-1] = 0.05

    return spoil


@pytest.mark.parametrize("task", [*OPENING, *CLOSING, "level2/operate_drawer"])
def test_the_unspoilt_expert_succeeds(envs, task):
    assert play(envs(task))["outcome"] == "success"


@pytest.mark.parametrize(("task", "short"), [(OPENING[0], math.radians(48)), (OPENING[1], 0.12)])
def test_not_quite_open_is_not_open(envs, task, short):
    env = envs(task)
    info = play(env, MoveTo(part_of(env), short))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["gripped"])
    assert not np.isfinite(info["substeps"]["opened"])


@pytest.mark.parametrize(("task", "gap"), [(CLOSING[0], math.radians(1)), (CLOSING[1], 0.004)])
def test_left_ajar_is_not_closed(envs, task, gap):
    env = envs(task)
    info = play(env, MoveTo(part_of(env), gap))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["touched"])
    assert not np.isfinite(info["substeps"]["closed"])


@pytest.mark.parametrize("task", CLOSING)
def test_what_something_else_shut_cannot_be_closed_any_more(envs, task):
    env = envs(task)
    part = part_of(env)
    env.reset(seed=5)
    ajar = env.workcell.world.joint(part.joint)

    def knocked(expert, action):
        if env.workcell.world.time < 1.0:
            env.workcell.simulation.data.joint(part.joint).qvel = -1.3 * ajar

    info = play(env, spoil=knocked)
    assert env.workcell.world.joint(part.joint) < part.closed_within
    assert info["outcome"] == "running"
    assert not np.isfinite(info["substeps"]["touched"])


@pytest.mark.parametrize("task", CLOSING)
def test_what_is_pushed_shut_with_a_fist_at_the_handle_is_closed(envs, task):
    env = envs(task)
    info = play(env, Push(part_of(env)))
    assert info["outcome"] == "success"
    assert not info["facts"][f"{part_of(env).handle.name} grasped"]


@pytest.mark.parametrize("task", OPENING)
def test_what_goes_on_opening_after_the_grip_is_lost_has_not_been_pulled_open(envs, task):
    env = envs(task)
    env.reset(seed=5)
    info = play(env, spoil=let_go_half_way(env))
    assert info["outcome"] in ("running", "collided")
    assert np.isfinite(info["substeps"]["gripped"])
    assert not np.isfinite(info["substeps"]["opened"])


def test_a_grip_that_jolts_a_drawer_by_six_millimetres_is_a_grip(envs):
    env = envs("level1/open_drawer")
    pressed = play(env)["substeps"]["gripped"]
    jolts = {pressed - 1.5 / CONTROL_HZ: 0.004, pressed - 0.5 / CONTROL_HZ: 0.003}

    def jolt(expert, action):
        for time in [time for time in jolts if time < env.workcell.world.time]:
            env.workcell.simulation.data.joint(part_of(env).joint).qpos += jolts.pop(time)

    info = play(env, spoil=jolt)
    assert not jolts
    assert info["substeps"]["gripped"] > pressed
    assert info["outcome"] == "success"


@pytest.mark.parametrize(("task", "by"), [(OPENING[0], math.radians(5)), (OPENING[1], 0.03)])
def test_what_was_open_before_the_grip_has_not_been_pulled_open(envs, task, by):
    env = envs(task)

    def opened_otherwise(expert, action):
        if env.workcell.world.time < 0.5:
            env.workcell.simulation.data.joint(part_of(env).joint).qpos = by

    info = play(env, spoil=opened_otherwise)
    assert env.workcell.world.joint(part_of(env).joint) > by
    assert info["outcome"] == "running"


@pytest.mark.parametrize(("task", "half"), [(OPENING[0], math.radians(25)), (OPENING[1], 0.07)])
def test_two_pulls_with_a_release_between_are_as_good_as_one(envs, task, half):
    env = envs(task)
    part = part_of(env)
    again = env.workcell.task.skills
    assert play(env, MoveTo(part, half), *again)["outcome"] == "success"


@pytest.mark.parametrize("task", [*OPENING, *CLOSING, "level2/operate_drawer"])
def test_what_is_slammed_after_all_was_done_has_been_slammed(envs, task):
    env = envs(task)
    part = part_of(env)

    def fling(expert, action):
        if expert.finished and not env.workcell.progress.over:
            now = env.workcell.world.joint(part.joint)
            env.workcell.simulation.data.joint(part.joint).qvel = 1.5 - 3.0 * (now > 0.01)

    assert play(env, spoil=fling)["outcome"] == "slammed"


@pytest.mark.parametrize("task", [*OPENING, *CLOSING])
def test_a_hand_that_stays_around_the_handle_has_not_finished(envs, task):
    env = envs(task)
    until = ("approach", "reach", "settle", "grip", "move", "pause", "release")
    info = play(env, Only(env.workcell.task.skills[0], until))
    assert info["outcome"] == "running"
    assert all(np.isfinite(time) for time in info["substeps"].values())
    assert not info["ever_success"]


@pytest.mark.parametrize("task", OPENING)
def test_what_is_closed_again_at_once_does_not_stay_open(envs, task):
    env = envs(task)
    part = part_of(env)
    info = play(env, *env.workcell.task.skills, Close(part))
    assert info["ever_success"]
    assert info["outcome"] in {"running", "timeout"}


@pytest.mark.parametrize("task", [*OPENING, *CLOSING])
def test_the_hand_may_not_touch_anything_but_the_handle(envs, task):
    env = envs(task)
    (instrument,) = env.workcell.task.start
    assert play(env, Ram(part_of(env), instrument.bodies))["outcome"] == "collided"


def test_a_drawer_that_is_only_opened_has_not_been_operated(envs):
    env = envs("level2/operate_drawer")
    info = play(env, Open(part_of(env), to=0.15))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["released"])
    assert not np.isfinite(info["substeps"]["touched"])


def test_a_drawer_moved_out_and_in_without_letting_go_has_not_been_operated(envs):
    env = envs("level2/operate_drawer")
    part = part_of(env)
    out = Only(Open(part, to=0.15), ("approach", "reach", "settle", "grip", "move", "pause"))
    back = Only(Close(part), ("move", "pause", "release", "leave"))
    info = play(env, out, back)
    assert info["outcome"] == "running"
    assert env.workcell.world.joint(part.joint) < part.closed_within
    assert not np.isfinite(info["substeps"]["released"])
