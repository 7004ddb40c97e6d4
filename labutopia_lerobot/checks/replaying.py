"""Checks that the same comes again, and that what is observed is one's own."""

from itertools import pairwise

import numpy as np

from labutopia_lerobot.checks.playing import expert, play, random_walk, still
from labutopia_lerobot.checks.require import require
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario.privileged_state import (
    HOME_NAMES,
    SIZE_NAMES,
    environment_state_names,
)
from labutopia_lerobot.world import SOLUTION_NAMES, FloatArray


def same_seed_gives_the_same_trajectory_bit_for_bit(env: LabEnv) -> None:
    """Also after another episode has been played in between."""

    def states() -> list[bytes]:
        env.reset(seed=7)
        walk = random_walk(env)
        result = [env.workcell.simulation.state().tobytes()]
        for _ in range(30):
            env.step(walk.act())
            result.append(env.workcell.simulation.state().tobytes())
        return result

    first = states()
    env.reset(seed=8)
    pause = still(env)
    for _ in range(30):
        env.step(pause.act())
    differing = [
        step for step, pair in enumerate(zip(first, states(), strict=True)) if len(set(pair)) > 1
    ]
    require(not differing, f"states differ from step {differing[:1]} on")


def recorded_actions_replayed_open_loop_give_the_same_states(env: LabEnv) -> None:
    """Check that the recorded action is the one that acted."""
    played = play(env, expert, 100)
    actions = [info["applied_action"] for _, info in played.trace[1:]]
    env.reset(seed=100)
    for action in actions:
        _, _, _, _, info = env.step(action)
    require(info["is_success"], f"the expert's actions with seed 100 end with {info['outcome']}")
    same = env.workcell.simulation.state().tobytes() == played.state
    require(same, "the expert's actions, replayed, end in another state")


def observations_are_in_space_own_their_memory_and_vary(env: LabEnv) -> None:
    """Nothing that was handed out changes later, and every number that should move does."""
    observations = [observation for observation, _ in play(env, expert, 100).trace]
    inside = all(env.observation_space.contains(observation) for observation in observations)
    require(inside, "an observation is not in the observation space")
    for key in ("agent_pos", "environment_state"):
        values = [observation[key] for observation in observations]
        shared = any(np.shares_memory(a, b) for a, b in pairwise(values))
        require(not shared, f"{key} of two steps shares memory")
        varies = np.ptp(np.stack(values), axis=0) > 0.0
        if key == "environment_state":
            varies = varies[_of_moved_things(env, np.stack(values))]
        require(varies.all(), f"elements {np.flatnonzero(~varies)} of {key} never change")


def _of_moved_things(env: LabEnv, states: FloatArray) -> list[int]:
    """Return which elements of `environment_state` belong to things that move by a millimetre.

    Without where they stood, their sizes, and what is about their contents, which stay as they are
    where nothing is poured in. Before a robot that drives all moves: of that what it handles.
    """
    names = environment_state_names(env.workcell.task, env.setting.hidden)
    moves = dict(zip(names, np.ptp(states, axis=0) > 1e-3, strict=True))
    task = env.workcell.task
    handled = {thing.name for step in task.steps for thing in step.touches}
    things = [piece.name for piece in task.start if not task.drives or piece.name in handled]
    moved = tuple(f"{name}." for name in things if any(moves[f"{name}.{axis}"] for axis in "xyz"))
    still = tuple(f".{name}" for name in ("fill", *HOME_NAMES, *SIZE_NAMES, *SOLUTION_NAMES))
    return [
        index
        for index, name in enumerate(names)
        if name.startswith(moved) and not name.endswith(still)
    ]


CHECKS = (
    same_seed_gives_the_same_trajectory_bit_for_bit,
    recorded_actions_replayed_open_loop_give_the_same_states,
    observations_are_in_space_own_their_memory_and_vary,
)
