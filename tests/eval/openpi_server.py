"""A policy server that speaks openpi's protocol, for tests."""

import threading
from collections.abc import Callable
from typing import Any

import msgpack
import numpy as np
from websockets.sync.server import ServerConnection, serve

from labutopia_lerobot.evaluation.remote.openpi_server import unpack

HOME = [0.0, -0.78, 0.0, -2.36, 0.0, 1.57, 0.78, 0.08]
"""Joint angles [rad] and the opening [m] of any position within the limits."""


def openpi_array(array: np.ndarray) -> dict[bytes, Any]:
    """Return what openpi's client makes of an array, written down once more from its protocol."""
    return {
        b"__ndarray__": True,
        b"data": array.tobytes(),
        b"dtype": array.dtype.str,
        b"shape": array.shape,
    }


class OpenPi:
    """A server that speaks openpi's protocol; `answer` may be replaced while it runs."""

    def __init__(self) -> None:
        self.answer: Callable[[dict], bytes | str] = lambda _: self.actions(np.array([HOME] * 5))
        self.seen: list[dict] = []
        self._server = serve(self._talk, "127.0.0.1", 0, compression=None, max_size=None)
        self.address = f"127.0.0.1:{self._server.socket.getsockname()[1]}"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        self._open: list[ServerConnection] = []

    @staticmethod
    def actions(array: np.ndarray) -> bytes:
        return msgpack.packb({"actions": openpi_array(array.astype(np.float32))})

    def _talk(self, connection: ServerConnection) -> None:
        self._open.append(connection)
        connection.send(msgpack.packb({"name": "test"}))
        for message in connection:
            self.seen.append(unpack(message))
            connection.send(self.answer(self.seen[-1]))

    def die(self) -> None:
        self._server.shutdown()
        for connection in self._open:
            connection.socket.close()
