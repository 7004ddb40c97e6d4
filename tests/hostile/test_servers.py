"""Policy servers that somebody made to do harm."""

import pickle
import socket
import threading
from collections.abc import Iterator

import msgpack
import numpy as np
import pytest
import torch
from websockets.sync.server import ServerConnection, serve

from labutopia_lerobot.evaluation.policies import PolicyServerError
from labutopia_lerobot.evaluation.remote.lerobot_server import read_actions
from labutopia_lerobot.evaluation.remote.openpi_server import OpenPiServer

OBSERVATION = {"observation/state": np.zeros(8, np.float32)}


class Answering:
    """A server that greets and answers every observation alike."""

    def __init__(self, answer: bytes | str) -> None:
        self._answer = answer
        self._server = serve(self._talk, "127.0.0.1", 0, compression=None, max_size=None)
        self.address = f"127.0.0.1:{self._server.socket.getsockname()[1]}"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _talk(self, connection: ServerConnection) -> None:
        connection.send(msgpack.packb({}))
        for _ in connection:
            connection.send(self._answer)

    def stop(self) -> None:
        self._server.shutdown()


def refusal(answer: bytes | str) -> str:
    """Return what is said of a server that answers so."""
    server = Answering(answer)
    try:
        with pytest.raises((PolicyServerError, ConnectionError)) as refused:
            OpenPiServer(server.address).ask(OBSERVATION, "pick", timeout_s=5.0)
    finally:
        server.stop()
    return str(refused.value)


@pytest.fixture
def other() -> Iterator[socket.socket]:
    """A machine that nobody named."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.settimeout(0.5)
        yield listening


def test_nobody_is_sent_to_another_machine(other: socket.socket) -> None:
    place = f"ws://127.0.0.1:{other.getsockname()[1]}/"
    answer = f"HTTP/1.1 302 Found\r\nLocation: {place}\r\nContent-Length: 0\r\n\r\n".encode()

    def redirect(listening: socket.socket) -> None:
        connection, _ = listening.accept()
        connection.recv(65536)
        connection.sendall(answer)
        connection.close()

    with socket.create_server(("127.0.0.1", 0)) as listening:
        threading.Thread(target=redirect, args=(listening,), daemon=True).start()
        server = OpenPiServer(f"127.0.0.1:{listening.getsockname()[1]}")
        with pytest.raises((PolicyServerError, ConnectionError)):
            server.ask(OBSERVATION, "pick", timeout_s=5.0)
    with pytest.raises(TimeoutError):
        other.accept()


def test_an_answer_without_end_is_refused() -> None:
    assert refusal(bytes(100_000_000))


def test_words_of_a_server_are_no_codes_of_the_terminal() -> None:
    reported = refusal("it failed \x1b]0;owned\x07 \x1b[31mred")
    assert "it failed" in reported
    assert "\x1b" not in reported
    assert "\x07" not in reported


def tensor(size: tuple[int, ...], stride: tuple[int, ...], offset: int = 0) -> bytes:
    """Return a pickle of a list of actions whose tensor claims this form, of eight numbers."""
    from lerobot.async_inference.helpers import TimedAction

    class Claim:
        def __reduce__(self) -> tuple[object, ...]:
            storage = torch.zeros(8).storage()
            return torch._utils._rebuild_tensor_v2, (storage, offset, size, stride, False, {})

    action = TimedAction(timestamp=0.0, timestep=0, action=torch.zeros(8))
    action.action = Claim()  # type: ignore[assignment]
    return pickle.dumps([action])


@pytest.mark.parametrize(
    "claim",
    [
        ((800,), (1,)),
        ((10**12,), (0,)),
        ((8,), (2,)),
        ((8,), (1,), 1),
        ((8,), (-1,)),
        ((-8,), (1,)),
    ],
)
def test_numbers_that_nobody_sent_are_no_actions(claim: tuple[object, ...]) -> None:
    with pytest.raises(PolicyServerError):
        read_actions(tensor(*claim))  # type: ignore[arg-type]


def test_an_honest_tensor_is_read() -> None:
    assert read_actions(tensor((8,), (1,))).shape == (1, 8)
