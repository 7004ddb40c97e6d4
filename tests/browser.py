"""A headless Chromium that a test looks at a page with, through its debugging protocol."""

import base64
import json
import re
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.sync.client import ClientConnection, connect

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
needs_browser = pytest.mark.skipif(
    BROWSER is None, reason="no Chromium here: scripts/install_chromium.sh installs Debian's"
)


class Page:
    """A page in a browser."""

    def __init__(self, connection: ClientConnection) -> None:
        self._connection, self._asked = connection, 0
        self.addresses: list[str] = []
        """What the page has asked for."""
        self.ask("Network.enable")
        self.ask("Runtime.enable")

    def ask(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Ask the browser something, and return its answer."""
        self._asked += 1
        number = self._asked
        self._connection.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            said = json.loads(self._connection.recv(timeout=60))
            if said.get("method") == "Network.requestWillBeSent":
                address = str(said["params"]["request"]["url"])
                if not address.startswith("data:"):  # it was in the page
                    self.addresses.append(address)
            if said.get("id") == number:
                assert "error" not in said, said
                return dict(said["result"])

    def value(self, expression: str) -> Any:
        """Return what JavaScript makes of an expression."""
        answer = self.ask("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def wait_for(self, expression: str, seconds: float = 60.0) -> Any:
        """Return the value of an expression once it is true."""
        end = time.monotonic() + seconds
        while not (value := self.value(expression)):
            assert time.monotonic() < end, f"never true: {expression}"
            time.sleep(0.05)
        return value

    def go(self, address: str) -> None:
        """Go to a page."""
        self.ask("Page.navigate", url=address)

    def screenshot(self, file: Path) -> None:
        """Write what is seen as PNG."""
        file.write_bytes(base64.b64decode(self.ask("Page.captureScreenshot")["data"]))


@contextmanager
def opened(folder: Path, width: int = 1400, height: int = 1000) -> Iterator[Page]:
    """Open a browser with an empty page; its files lie in a folder."""
    assert BROWSER is not None
    command = [
        *(BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run"),
        *(f"--window-size={width},{height}", "--remote-debugging-port=0"),
        *(f"--user-data-dir={folder / 'profile'}", "about:blank"),
    ]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stderr is not None
        port = next(filter(None, (re.search(r"ws://[^:]+:(\d+)", ln) for ln in process.stderr)))[1]
        targets = httpx.get(f"http://127.0.0.1:{port}/json", timeout=30).json()
        socket = next(t["webSocketDebuggerUrl"] for t in targets if t["type"] == "page")
        with connect(socket, max_size=None) as connection:
            yield Page(connection)
    finally:
        process.kill()
        process.wait()
