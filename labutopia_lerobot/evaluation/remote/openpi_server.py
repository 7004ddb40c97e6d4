"""Servers of openpi (`scripts/serve_policy.py`), over a websocket.

The server greets with a message about itself. Then each observation, a flat map of arrays with the
instruction as `prompt`, is answered with a map that has `actions`; with text, where its policy
raised.
"""

import time
from collections.abc import Mapping
from contextlib import ExitStack
from typing import Any

import numpy as np
from numpy.typing import NDArray
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidURI
from websockets.sync.client import ClientConnection, connect

from labutopia_lerobot.evaluation.remote.array_messages import pack, unpack
from labutopia_lerobot.evaluation.remote.server import PolicyServerError

_CLOSE_S = 1.0
"""How long a server may take to say goodbye [s]."""


class OpenPiServer:
    """A client of the server.

    Args:
        address: Host and port.
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._connection: ClientConnection | None = None
        self._closing = ExitStack()

    def ask(
        self, observation: Mapping[str, NDArray[Any]], instruction: str, timeout_s: float
    ) -> NDArray[np.float32]:
        """Return the next actions; see `Server`."""
        deadline = time.monotonic() + timeout_s
        try:
            connection = self._connected(deadline)
            connection.send(pack({**observation, "prompt": instruction}))
            answer = connection.recv(timeout=_left(deadline))
        except (OSError, ConnectionClosed, InvalidHandshake) as error:
            self._close()
            if isinstance(error, TimeoutError):
                raise TimeoutError(f"{self._address} does not answer") from None
            raise ConnectionError(f"{self._address} cannot be reached: {error}") from None
        if isinstance(answer, str):
            self._close()
            raise PolicyServerError(
                f"The policy raised in the server at {self._address}:\n{answer}"
            )
        return self._actions(answer)

    def _connected(self, deadline: float) -> ClientConnection:
        if self._connection is None:
            try:
                connecting = connect(
                    f"ws://{self._address}",
                    open_timeout=_left(deadline),
                    close_timeout=_CLOSE_S,
                    compression=None,
                    max_size=None,
                    # A server that is busy with its policy may not answer pings for a while.
                    ping_interval=None,
                )
                self._connection = self._closing.enter_context(connecting)
            except InvalidURI as error:
                raise PolicyServerError(f"policy.address={self._address}: {error}") from None
            self._connection.recv(timeout=_left(deadline))
        return self._connection

    def _close(self) -> None:
        self._closing.close()
        self._connection = None

    def _actions(self, answer: bytes) -> NDArray[np.float32]:
        try:
            return np.asarray(unpack(answer)["actions"], np.float32)
        except (KeyError, TypeError, ValueError) as error:
            raise PolicyServerError(
                f"The server at {self._address} does not answer as openpi's do: {error}"
            ) from None


def _left(deadline: float) -> float:
    return max(deadline - time.monotonic(), 0.01)
