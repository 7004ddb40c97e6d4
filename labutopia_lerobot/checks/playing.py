"""Playing episodes for checks: their starts, the expert, doing nothing, random actions."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv, Observation
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.world import FloatArray


class Actor(Protocol):
    """Something that acts in an episode, such as a task's expert."""

    def act(self) -> NDArray[np.float32]:
        """Return the next action, shape (elements,)."""
        ...


type Player = Callable[[LabEnv], Actor]
"""Begins an episode of an environment that has been reset."""


@dataclass(frozen=True)
class Played:
    """An episode that was played to its end.

    Attributes:
        trace: What reset and every step gave.
        set_points: What the servos were given, shape (physics steps, elements), radians or metres.
        torques: What the joints' servos gave, shape (physics steps, joints), N m.
        state: Where the simulation ended, as bytes.
        actor: Who played it.
    """

    trace: list[tuple[Observation, Info]]
    set_points: FloatArray
    torques: FloatArray
    state: bytes
    actor: Actor


@dataclass(frozen=True)
class Start:
    """What an episode begins with.

    Attributes:
        observation: What reset gave.
        info: The same.
        goal: Whether the whole goal holds.
        deepest: Least distance of a contact, negative where bodies overlap [m].
    """

    observation: Observation
    info: Info
    goal: bool
    deepest: float


@lru_cache(maxsize=8)
def start(env: LabEnv, seed: int, /) -> Start:
    """Begin an episode; several checks look at the same start."""
    observation, info = env.reset(seed=seed)
    goal = all(info["facts"][fact.name] for fact in env.workcell.task.goal)
    deepest = env.workcell.simulation.data.contact.dist.min(initial=0.0)
    return Start(observation, info, goal, float(deepest))


@lru_cache(maxsize=8)
def play(env: LabEnv, player: Player, seed: int, /) -> Played:
    """Play an episode to its end; several checks look at the same one."""
    trace = [env.reset(seed=seed)]
    simulation, actor = env.workcell.simulation, player(env)
    model, robot = simulation.scene.model, simulation.scene.robot
    servos = [model.actuator(joint.name).id for joint in robot.joints]
    torques, points = [], [simulation.set_points]
    simulation.watch = lambda: torques.append(simulation.data.actuator_force[servos])
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(actor.act())
        trace.append((observation, info))
        points.append(simulation.set_points)
        over = terminated or truncated
    simulation.watch = None
    state = simulation.state().tobytes()
    return Played(trace, np.concatenate(points), np.array(torques), state, actor)


def expert(env: LabEnv) -> Expert:
    """Begin to play the task's expert."""
    script = env.expert()
    script.start()
    return script


@dataclass(frozen=True)
class _Repeating:
    """Repeats a command, shape (elements,)."""

    command: NDArray[np.float32]

    def act(self) -> NDArray[np.float32]:
        return self.command


def still(env: LabEnv) -> Actor:
    """Repeat the command in force."""
    return _Repeating(env.workcell.simulation.command.astype(np.float32))


@dataclass(frozen=True)
class _RandomActions:
    """Draws every action from a space."""

    space: Any
    rng: np.random.Generator

    def act(self) -> NDArray[np.float32]:
        drawn: FloatArray = self.rng.uniform(self.space.low, self.space.high)
        return drawn.astype(np.float32)


def random_walk(env: LabEnv) -> Actor:
    """Draw every action from the whole box."""
    return _RandomActions(env.action_space, np.random.default_rng(env.seed))
