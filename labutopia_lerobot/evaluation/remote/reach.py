"""`policy=remote`: which server, and how to ask it."""

import socket
from dataclasses import dataclass, replace

from labutopia_lerobot.evaluation.checkpoint_folder import find_checkpoint
from labutopia_lerobot.evaluation.config import EvaluationOptionError, PolicyConfig
from labutopia_lerobot.evaluation.harmless import CONFIG, CheckpointError
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.policies import Policy
from labutopia_lerobot.evaluation.remote.server import PolicyServerError, Server
from labutopia_lerobot.setting import Setting, require_choices

REMOTE = "remote"
PROTOCOLS = ("lerobot", "openpi")

_IMAGES = "observation.images."
_OPENPI_NAMES = {
    "observation.state": "observation/state",
    "observation.environment_state": "observation/environment_state",
    "observation.images.front": "observation/image",
    "observation.images.wrist": "observation/wrist_image",
}
"""What openpi's configurations for LIBERO, its template for own robots, call what is observed."""

_CONNECT_S = 5.0
"""How long a server may take to accept a first connection [s]."""


@dataclass(frozen=True)
class RemoteServer:
    """A server and how to ask it; calling it makes the policy that does.

    Attributes:
        setting: What is played and observed.
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
        # Here: both import what only those need who ask servers.
        from labutopia_lerobot.evaluation.remote.policy import RemotePolicy

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


def reach(policy: PolicyConfig, setting: Setting, workers: int) -> RemoteServer:
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
            "LeRobot's server is told what to load: policy.path=, a folder of its machine or a "
            "Hub id"
        )
    if setting.obs == "state":
        raise EvaluationOptionError(
            "obs=state cannot be played over LeRobot's server, which takes joints and pictures "
            "only. Leave obs= out"
        )
    if workers > 1:
        raise EvaluationOptionError(
            f"workers={workers} is too many: LeRobot's server keeps one observation, whoever sent "
            "it. workers=1"
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
            f"policy.path={policy.path} is not on this machine: tell its type too, as in "
            "policy.type=act"
        )
    return kind
