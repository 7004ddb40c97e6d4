"""Plays that are the same for every task: ways to fail it, and ways to do it that look odd.

A play begins in an environment that has been reset, and yields actions. It goes by what happens,
not by the names of things, so that it is played in tasks that do not exist yet.
"""

from collections.abc import Callable
from functools import cache
from itertools import chain, repeat
from typing import Any

import numpy as np
import pytest

from attacks.arm import Actions, Arm
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots.robot import Roles
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.task import DIVERGED
from labutopia_lerobot.world import CONTROL_HZ, LEFT_PAD, RIGHT_PAD, Pose

type Play = Callable[[LabEnv], Actions]

UNFINISHED = {"running", "timeout"}
"""Outcomes of a play that is over and has not come to the end of the task."""

_WAIT_S = 5
"""How long is waited for a success behind the last action [s]."""

SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 5))]


def slow(*case: object) -> Any:
    """Return a case that `make test` leaves to `make test-slow`."""
    return pytest.param(*case, marks=pytest.mark.slow)


@cache
def begun(task: str, liquid: str = "off", axes: tuple[str, ...] = ()) -> LabEnv:
    """Return an environment without pictures, with a third of the usual particles."""
    return LabEnv(Setting(task, obs="state", liquid=liquid, particles=300, axes=axes))


def roles(env: LabEnv) -> Roles:
    """Return what the numbers of an action are."""
    return env.workcell.simulation.scene.robot.roles


def outcome(env: LabEnv, play: Play, seed: int) -> dict[str, Any]:
    """Play from a reset until the episode is over; return the last info.

    When the play has no more actions the last one is repeated for a while; the outcome is "running"
    where nothing came of it: a goal that holds for two seconds has been won. An episode in which
    the physics diverged shows nothing of the judge: it is an error.
    """
    env.reset(seed=seed)
    actions, over, left = play(env), False, _WAIT_S * CONTROL_HZ
    last = env.workcell.simulation.command.astype(np.float32)
    while not over and left:
        action = next(actions, None)
        left -= action is None
        last = last if action is None else action
        _, _, terminated, truncated, info = env.step(last)
        over = terminated or truncated
    if info["outcome"] == DIVERGED:
        raise AssertionError(f"the physics of {env.task}, seed {seed}, diverged")
    return info


def expert(env: LabEnv) -> Actions:
    """Play as the task's expert does, until it is done or has failed."""
    script = env.expert()
    script.start()
    while not (script.finished or script.failure):
        yield script.act()


def until(env: LabEnv, happened: Callable[[], bool]) -> Actions:
    """Play as the expert does until something has happened."""
    script = env.expert()
    script.start()
    while not happened():
        yield script.act()


def until_phase(env: LabEnv, label: str, step: str | None = None) -> Actions:
    """Play as the expert does until it begins a phase, such as `place/lower`, within a step."""
    script = env.expert()
    script.start()
    while True:
        action = script.act()
        now = env.workcell.progress.step
        if script.label == label and (step is None or (now is not None and now.name == step)):
            return
        if script.finished or script.failure is not None:
            raise AssertionError(f"{env.task}, seed {env.seed}: {label} was not begun")
        yield action


def skilled(env: LabEnv, *skills: Skill) -> Actions:
    """Play skills as an expert would, from what there is now; a skill that fails is an error."""
    script = env.workcell.expert(skills)
    script.start()
    while not script.finished:
        action = script.act()
        if script.failure is not None:
            raise AssertionError(f"{env.task}, seed {env.seed}: {script.failure}")
        yield action


def skilled_until(env: LabEnv, label: str, *skills: Skill) -> Actions:
    """Play skills as an expert would until it begins a phase."""
    script = env.workcell.expert(skills)
    script.start()
    while True:
        action = script.act()
        if script.label == label:
            return
        if script.finished or script.failure is not None:
            raise AssertionError(f"{env.task}, seed {env.seed}: {label} not begun")
        yield action


def reached(info: dict[str, Any]) -> list[str]:
    """Return the substeps that have latched."""
    return [name for name, time in info["substeps"].items() if time < np.inf]


def latched(env: LabEnv) -> list[str]:
    """Return the substeps that have latched by now."""
    times = env.workcell.progress.substeps
    return [name for name, time in times.items() if time is not None]


def _down(arm: Arm, env: LabEnv, speed: float = 0.25) -> Actions:
    """Drive the hand straight down, to where the bench is and 5 cm further; `speed` in m/s."""
    bench = env.workcell.world.bench_height
    here = arm.pose
    return arm.go(here.moved(z=bench - 0.05 - here.position_w[2]), speed=speed)


def ram_the_bench(env: LabEnv) -> Actions:
    """Drive what is in the hand, or the fist, into the bench, go back and do the task."""
    arm = Arm(env)
    shut = float(arm.command[roles(env).gripper]) if _held(env) else 0.0
    home = arm.pose
    yield from chain(arm.stay(0.5, shut), _down(arm, env), arm.go(home), expert(env))


