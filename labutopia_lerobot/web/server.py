"""Serves a viewer to browsers on this machine: its page, moments, and what buttons say."""

import errno
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.web.showing import Stage

LOOPBACK = "127.0.0.1"
"""The only address that it listens on: nobody else's machine can reach it."""
_NAMES = (LOOPBACK, "localhost")
"""What a browser may call this machine; another name would be a stranger's page that was let to
point here."""
_WAIT_S = 10.0
"""Longest time that a browser waits for the next moment before it asks again [s]."""
_LONGEST = 1000
"""Bytes of a command at most."""


class PortError(UserError, OSError):
    """A port that cannot be had; the message says the cure."""


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, port: int, stage: Stage) -> None:
        self.stage = stage
        self.page = (Path(__file__).parent / "page.html").read_bytes()
        super().__init__((LOOPBACK, port), _Handler)


@contextmanager
def served(port: int, stage: Stage) -> Iterator[str]:
    """Serve a stage while the body runs.

    Args:
        port: Where; 0 for any that is free.
        stage: Who has the moments and takes the commands.

    Yields:
        The address, such as `http://127.0.0.1:8080`.

    Raises:
        PortError: If the port cannot be had.
    """
    try:
        server = _Server(port, stage)
    except OSError as error:
        reason = "in use" if error.errno == errno.EADDRINUSE else f"refused ({error.strerror})"
        raise PortError(
            f"Port {port} is {reason}: choose another with --port, such as --port {port + 1}, or "
            "--port 0 for any that is free"
        ) from None
    threading.Thread(target=server.serve_forever, args=(0.1,), daemon=True).start()
    try:
        yield f"http://{LOOPBACK}:{server.server_address[1]}"
    finally:
        server.shutdown()
        server.server_close()


class _Handler(BaseHTTPRequestHandler):
    """Answers one browser."""

    server: _Server
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        """Answer with the page, with what can be chosen, or with the next moment."""
        address = urlsplit(self.path)
        if not self._is_of_this_machine():
            self._answer(HTTPStatus.FORBIDDEN, "text/plain", b"only for this machine")
        elif address.path == "/":
            self._answer(HTTPStatus.OK, "text/html; charset=utf-8", self.server.page)
        elif address.path == "/choices":
            choices = json.dumps(self.server.stage.choices).encode()
            self._answer(HTTPStatus.OK, "application/json", choices)
        elif address.path == "/moment":
            number = parse_qs(address.query).get("after", [""])[0]
            known = int(number) if number.isdecimal() and len(number) < 18 else -1
            moment = self.server.stage.after(known, _WAIT_S)
            status = HTTPStatus.NO_CONTENT if moment is None else HTTPStatus.OK
            self._answer(status, "application/json", moment or b"")
        else:
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is only /")

    def do_POST(self) -> None:
        """Take a command, as JSON."""
        length = self.headers.get("Content-Length", "")
        wanted = self.headers.get_content_type() == "application/json" and self.path == "/do"
        size = int(length) if length.isdecimal() and len(length) < 9 else _LONGEST + 1
        if not (self._is_of_this_machine() and wanted and size <= _LONGEST):
            self.close_connection = True
            self._answer(HTTPStatus.BAD_REQUEST, "text/plain", b"no command")
            return
        try:
            command = json.loads(self.rfile.read(size))
        except (ValueError, RecursionError):
            command = None
        if not isinstance(command, dict):
            self._answer(HTTPStatus.BAD_REQUEST, "text/plain", b"no command")
            return
        self.server.stage.commands.put(command)
        self._answer(HTTPStatus.NO_CONTENT, "text/plain", b"")

    def _is_of_this_machine(self) -> bool:
        host = self.headers.get("Host", "").rpartition(":")
        return (host[0] or host[2]) in _NAMES

    def _answer(self, status: HTTPStatus, kind: str, content: bytes) -> None:
        try:
            self.send_response(status)
            self.send_header("Content-Type", kind)
            if status is not HTTPStatus.NO_CONTENT:
                self.send_header("Content-Length", str(len(content)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("Content-Security-Policy", _POLICY)
            self.end_headers()
            self.wfile.write(content)
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True  # the browser has left; it may come back

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing: the terminal is the user's."""


_POLICY = "default-src 'none'; connect-src 'self'; img-src data:; " + (
    "style-src 'unsafe-inline'; script-src 'unsafe-inline'"
)
"""What the page may load: nothing but what is here."""
