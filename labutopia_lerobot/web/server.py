"""Serves a site to browsers on this machine, and to nobody else."""

import errno
import json
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, Protocol
from urllib.parse import urlsplit

from labutopia_lerobot.errors import UserError

LOOPBACK = "127.0.0.1"
"""The only address that it listens on: nobody else's machine can reach it."""
_NAMES = (LOOPBACK, "localhost")
"""What a browser may call this machine; another name would be a stranger's page that was let to
point here."""
_LONGEST = 1000
"""Bytes of a command at most."""


class PortError(UserError, OSError):
    """A port that cannot be had; the message says the cure."""


@dataclass(frozen=True)
class Answer:
    """What a browser gets.

    Attributes:
        kind: As MIME has it, such as `text/html`.
        content: Empty if there is nothing yet.
    """

    kind: str
    content: bytes


class Site(Protocol):
    """A site: what lies where, and what its pages may say.

    Attributes:
        may_load: What its pages may load beside themselves, as directives of a
            Content-Security-Policy.
    """

    may_load: str

    def get(self, path: str, query: str) -> Answer | None:
        """Return what lies at a path; None if nothing does."""
        ...

    def take(self, command: Mapping[str, Any]) -> bool:
        """Take what a button of the page says; false if the site has no buttons."""
        ...


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, port: int, site: Site) -> None:
        self.site = site
        super().__init__((LOOPBACK, port), _Handler)


@contextmanager
def served(port: int, site: Site) -> Iterator[str]:
    """Serve a site while the body runs.

    Args:
        port: Where; 0 for any that is free.
        site: What.

    Yields:
        The address, such as `http://127.0.0.1:8080`.

    Raises:
        PortError: If the port cannot be had.
    """
    try:
        server = _Server(port, site)
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
        """Answer with what lies at the address."""
        address = urlsplit(self.path)
        if not self._is_of_this_machine():
            self._answer(HTTPStatus.FORBIDDEN, "text/plain", b"only for this machine")
            return
        found = self.server.site.get(address.path, address.query)
        if found is None:
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there is only /")
        else:
            status = HTTPStatus.OK if found.content else HTTPStatus.NO_CONTENT
            self._answer(status, found.kind, found.content)

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
        if isinstance(command, dict) and self.server.site.take(command):
            self._answer(HTTPStatus.NO_CONTENT, "text/plain", b"")
        else:
            self._answer(HTTPStatus.BAD_REQUEST, "text/plain", b"no command")

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
            policy = f"default-src 'none'; {self.server.site.may_load}"
            self.send_header("Content-Security-Policy", policy)
            self.end_headers()
            self.wfile.write(content)
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True  # the browser has left; it may come back

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing: the terminal is the user's."""
