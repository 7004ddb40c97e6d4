"""Several environments of one task, played together. Imports no torch."""

import multiprocessing
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from types import ModuleType
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv, Observation
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.setting import Setting

type Flags = NDArray[np.bool_]
type Actions = NDArray[np.float32]
type Transition = tuple[Observation, SupportsFloat, bool, bool, Info]


class FreezeWhenOver(gymnasium.Wrapper[Observation, Actions, Observation, Actions]):
    """Holds still from the end of an episode until somebody asks for a new one.

    Gymnasium goes on stepping a vector's ended members, and resets them itself by a `reset` without
    arguments. Both replay the end here, with reward 0, so that waiting for the slowest member costs
    nothing. A `reset` with a seed or with options, be they empty, begins the next episode.

    A mistake in a task of the user's that shows in play is reported with its file and line.
    """

    def __init__(self, env: LabEnv) -> None:
        super().__init__(env)
        self._setting = env.setting
        self._end: Transition | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, Info]:
        """Begin an episode, or replay the end if there are no arguments."""
        if self._end is not None and seed is None and options is None:
            observation, *_, info = self._end
            return observation, info
        self._end = None
        with located_in_play(self._setting.task, self._setting.tasks_dir):
            return self.env.reset(seed=seed, options=options)

    def step(self, action: Actions) -> Transition:
        """Step, or replay the end."""
        if self._end is not None:
            return self._end
        with located_in_play(self._setting.task, self._setting.tasks_dir):
            transition = observation, _, terminated, truncated, info = self.env.step(action)
        if terminated or truncated:
            self._end = observation, 0.0, terminated, truncated, info
        return transition


class LabVectorEnv(VectorEnv[Observation, Actions, NDArray[Any]]):
    """Environments of one task that start and step together.

    What an episode does depends on its seed alone, not on how many are played or where. A member
    whose episode is over stays over, at no cost, until `reset`. Nothing starts before it is needed,
    and after `close` it starts again when it is needed again: LeRobot plays one task after another.

    Args:
        setting: Task, robot, observation and the other options.
        num_envs: How many.
        asynchronous: Each in a worker process of its own, or one after another in this process.

    Raises:
        UserError: If the task cannot be played in this setting.
    """

    def __init__(self, setting: Setting, num_envs: int, asynchronous: bool = True) -> None:
        self.num_envs = num_envs
        self._asynchronous = asynchronous
        self._make_member = partial(_make_member, setting)
        self._members: AsyncVectorEnv | SyncVectorEnv | None = None
        example = LabEnv(setting)
        self.metadata = example.metadata | {"autoreset_mode": AutoresetMode.DISABLED}
        self.render_mode = example.render_mode
        self.single_observation_space = example.observation_space
        self.single_action_space = example.action_space
        self.observation_space = batch_space(example.observation_space, num_envs)
        self.action_space = batch_space(example.action_space, num_envs)
        self._terminated: Flags = np.zeros(num_envs, dtype=bool)
        self._truncated: Flags = np.zeros(num_envs, dtype=bool)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Observation, Info]:
        """Begin an episode in every member; a number seeds them with seed, seed + 1, ...

        Gymnasium's option `reset_mask`, shape (num_envs,), names the members that begin anew; the
        others stay as they are.
        """
        begin = (options or {}).get("reset_mask", slice(None))
        self._terminated[begin] = self._truncated[begin] = False
        return self._ensure().reset(seed=seed, options=dict(options or {}))

    def step(self, actions: Actions) -> tuple[Observation, NDArray[Any], Flags, Flags, Info]:
        """Step every member whose episode is not over; the others return their end, reward 0."""
        observations, rewards, terminated, truncated, infos = self._ensure().step(actions)
        self._terminated |= terminated
        self._truncated |= truncated
        return observations, rewards, self._terminated.copy(), self._truncated.copy(), infos

    def render(self) -> tuple[NDArray[np.uint8], ...]:
        """Return the present picture of each member's first camera, (height, width, 3)."""
        return self.call("render")

    def call(self, name: str, *args: Any, **kwargs: Any) -> tuple[Any, ...]:
        """Return each member's attribute of this name, called if it can be."""
        return self._ensure().call(name, *args, **kwargs)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """Return each member's attribute of this name."""
        return self._ensure().get_attr(name)

    def close(self, **kwargs: Any) -> None:
        """End the workers and give the OpenGL contexts back."""
        if self._members is not None:
            self._members.close(**kwargs)
            self._members = None

    def _ensure(self) -> AsyncVectorEnv | SyncVectorEnv:
        """Start the members if they are not running; LeRobot calls this ahead of time."""
        if self._members is None:
            makers = [self._make_member] * self.num_envs
            self._members = _start_workers(makers) if self._asynchronous else SyncVectorEnv(makers)
        return self._members


def _make_member(setting: Setting) -> FreezeWhenOver:
    if multiprocessing.parent_process() is not None:
        # One process per core draws faster than Mesa's threads, which would share the cores.
        os.environ.setdefault("LP_NUM_THREADS", "1")
    return FreezeWhenOver(LabEnv(setting))


def _start_workers(makers: list[partial[FreezeWhenOver]]) -> AsyncVectorEnv:
    # The server imports MuJoCo once, and every worker is a fork of it.
    multiprocessing.set_forkserver_preload(["labutopia_lerobot.vector"])
    with _main_module_hidden():
        return AsyncVectorEnv(makers, context="forkserver", shared_memory=True)


@contextmanager
def _main_module_hidden() -> Iterator[None]:
    """Keep new workers from importing the program's main module.

    They need nothing from it, and where it is LeRobot's it brings torch: seconds for each worker.
    """
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main
