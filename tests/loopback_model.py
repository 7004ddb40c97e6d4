"""A language model's server on loopback, as good or bad as a test wants. Standard library only."""

import json
import threading
from collections.abc import Callable
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

type Behaviour = Callable[["Handler"], None]


class LoopbackModel(ThreadingHTTPServer):
    """Use it with `with`. Each behaviour answers one question, the last all that follow."""

    daemon_threads = True

    def __init__(self, *behaviours: Behaviour) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server_address[1]}/v1"
        self.behaviours = behaviours
        self.requests: list[tuple[dict[str, str], Any]] = []
        self.ending = threading.Event()

    def __enter__(self) -> "LoopbackModel":
        threading.Thread(target=self.serve_forever, args=(0.01,), daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.ending.set()
        self.shutdown()
        self.server_close()


class Handler(BaseHTTPRequestHandler):
    server: LoopbackModel

    def do_POST(self) -> None:
        content = self.rfile.read(int(self.headers["Content-Length"]))
        seen = self.server.requests
        headers = {key.lower(): value for key, value in self.headers.items()}
        seen.append((headers, json.loads(content)))
        behaviour = self.server.behaviours[min(len(seen), len(self.server.behaviours)) - 1]
        with suppress(OSError):  # nobody listens any more
            behaviour(self)

    def log_message(self, *_: object) -> None:
        pass

    def send(self, status: int, content: bytes, **headers: str) -> None:
        self.send_response(status)
        for name, value in {"Content-Length": str(len(content)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)


def says(text: str) -> Behaviour:
    """Answer with these words of the model."""
    message = {"role": "assistant", "content": text}
    choice = {"index": 0, "finish_reason": "stop", "message": message}
    return lambda handler: handler.send(200, json.dumps({"choices": [choice]}).encode())


def sends(status: int, content: bytes, **headers: str) -> Behaviour:
    """Answer with these bytes."""
    return lambda handler: handler.send(status, content, **headers)


def is_silent(handler: Handler) -> None:
    handler.server.ending.wait(60)


def drips_headers(handler: Handler) -> None:
    handler.wfile.write(b"HTTP/1.1 200 OK\r\nX-Slow: ")
    while not handler.server.ending.wait(0.02):
        handler.wfile.write(b"x")


def drips_without_end(handler: Handler) -> None:
    handler.wfile.write(b"HTTP/1.1 200 OK\r\n\r\n")
    while not handler.server.ending.wait(0.02):
        handler.wfile.write(b" ")


def floods(handler: Handler) -> None:
    handler.wfile.write(b"HTTP/1.1 200 OK\r\n\r\n")
    while not handler.server.ending.is_set():
        handler.wfile.write(bytes(65536))


def hangs_up(handler: Handler) -> None:
    handler.connection.close()
