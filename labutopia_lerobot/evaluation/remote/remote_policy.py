"""`policy=remote`: which server, how to ask it, and what to do while it does not answer."""

import socket
import time
from collections import deque
from collections.abc import Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.checkpoint_security import CONFIG, CheckpointError
from labutopia_lerobot.evaluation.config import EvaluationOptionError, PolicyConfig
from labutopia_lerobot.evaluation.find_checkpoint import find_checkpoint
from labutopia_lerobot.evaluation.policies import (
    Action,
    Policy,
    PolicyServerError,
    PolicyUnreachable,
)
from labutopia_lerobot.features import observation_features
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting, require_choices
from labutopia_lerobot.world import CONTROL_HZ


class Server(Protocol):
    """Answers observations with actions. It may connect when it is first asked."""

    def ask(
        self, observation: Mapping[str, NDArray[Any]], instruction: str, timeout_s: float
    ) -> NDArray[np.float32]:
        """Return the next actions, shape (actions, elements).

        Args:
            observation: What the policy calls it -> the array.
            instruction: What to do, in words.
            timeout_s: For how long to wait [s].

        Raises:
            ConnectionError: If the server is not there, or went away.
            TimeoutError: If it does not answer in time.
            PolicyServerError: If it answers that something is wrong.
        """
        ...


def named(
    setting: Setting, names: Mapping[str, str], observation: Observation
) -> dict[str, NDArray[Any]]:
    """Return what is observed under the names that a policy uses.

    Args:
        setting: Options of the environment.
        names: Our key, as in datasets -> what the policy calls it; others keep their key.
        observation: From the environment.
    """
    features = observation_features(setting, lambda: canonical_task(setting))
    return {
        names.get(feature.key, feature.key): _at(observation, path)
        for path, feature in features.items()
    }


def _at(observation: Observation, path: str) -> NDArray[Any]:
    value: Any = observation
    for part in path.split("/"):
        value = value[part]
    array: NDArray[Any] = value
    return array


_RETRY_S = 0.2
"""Pause before a server that is not there is asked again [s]."""


class RemotePolicy:
    """Plays the actions that a server answers with.

    For `patience_s` the simulation stands still for an answer, so that rows of a server that is
    fast enough do not depend on how fast it is. After that time passes, at its real speed, and the
    robot holds its position. An episode begins with its first answer, however long that takes.

    Args:
        server: Who is asked.
        setting: Options of the environment.
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


REMOTE = "remote"
PROTOCOLS = ("lerobot", "openpi")

_IMAGES = "observation.images."
_OPENPI_NAMES = {
    "observation.state": "observation/state",
    "observation.environment_state": "observation/environment_state",
    "observation.images.front": "observation/image",
    "observation.images.wrist": "observation/wrist_image",
}
"""Names of observations in openpi's configurations for LIBERO, its template for own robots."""

_CONNECT_S = 5.0
"""Longest time for a server to accept a first connection [s]."""


@dataclass(frozen=True)
class RemoteServer:
    """A server and how to ask it; calling it makes the policy that does.

    Attributes:
        setting: Task, robot, observation and the other options.
        address: Host and port.
        protocol: One of `PROTOCOLS`.
        path: Where LeRobot's server finds the checkpoint; None for openpi's.
        type: LeRobot's name of the policy; None for openpi's.
        device: Device of torch on LeRobot's server.
        names: Pairs of a key of ours and what the policy calls it.
        actions: How many actions of an answer are played, or None for all of them.
        patience_s: For how long the simulation stands still for an answer [s].
        timeout_s: After how long without an answer an episode is over [s].
    """

    setting: Setting
    address: str
    protocol: str
    path: str | None
    type: str | None
    device: str | None
    names: tuple[tuple[str, str], ...]
    actions: int | None
    patience_s: float
    timeout_s: float

    def __call__(self) -> Policy:
        """Make the policy; it connects when it is first asked."""
        # Here: they import what only those need who ask them.
        server: Server
        if self.protocol == "openpi":
            from labutopia_lerobot.evaluation.remote.openpi_server import OpenPiServer

            server = OpenPiServer(self.address)
        else:
            from labutopia_lerobot.evaluation.remote.lerobot_server import (
                LeRobotServer,
                ServedCheckpoint,
            )

            assert self.path is not None
            assert self.type is not None
            served = ServedCheckpoint(self.path, self.type, self.device or "cpu")
            server = LeRobotServer(self.address, served)
        return RemotePolicy(
            server,
            self.setting,
            dict(self.names),
            self.actions,
            self.patience_s,
            self.timeout_s,
        )