def ram_the_bench_at_the_end(env: LabEnv) -> Actions:
    """Do the task, and drive the hand into the bench before it has counted."""
    yield from until(env, lambda: env.workcell.progress.ever)
    arm = Arm(env)
    above = arm.pose.position_w[2] - env.workcell.world.bench_height
    in_time = max(0.25, above / 1.0)  # a hand that ends high would come too late
    yield from _down(arm, env, in_time)


def never_close_the_hand(env: LabEnv) -> Actions:
    """Do as the expert does, with open fingers."""
    for action in expert(env):
        action[roles(env).gripper] = env.workcell.world.robot.max_opening
        yield action


def give_up_half_way(env: LabEnv) -> Actions:
    """Stop for good when the first substep has latched."""
    yield from until(env, lambda: bool(latched(env)))


def drop(env: LabEnv) -> Actions:
    """Open the hand for good once something has been between the pads for half a second."""
    since: list[float] = []
    for action in expert(env):
        if _held(env):
            since.append(env.workcell.world.time)
        if since and env.workcell.world.time > since[0] + 0.5:
            action[roles(env).gripper] = env.workcell.world.robot.max_opening
        yield action


def shake_while_holding(env: LabEnv) -> Actions:
    """Do the task, and rock what is in the hand by 12 degrees, twice a second, as it counts."""
    yield from until(env, lambda: env.workcell.progress.ever)
    arm, began = Arm(env), env.workcell.world.time
    last = roles(env).joints.stop - 1
    level = arm.command[last]
    for action in arm.stay(env.workcell.task.time_limit_s):
        action[last] = level + 0.2 * np.sin(4 * np.pi * (env.workcell.world.time - began))
        yield action


def stretch_first(env: LabEnv) -> Actions:
    """Raise the hand, draw it back where the arm has length left, return, then do the task."""
    arm = Arm(env)
    home, still = arm.pose, arm.command.astype(np.float32)
    away = [*arm.go(home.moved(z=0.02)), *arm.go(home.moved(x=-0.08, z=0.08))]
    yield from chain(away, reversed(away), repeat(still, CONTROL_HZ // 2), expert(env))


def tremble(env: LabEnv) -> Actions:
    """Wait a second, then do the task with a hand that trembles by half a milliradian a joint."""
    rng = np.random.default_rng(env.seed)
    yield from Arm(env).stay(1.0)
    for action in expert(env):
        noise = rng.normal(0.0, 0.0005, len(action))
        noise[roles(env).gripper] = 0.0
        yield action + noise.astype(np.float32)


def shove_a_distractor(label: str) -> Play:
    """Make a play that shoves what stands around, on the right, with what is in the hand.

    From the beginning of a phase on; when something has been shoved, the hand goes back and the
    task's last skill is played.
    """

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, label)
        world, arm, skill = env.workcell.world, Arm(env), env.workcell.task.skills[-1]
        held = world.pose(skill.thing).position_w
        standing = [thing for thing in world.movable if thing.name.startswith("distractor")]
        places = [world.pose(thing).position_w for thing in standing]
        there = min(places, key=lambda place: abs(place[1] - held[1] + 0.2))
        low = 0.03 + world.bench_height - held[2]
        home = arm.pose
        beside = home.moved(*(there[:2] - held[:2] + (0.0, 0.16)), low)
        yield from chain(arm.go(beside, speed=0.2), arm.stay(0.2))
        yield from arm.go(beside.moved(y=-0.16), speed=0.08)
        moved = [world.pose(thing).distance_to(world.stood(thing)) for thing in standing]
        assert max(moved) > 0.02
        yield from arm.go(home.moved(z=0.25 if low > -0.1 else 0.0), speed=0.2)
        if not label.startswith("pick"):
            yield from skilled(env, skill)

    return play


def turned(pose: Pose, axis: int, angle: float) -> Pose:
    """Return a pose turned about one of its own axes, by an angle [rad]."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.eye(3)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turn[first, first] = turn[second, second] = cosine
    turn[second, first], turn[first, second] = sine, -sine
    return Pose(pose.position_w, pose.rotation_w @ turn)


def _held(env: LabEnv) -> bool:
    """Return whether both pads touch one thing."""
    world = env.workcell.world
    return bool(world.touched_by(LEFT_PAD) & world.touched_by(RIGHT_PAD))


FAILING: tuple[Play, ...] = (
    ram_the_bench,
    ram_the_bench_at_the_end,
    never_close_the_hand,
    give_up_half_way,
    drop,
    shake_while_holding,
)
"""What a person would fail, whatever the task is."""

PASSING: tuple[Play, ...] = (stretch_first, tremble)
"""What a person would pass, whatever the task is."""
