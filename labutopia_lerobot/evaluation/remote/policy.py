"""A policy somewhere else: ask, wait, hold the position meanwhile, give up in the end."""

import time
from collections import deque
from collections.abc import Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.policies import Action, PolicyUnreachable
from labutopia_lerobot.evaluation.remote.server import PolicyServerError, Server, named
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import CONTROL_HZ

_RETRY_S = 0.2
"""Pause before a server that is not there is asked again [s]."""


class RemotePolicy:
    """Plays the actions that a server answers with.

    For `patience_s` the simulation stands still for an answer, so that rows of a server that is
    fast enough do not depend on how fast it is. After that time passes, at its real speed, and the
    robot holds its position. An episode begins with its first answer, however long that takes.

    Args:
        server: Who is asked.
        setting: What is observed.
        names: Our key -> what the policy calls it.
        actions: How many actions of an answer are played, or None for all of them.
        patience_s: For how long the simulation stands still for an answer [s].
        timeout_s: After how long without an answer the episode is over [s].
    """

    def __init__(
        self,
        server: Server,
        setting: Setting,
        names: Mapping[str, str],
        actions: int | None,
        patience_s: float,
        timeout_s: float,
    ) -> None:
        self._server, self._setting, self._names = server, setting, names
        self._actions, self._patience_s, self._timeout_s = actions, patience_s, timeout_s
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="policy server")
        self._answer: Future[NDArray[np.float32]] | None = None
        self._queue: deque[Action] = deque()

    def start(self, env: LabEnv, seed: int) -> None:
        """Forget the previous episode, and what is still to come of it."""
        if self._answer is not None:
            wait([self._answer])
        self._answer = None
        self._queue.clear()
        self._instruction = env.task_description
        self._position: Action = env.workcell.simulation.command.astype(np.float32)
        self._begun = False

    def act(self, observation: Observation) -> Action:
        """Return the next action, or once more the last one while the next has not come.

        Raises:
            PolicyUnreachable: If it does not come at all.
            PolicyServerError: If the policy raised, or answers with something else than actions.
        """
        if not self._queue:
            self._queue.extend(self._next_actions(observation))
        if self._queue:
            self._position = self._queue.popleft()
        return self._position.copy()

    def _next_actions(self, observation: Observation) -> NDArray[np.float32]:
        """Return what an answer brings, or nothing yet, shape (actions, elements)."""
        patience_s = 1.0 / CONTROL_HZ
        if self._answer is None:
            arrays = named(self._setting, self._names, observation)
            deadline = time.monotonic() + self._timeout_s
            self._answer = self._thread.submit(self._ask, arrays, self._instruction, deadline)
            patience_s = self._patience_s if self._begun else self._timeout_s + _RETRY_S
        wait([self._answer], patience_s)
        if not self._answer.done():
            return np.empty((0, self._position.size), np.float32)
        answer, self._answer, self._begun = self._answer, None, True
        return self._playable(answer.result())

    def _ask(
        self, observation: Mapping[str, NDArray[Any]], instruction: str, deadline: float
    ) -> NDArray[np.float32]:
        while True:
            left_s = deadline - time.monotonic()
            try:
                return self._server.ask(observation, instruction, max(left_s, _RETRY_S))
            except (ConnectionError, TimeoutError) as error:
                if time.monotonic() + _RETRY_S >= deadline:
                    raise PolicyUnreachable(str(error)) from None
            time.sleep(_RETRY_S)

    def _playable(self, actions: NDArray[np.float32]) -> NDArray[np.float32]:
        elements = self._position.size
        if actions.ndim != 2 or actions.shape[1] != elements or not len(actions):
            raise PolicyServerError(
                f"The server answers with actions of shape {actions.shape}; this robot takes "
                f"(any number, {elements})"
            )
        return actions[: self._actions]