def open_server(policy: PolicyConfig, setting: Setting, workers: int) -> RemoteServer:
    """Make sure, before anything is played, that a server is there and can be asked.

    Args:
        policy: Options of the policy.
        setting: What to play and observe.
        workers: How many processes would ask.

    Raises:
        EvaluationOptionError: If an option is missing or impossible.
        UnknownOptionError: If the protocol is none.
        PolicyServerError: If nobody listens at the address.
    """
    protocol, address = policy.protocol or PROTOCOLS[0], policy.address
    require_choices("policy.protocol", [protocol], PROTOCOLS)
    if address is None:
        raise EvaluationOptionError("Name the server: policy.address=HOST:PORT")
    _require_numbers(policy)
    if protocol == "lerobot":
        _require_playable(policy, setting, workers)
    _require_listener(address)
    names = policy.rename or ({} if protocol == "lerobot" else _OPENPI_NAMES)
    named = [camera for camera in setting.cameras if _IMAGES + camera in names]
    return RemoteServer(
        setting=replace(setting, cameras=tuple(named) or setting.cameras),
        address=address,
        protocol=protocol,
        path=policy.path,
        type=policy.type or (_type(policy, setting) if protocol == "lerobot" else None),
        device=policy.device,
        names=tuple(sorted(names.items())),
        actions=policy.actions,
        patience_s=policy.patience,
        timeout_s=policy.timeout,
    )


def _require_numbers(policy: PolicyConfig) -> None:
    if policy.actions is not None and policy.actions < 1:
        raise EvaluationOptionError(f"policy.actions={policy.actions} is too small: at least 1")
    if not 0.0 <= policy.patience <= policy.timeout:
        raise EvaluationOptionError(
            f"policy.patience={policy.patience:g} must be from 0 s to policy.timeout="
            f"{policy.timeout:g} s"
        )


def _require_playable(policy: PolicyConfig, setting: Setting, workers: int) -> None:
    if policy.path is None:
        raise EvaluationOptionError(
            "LeRobot's server needs to know what to load: policy.path=, a folder of its machine "
            "or a Hub id"
        )
    if setting.obs == "state":
        raise EvaluationOptionError(
            "obs=state cannot be played over LeRobot's server, which takes joints and pictures "
            "only. Leave obs= out"
        )
    if workers > 1:
        raise EvaluationOptionError(
            f"workers={workers} is too many: LeRobot's server keeps one observation for all "
            "clients together. workers=1"
        )


def _require_listener(address: str) -> None:
    host, _, port = address.rpartition(":")
    if not host or not port.isdigit():
        raise EvaluationOptionError(f"policy.address={address} is not HOST:PORT")
    try:
        socket.create_connection((host.strip("[]"), int(port)), _CONNECT_S).close()
    except (OSError, OverflowError) as error:
        raise PolicyServerError(
            f"Nobody listens at policy.address={address}: {error}. Start the server first"
        ) from None


def _type(policy: PolicyConfig, setting: Setting) -> str:
    try:
        folder = find_checkpoint(str(policy.path), None, setting.task, setting.obs)
        kind = read_json_object(folder / CONFIG, CheckpointError).get("type")
    except CheckpointError:
        kind = None
    if not isinstance(kind, str):
        raise EvaluationOptionError(
            f"policy.path={policy.path} is not on this machine: give its type too, as in "
            "policy.type=act"
        )
    return kind
