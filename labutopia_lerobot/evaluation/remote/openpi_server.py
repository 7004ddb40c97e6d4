"""Servers of openpi (`scripts/serve_policy.py`), over a websocket.

The server greets with a message about itself. Then each observation, a flat map of arrays with the
instruction as `prompt`, is answered with a map that has `actions`; with text, where its policy
raised. Messages are MessagePack with NumPy arrays: an array is a map of four entries, with binary
keys: `__ndarray__` (true), `data` (its bytes), `dtype` (NumPy's string for it), `shape`; a scalar
is `__npgeneric__`, `data` and `dtype` (openpi, packages/openpi-client, "msgpack_numpy"). Nothing in
such a message can run code.
"""

import socket
import time
from collections.abc import Mapping
from contextlib import ExitStack
from typing import Any
from urllib.parse import urlsplit

import msgpack
import numpy as np
from numpy.typing import NDArray
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidURI
from websockets.sync.client import ClientConnection, connect

from labutopia_lerobot.evaluation.policies import PolicyServerError
from labutopia_lerobot.foreign_files import printable

_ARRAY, _SCALAR = b"__ndarray__", b"__npgeneric__"
_NUMBERS = "biufSU"
"""Kinds of element that are sent: numbers, truth values, text."""


def pack(content: Any) -> bytes:
    """Return the message of a value made of maps, lists, text, numbers and arrays."""
    message: bytes = msgpack.packb(content, default=_described)
    return message


def unpack(message: bytes) -> Any:
    """Return what a message holds; arrays cannot be written to.

    Raises:
        ValueError: If it is no such message.
    """
    try:
        return msgpack.unpackb(message, object_hook=_restored)
    except (msgpack.UnpackException, KeyError, TypeError) as error:
        raise ValueError(f"no message of openpi: {error}") from None


def _described(value: Any) -> dict[bytes, Any]:
    if not isinstance(value, np.ndarray | np.generic) or value.dtype.kind not in _NUMBERS:
        raise TypeError(f"{type(value).__name__} cannot be sent")
    dtype = value.dtype.str
    if isinstance(value, np.generic):
        return {_SCALAR: True, b"data": value.item(), b"dtype": dtype}
    return {_ARRAY: True, b"data": value.tobytes(), b"dtype": dtype, b"shape": value.shape}


def _restored(entries: dict[Any, Any]) -> Any:
    if _ARRAY not in entries and _SCALAR not in entries:
        return entries
    dtype = np.dtype(entries[b"dtype"])
    if dtype.kind not in _NUMBERS:
        raise ValueError(f"no message of openpi: elements of type {dtype}")
    if _SCALAR in entries:
        return dtype.type(entries[b"data"])
    return np.frombuffer(entries[b"data"], dtype).reshape(entries[b"shape"])


_LARGEST = 64_000_000
"""Bytes of an answer: 10,000 actions of 100 numbers have a tenth of that."""

_MOST_LINES = 100
"""Most lines that are shown of a server's error."""

_CLOSE_S = 1.0
"""Longest time for a server to say goodbye [s]."""


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
                f"The policy raised in the server at {self._address}:\n{_message_of(answer)}"
            )
        return self._actions(answer)

    def _connected(self, deadline: float) -> ClientConnection:
        if self._connection is None:
            try:
                connecting = connect(
                    f"ws://{self._address}",
                    # With a socket of ours no redirect to another machine is followed.
                    sock=_socket(self._address, deadline),
                    open_timeout=_left(deadline),
                    close_timeout=_CLOSE_S,
                    compression=None,
                    max_size=_LARGEST,
                    proxy=None,
                    # A server that is busy with its policy may not answer pings for a while.
                    ping_interval=None,
                )
                self._connection = self._closing.enter_context(connecting)
            except (InvalidURI, ValueError) as error:
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


def _socket(address: str, deadline: float) -> socket.socket:
    parts = urlsplit(f"//{address}")
    return socket.create_connection((parts.hostname or "", parts.port or 80), _left(deadline))


def _message_of(answer: str) -> str:
    """Return the words of a server, without codes that a terminal would obey."""
    return "\n".join(printable(line) for line in answer.splitlines()[:_MOST_LINES])


def _left(deadline: float) -> float:
    return max(deadline - time.monotonic(), 0.01)
