"""Playing episodes for checks: the expert, doing nothing, random actions."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv, Observation

type Actor = Callable[[], NDArray[np.float32]]
"""Returns the next action."""

type Player = Callable[[LabEnv], Actor]
"""Begins an episode of an environment that has been reset."""

type Trace = list[tuple[Observation, Info]]
"""What reset and every step gave."""


def play(env: LabEnv, player: Player, seed: int) -> Trace:
    """Play an episode to its end; return what reset and every step gave."""
    trace: Trace = [env.reset(seed=seed)]
    act = player(env)
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(act())
        trace.append((observation, info))
        over = terminated or truncated
    return trace


def expert(env: LabEnv) -> Actor:
    """Play the task's expert."""
    script = env.expert()
    script.start()
    return script.act


def still(env: LabEnv) -> Actor:
    """Repeat the command in force."""
    command = env.workcell.simulation.command.astype(np.float32)
    return lambda: command


def random_walk(env: LabEnv) -> Actor:
    """Draw every action from the whole box."""
    rng: np.random.Generator = np.random.default_rng(env.seed)
    space: Any = env.action_space
    return lambda: rng.uniform(space.low, space.high).astype(np.float32)
